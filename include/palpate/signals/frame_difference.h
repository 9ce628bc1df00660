// The difference of two frames, taxel by taxel: A minus B, for the comparison of two recordings.
//
// Matrices with the same index are compared when they have the same rows and columns, whatever
// their pitch; within them, the taxels that are scanned in both. Other matrices and taxels are left
// out.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/signals/alignment.h>

namespace palpate {

// Statistics of one matrix, or of the whole frame. Taxels that are at rest in both frames are left
// out, since they would lower the mean values.
struct DifferenceStatistics {
  int touched = 0;  // compared taxels that are active in A or in B
  // Mean of A - B over these taxels [counts]; 0 without any.
  double mean = 0.0;
  double rms = 0.0;  // root of the mean square [counts]
  // The difference with the largest magnitude, with its sign [counts], and its taxel; of equal ones
  // the first in wire order.
  double largest = 0.0;
  std::size_t matrix = 0;
  int y = 0;
  int x = 0;
};

// Compares frames of two recordings, A and B, with given layouts.
class FrameComparison {
 public:
  // Takes the layouts of A's and B's frames; both must not be null.
  FrameComparison(std::shared_ptr<const SensorLayout> a, std::shared_ptr<const SensorLayout> b);

  // A's layout, with a dynamic mask that marks the compared taxels.
  const std::shared_ptr<const SensorLayout>& layout() const noexcept { return layout_; }
  // Returns false for a matrix of A that B does not have, or has with other rows or columns.
  bool compared(std::size_t matrix) const { return compared_.at(matrix); }
  // Returns whether all matrices of A and of B are compared.
  bool allCompared() const;

  // Returns A - B in layout(); 0 where nothing is compared. Throws std::invalid_argument for frames
  // of other layouts.
  TactileFrame difference(const TactileFrame& a, const TactileFrame& b) const;
  void difference(const TactileFrame& a, const TactileFrame& b, TactileFrame& out) const;
  // Returns one entry per matrix of A, and the whole frame last.
  std::vector<DifferenceStatistics> statistics(const TactileFrame& a, const TactileFrame& b) const;
  // Returns the largest |A - B| [counts].
  double largest(const TactileFrame& a, const TactileFrame& b) const;

 private:
  void check(const TactileFrame& a, const TactileFrame& b) const;

  std::shared_ptr<const SensorLayout> a_;
  std::shared_ptr<const SensorLayout> b_;
  std::shared_ptr<const SensorLayout> layout_;
  std::vector<bool> compared_;
};

// Two frames that belong to the same time.
struct FramePair {
  double timeS = 0.0;  // on the common time axis [s]
  std::size_t frameA = 0;
  std::size_t frameB = 0;
};
// Goes through the pairs in order.
class FramePairs {
 public:
  // Every `stride`-th frame of A that has a frame of B at its time (TimedProfile::frameAt), which
  // begins `offsetS` after A. Throws std::invalid_argument for the stride 0.
  FramePairs(TimedProfile a, TimedProfile b, double offsetS, std::size_t stride = 1);
  // Reads the next pair; false after the last one. Throws as visitFramePairs().
  bool next(const Progress& progress = {}, UnreadableSamples* unreadable = nullptr);
  const FramePair& pair() const noexcept { return pair_; }
  const TactileFrame& inA() const noexcept { return inA_; }
  const TactileFrame& inB() const noexcept { return inB_; }

 private:
  const TimedProfile a_, b_;
  const double offsetS_;
  const std::size_t stride_, numFrames_;
  std::size_t at_ = 0, visited_ = 0;
  std::optional<std::size_t> readB_;
  FramePair pair_;
  TactileFrame inA_, inB_;
};
// Calls `sink` for every `stride`-th frame of A that has a frame of B at its time
// (TimedProfile::frameAt), in order. With `unreadable`, the frames of A are added to it of which
// one of the pair can't be read, and left out. Throws Cancelled, and without `unreadable` Error.
void visitFramePairs(
    const TimedProfile& a,
    const TimedProfile& b,
    double offsetS,
    std::size_t stride,
    const std::function<void(const FramePair&, const TactileFrame&, const TactileFrame&)>& sink,
    const Progress& progress = {},
    UnreadableSamples* unreadable = nullptr);

}  // namespace palpate
