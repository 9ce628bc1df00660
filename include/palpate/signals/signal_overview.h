// All characteristic signals of a long recording in one pass over its frames: smallest and largest
// value per second (longer than two days, or of many matrices: per as many seconds as 64 MB allow),
// and what only such a pass can tell. One thread computes, others look at what is ready.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>
#include <palpate/signals/bucket_series.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

class SignalOverview {
 public:
  // Throws std::invalid_argument for an empty profile or a bucket that is not above 0.
  explicit SignalOverview(const Profile& profile, double bucketS = 1.0);

  // Reads every frame, once. Throws Cancelled: what is ready stays; FormatError where a block is
  // damaged.
  void compute(const Progress& progress = {});

  // Of a matrix, or (row = number of matrices) the whole hand. Throws std::out_of_range.
  const BucketSeries& of(std::size_t row, SignalKind kind) const;
  bool complete() const { return series_.front()->complete(); }
  // Seconds from the first frame that are ready.
  double readyS() const { return series_.front()->readyS(); }

  // Only once it is complete.
  const TimingReport& timing() const noexcept { return timing_; }
  double maximum() const noexcept { return maximum_; }  // largest value of all frames [counts]
  std::size_t saturatedFrames() const noexcept { return saturatedFrames_; }

 private:
  Profile profile_;
  std::size_t numRows_;
  std::vector<std::unique_ptr<BucketSeries>> series_;  // row after row, kind after kind
  TimingReport timing_;
  double maximum_ = 0.0;
  std::size_t saturatedFrames_ = 0;
};

}  // namespace palpate
