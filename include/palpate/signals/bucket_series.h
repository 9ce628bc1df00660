// The smallest and the largest value of a long series in each of equal spans of time: what a chart
// of hours is drawn from. One thread adds, others may look at what is ready at any time.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include <palpate/signals/min_max_decimation.h>

namespace palpate {

class BucketSeries {
 public:
  // Values from 0 to `durationS`, in buckets of `bucketS`. Throws std::invalid_argument: a duration
  // below 0, a bucket not above 0, more than 100,000,000 buckets.
  BucketSeries(double durationS, double bucketS);

  // Time ascending [s]; what lies outside of 0..durationS, or is NaN, is passed over.
  void add(double timeS, double value);
  // Nothing comes any more: all buckets are ready.
  void finish();

  double bucketS() const noexcept { return bucketS_; }
  std::size_t numBuckets() const noexcept { return minimum_.size(); }
  // The first so many don't change any more.
  std::size_t numReady() const noexcept { return ready_.load(std::memory_order_acquire); }
  bool complete() const noexcept { return numReady() == numBuckets(); }
  double readyS() const noexcept { return static_cast<double>(numReady()) * bucketS_; }
  // NaN: nothing fell into it. Throws std::out_of_range for a bucket that isn't ready.
  float minimum(std::size_t bucket) const;
  float maximum(std::size_t bucket) const;

  // Of what is ready: at most two points per column, smallest and largest, NaN where nothing is.
  // Each bucket stands at its middle.
  std::vector<SeriesPoint> points(const DecimationOptions& options) const;

 private:
  void check(std::size_t bucket) const;

  double bucketS_;
  std::vector<float> minimum_;
  std::vector<float> maximum_;
  std::size_t current_ = 0;
  std::atomic<std::size_t> ready_ = 0;
};

}  // namespace palpate
