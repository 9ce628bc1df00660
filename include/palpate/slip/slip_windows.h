// The last second of one matrix, for windows that compare a frame with earlier ones of the same
// contact.
//
// A window of n frames compares with the n-th last stored frame; a frame is stored if the last
// stored one is at least 20 ms old. Up to 50 frames/s a window is therefore a number of frames,
// above it a duration. Slow recordings keep the noise of a single pair of frames small, and fast
// ones see the same motion. A gap (model/gap_detector.h), or a contact that is too small, clears
// the windows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <palpate/model/gap_detector.h>
#include <palpate/slip/contact_moments.h>
#include <palpate/slip/slip_rule.h>

namespace palpate {

struct SlipWindowsOptions {
  SlipHypothesisOptions hypotheses;
  int minActiveTaxels = 4;       // taxels, >= 2
  double minCounts = 400.0;      // load: sum of all taxels [counts], >= 0
  std::int64_t keepUs = 20'000;  // >= 0

  void validate() const;  // throws std::invalid_argument naming the field
};

class SlipWindows {
 public:
  // Throws std::invalid_argument.
  explicit SlipWindows(const MatrixLayout& layout, const SlipWindowsOptions& options = {});

  // The next frame of this matrix; stamps ascending [us]. `jointsDeg` may be empty; else as many as
  // before. No contest is made yet. Throws std::invalid_argument when the size is another one. What
  // isn't a finite number counts as 0.
  const SlipEvidence& add(const ConstMatrixMap& frame,
                          std::int64_t timeUs,
                          std::span<const double> jointsDeg = {});
  // Lets the two frames of a filled window compete. A window that isn't filled: nothing happens.
  void evaluateHypotheses(SlipWindow window);
  void reset();

  const SlipEvidence& evidence() const noexcept { return evidence_; }
  // The last frame, what isn't a number or below 0 as 0; all 0 before the first.
  ConstMatrixMap frame() const { return {current_.data(), layout_.rows, layout_.columns}; }
  const ContactMoments& moments() const noexcept { return moments_; }  // of the last frame
  bool afterGap() const noexcept { return afterGap_; }  // the last frame came after one

 private:
  struct Kept {
    std::vector<float> values;
    std::vector<double> jointsDeg;
    ContactMoments moments;
  };
  const Kept& back(std::size_t frames) const;  // 0: the last kept one

  MatrixLayout layout_;
  SlipWindowsOptions options_;
  GapDetector gaps_;
  std::vector<Kept> kept_;  // a ring
  std::size_t newest_ = 0;
  std::size_t numKept_ = 0;
  std::int64_t keptUs_ = 0;
  std::vector<float> current_;
  ContactMoments moments_;
  bool afterGap_ = false;
  KeyFrame key_;
  SlipEvidence evidence_;
};

}  // namespace palpate
