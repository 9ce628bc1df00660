// Computes all characteristic signals of a long recording in one pass over its frames: the smallest
// and largest value per second, the timing, the largest value and the number of saturated frames.
// For recordings that are longer than two days, or have many matrices, the spans are longer, so
// that all take at most 64 MB. One thread computes; other threads may read what is ready.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>
#include <palpate/signals/bucket_series.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

// The overview of one recording.
class SignalOverview {
 public:
  // Throws std::invalid_argument for an empty profile or a bucket that is not above 0.
  explicit SignalOverview(const Profile& profile, double bucketS = 1.0);

  // Reads every frame once. Frames that can't be read because the recording is damaged are left out
  // and counted. Throws Cancelled (finished buckets stay).
  void compute(const Progress& progress = {});

  // The series of a matrix or, with row = number of matrices, of the whole hand. Throws
  // std::out_of_range, also for a signal that the profile doesn't have (signalKinds()).
  const BucketSeries& of(std::size_t row, SignalKind kind) const;
  bool complete() const { return series_.front()->complete(); }
  // Time from the first frame that is ready [s].
  double readyS() const { return series_.front()->readyS(); }

  // The next four are valid only when complete() is true.
  const TimingReport& timing() const noexcept { return timing_; }
  const UnreadableSamples& unreadable() const noexcept { return unreadable_; }  // frames
  double maximum() const noexcept { return maximum_; }  // largest value of all frames [counts]
  std::size_t saturatedFrames() const noexcept { return saturatedFrames_; }

 private:
  Profile profile_;
  std::size_t numRows_;
  std::span<const SignalKind> kinds_;
  std::vector<std::unique_ptr<BucketSeries>> series_;  // row after row, kind after kind
  TimingReport timing_;
  UnreadableSamples unreadable_;
  double maximum_ = 0.0;
  std::size_t saturatedFrames_ = 0;
};

}  // namespace palpate
