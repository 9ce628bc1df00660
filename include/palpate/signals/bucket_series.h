// The smallest and the largest value of a long series in each of equal spans of time ("buckets");
// charts of hours are drawn from it. One thread adds values; other threads may read the finished
// buckets at any time.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include <palpate/signals/min_max_decimation.h>

namespace palpate {

// Smallest and largest values of equal spans of time.
class BucketSeries {
 public:
  // Makes the buckets for values from 0 to `durationS`, each `bucketS` long [s]. Throws
  // std::invalid_argument for a duration below 0, a bucket that is not above 0, or more than
  // 100,000,000 buckets.
  BucketSeries(double durationS, double bucketS);

  // Adds a value; times ascend [s]. Ignores times outside of 0..durationS, and NaN.
  void add(double timeS, double value);
  // Marks all buckets as finished; no value may follow.
  void finish();

  double bucketS() const noexcept { return bucketS_; }
  std::size_t numBuckets() const noexcept { return minimum_.size(); }
  // Number of finished buckets, from the first; they no longer change.
  std::size_t numReady() const noexcept { return ready_.load(std::memory_order_acquire); }
  bool complete() const noexcept { return numReady() == numBuckets(); }
  double readyS() const noexcept { return static_cast<double>(numReady()) * bucketS_; }
  // NaN when the bucket has no value. Throws std::out_of_range for a bucket that is not finished.
  float minimum(std::size_t bucket) const;
  float maximum(std::size_t bucket) const;

  // Returns the curve of the finished buckets: at most two points per column, smallest and largest,
  // NaN where there is no value. Each bucket is drawn at its middle.
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
