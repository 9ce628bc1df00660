// The difference of two frames, taxel by taxel: A minus B.
//
// Matrices of the same number have to have the same rows and columns to be compared, whatever their
// pitch; of those, taxels that are scanned in both. The others are left out: nothing is made up for
// them.
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

// Of one matrix, or of the whole frame. Taxels at rest in both frames don't count: they would water
// it down.
struct DifferenceStatistics {
  int touched = 0;    // compared taxels that are active in A or in B
  double mean = 0.0;  // of A - B over them [counts]; 0 without any
  double rms = 0.0;   // root of the mean square [counts]
  // The difference of largest magnitude, with its sign [counts]; the first of equals. Where: wire
  // order.
  double largest = 0.0;
  std::size_t matrix = 0;
  int y = 0;
  int x = 0;
};

class FrameComparison {
 public:
  // The layouts of A's and B's frames; never null.
  FrameComparison(std::shared_ptr<const SensorLayout> a, std::shared_ptr<const SensorLayout> b);

  // A's layout, with a dynamic mask that is on where taxels are compared.
  const std::shared_ptr<const SensorLayout>& layout() const noexcept { return layout_; }
  // False for a matrix of A that B hasn't, or has with other rows or columns.
  bool compared(std::size_t matrix) const { return compared_.at(matrix); }
  bool allCompared() const;  // and B has no matrix more

  // A - B in that layout; 0 where nothing is compared. Throws std::invalid_argument for frames of
  // other layouts.
  TactileFrame difference(const TactileFrame& a, const TactileFrame& b) const;
  void difference(const TactileFrame& a, const TactileFrame& b, TactileFrame& out) const;
  // One per matrix of A, the whole last.
  std::vector<DifferenceStatistics> statistics(const TactileFrame& a, const TactileFrame& b) const;
  // |A - B| where it is largest [counts].
  double largest(const TactileFrame& a, const TactileFrame& b) const;

 private:
  void check(const TactileFrame& a, const TactileFrame& b) const;

  std::shared_ptr<const SensorLayout> a_;
  std::shared_ptr<const SensorLayout> b_;
  std::shared_ptr<const SensorLayout> layout_;
  std::vector<bool> compared_;
};

// Two frames that belong to the same moment.
struct FramePair {
  double timeS = 0.0;  // on the common axis
  std::size_t frameA = 0;
  std::size_t frameB = 0;
};
// For every `stride`-th frame of A that has a frame of B beside it (TimedProfile::frameAt), in
// order. Throws Cancelled.
void visitFramePairs(
    const TimedProfile& a,
    const TimedProfile& b,
    double offsetS,
    std::size_t stride,
    const std::function<void(const FramePair&, const TactileFrame&, const TactileFrame&)>& sink,
    const Progress& progress = {});

}  // namespace palpate
