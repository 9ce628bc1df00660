// Keeps the last frames of one matrix (at 31 Hz about one second) for the windows of the slip rule,
// which compare a frame with earlier ones of the same contact.
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
  // Of the comparison of the hypotheses.
  SlipHypothesisOptions hypotheses;
  // A contact needs at least this many active taxels, >= 2,
  int minActiveTaxels = 4;
  // and a load (sum of all taxels) above this [counts], >= 0.
  double minCounts = 400.0;
  // Smallest time between stored frames [us], >= 0.
  std::int64_t keepUs = 20'000;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

class SlipWindows {
 public:
  // Throws std::invalid_argument.
  explicit SlipWindows(const MatrixLayout& layout, const SlipWindowsOptions& options = {});

  // Processes the next frame of this matrix; time stamps must ascend [us]. `jointsDeg` may be
  // empty; otherwise it has as many values as before. The hypotheses are not compared yet. A value
  // that is not a finite number counts as 0. Throws std::invalid_argument when the frame has
  // another size.
  const SlipEvidence& add(const ConstMatrixMap& frame,
                          std::int64_t timeUs,
                          std::span<const double> jointsDeg = {});
  // Compares the hypotheses for the two frames of a window. Does nothing if the window is not
  // filled.
  void evaluateHypotheses(SlipWindow window);
  // Compares the hypotheses over the recent frames (SlipEvidence::recent). If these are the frames
  // of the short window, its comparison is made as well.
  void evaluateRecent();
  void reset();
  // Frames before the next one are lost: there is a gap, however short it is.
  void setLoss() noexcept { gaps_.setLoss(); }

  const SlipEvidence& evidence() const noexcept { return evidence_; }
  // The last frame; values that are not numbers or are below 0 are replaced by 0. All 0 before the
  // first frame.
  ConstMatrixMap frame() const { return {current_.data(), layout_.rows, layout_.columns}; }
  // Moments of the last frame.
  const ContactMoments& moments() const noexcept { return moments_; }
  // Whether there is a gap before the last frame.
  bool afterGap() const noexcept { return afterGap_; }

 private:
  struct Kept {
    std::vector<float> values;
    std::vector<double> jointsDeg;
    ContactMoments moments;
  };
  // Returns a stored frame counted from the newest one (0).
  const Kept& back(std::size_t frames) const;
  // Returns the evidence of the last frame against the stored one `frames` frames before.
  WindowEvidence compare(std::size_t frames, std::span<const double> jointsDeg) const;
  SlipHypothesisResult hypothesesAgainst(const Kept& then, const WindowEvidence& window);

  MatrixLayout layout_;
  SlipWindowsOptions options_;
  GapDetector gaps_;
  // Ring buffer of stored frames.
  std::vector<Kept> kept_;
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
