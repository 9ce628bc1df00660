// Slip alarm of one matrix: a sequential test over the frames (slip_sequence.h), and thresholds on
// the motion over three windows of past frames, raised by allowances for changing load and moving
// joints. SlipDetector uses it.
//
// Each window compares the frame with an earlier one of the same contact: 3, 10 and 30 frames
// before (at rates above 50 Hz: 60, 200 and 600 ms before, slip_windows.h). In each window, m =
// min(1.3 |centroid shift|, |d of the registration|). The conditions for an alarm are:
//   S > threshold                       the sequential test; its shifts are multiples of stepTaxels
//   P m > threshold + allowance         short window: one frame, with P > certain in a young
//                                         contact; others: two in a row
//   m > accumulated + allowance         middle window, two frames in a row
//   |angle| - 2 sd > rotation + allowance   middle window, P > 0.5: an alarm of rotation
//   allowance = rise max(0, ln(load / earlier load)) + 0.1 taxel per degree of joint motion
// The third condition doesn't use P, because the effect of a load tilt saturates while slip
// accumulates. In a settled contact the sequential test only adds alarms to those of the windows.
// A window that reaches into the first frames of a contact is ignored, and so is the
// long window while the middle one is below half of its threshold, because the contact then no
// longer moves. The hypotheses are compared over the recent frames where the contact moved at all,
// and for the window closest to its threshold.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <palpate/core/option_check.h>
#include <palpate/slip/slip_hypotheses.h>
#include <palpate/slip/slip_sequence.h>
#include <palpate/slip/slip_state.h>

namespace palpate {

inline constexpr std::size_t kSlipWindows = 3;
enum SlipWindow : std::size_t { kShortWindow, kMiddleWindow, kLongWindow };
inline constexpr std::array<std::size_t, kSlipWindows> kWindowFrames = {3, 10, 30};

// Evidence of one window.
struct WindowEvidence {
  // Whether the earlier frame belongs to this contact, without a gap in between.
  bool filled = false;
  // Shift of the centroid [taxels].
  double centroidX = 0.0;
  double centroidY = 0.0;
  // ln(present load / earlier load).
  double logLoadRatio = 0.0;
  // Largest change of a joint angle [deg]; 0 where the angles are not known.
  double jointsDeg = 0.0;
  // Comparison of the hypotheses for the two frames, if it was made.
  SlipHypothesisResult hypotheses;
};

// Evidence of all windows in one frame.
struct SlipEvidence {
  // Whether there are enough active taxels and enough load.
  bool computable = false;
  // Number of frames (above 50 Hz: steps of 20 ms) since the contact became computable.
  std::size_t contactAge = 0;
  std::array<WindowEvidence, kSlipWindows> windows;
  // Whether this frame was stored, so that the sequential test makes a step.
  bool stored = false;
  // The frame compared with the stored frame before, and with the one three stored frames before
  // or, in a younger contact, its first one.
  WindowEvidence last;
  WindowEvidence recent;
};

struct SlipRuleOptions {
  static constexpr OptionRange kStepTaxels{1e-3, 100.0, "taxels"};
  static constexpr OptionRange kReferenceTaxels{1e-3, 100.0, "taxels"};
  static constexpr OptionRange kRotationDeg{0.1, 360.0, "deg"};
  // Motion per frame that counts as slip; at 31 Hz it is 6 taxels/s.
  double stepTaxels = 0.20;
  // Total motion that counts as slip.
  double referenceTaxels = 1.0;
  // Rotation that counts as slip.
  double rotationDeg = 5.0;
  // Thresholds of the windows as multiples of stepTaxels and referenceTaxels.
  double shortSteps = 1.75;
  double middleSteps = 3.0;
  double longReferences = 1.2;
  // Motion in the middle window that is an alarm at any P(moved), as a multiple of
  // referenceTaxels, > 0.
  double accumulatedThreshold = 1.0;
  // P(moved), 0..1, that the short window needs for an alarm in a contact younger than
  // certainFrames stored frames. A contact that begins often changes its load and its shape at
  // once, so that neither hypothesis fits.
  double certainScore = kMinMotionScore;
  std::size_t certainFrames = 15;
  // Its evidence is that of motions in units of stepTaxels / 0.20.
  SlipSequenceOptions sequence = {};
  // Allowances: [taxels] per ln of the rise in load, [taxels] per degree of joint motion, and [deg]
  // per ln of the change in load, up or down.
  std::array<double, kSlipWindows> allowancePerLogRise = {1.5, 1.5, 1.0};
  double allowancePerJointDeg = 0.1;
  double rotationAllowancePerLogChange = 20.0;
  // Smallest age of the contact at the earlier frame of a window [frames].
  std::array<std::size_t, kSlipWindows> settled = {5, 10, 10};
  // A registered motion is rejected if it exceeds this many centroid shifts plus 0.3 taxel.
  double maxShiftRatio = 3.0;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Decision of the rule for one frame.
struct SlipRuleResult {
  // Alarm of translation.
  bool alarm = false;
  // Alarm of rotation.
  bool rotating = false;
  // The window nearest to its threshold; empty if no window is filled.
  std::optional<SlipWindow> leading;
  // Ratio of the largest possible motion of the leading window to its threshold, without and with
  // the allowance.
  double thresholdRatio = 0.0;
  double allowedThresholdRatio = 0.0;
};

class SlipRule {
 public:
  // Throws std::invalid_argument.
  explicit SlipRule(const SlipRuleOptions& options = {});

  // Whether the sequential test needs a comparison over the recent frames.
  bool needsRecent(const SlipEvidence& evidence) const;
  // Returns the window for which a comparison of the hypotheses would affect the decision in this
  // frame; empty if no window exceeds its threshold.
  std::optional<SlipWindow> windowToEvaluate(const SlipEvidence& evidence) const;
  // Whether a comparison over the middle window could detect a rotation; it is then evaluated every
  // few frames even if no window requires it.
  bool mayDetectRotation(const SlipEvidence& evidence) const;
  // Decides on the next frame. Uses the comparison of the window that windowToEvaluate() returns.
  // For rotation it uses that of the middle window, where it was made; two such comparisons in a
  // row must agree.
  SlipRuleResult decide(const SlipEvidence& evidence);
  void reset() noexcept {
    pending_ = turnPending_ = false;
    sequence_.reset();
  }
  // Sum of the sequential test.
  double sum() const noexcept { return sequence_.sum(); }

  const SlipRuleOptions& options() const noexcept { return options_; }

 private:
  bool counts(const SlipEvidence& evidence, std::size_t window) const;
  double threshold(std::size_t window) const;
  double allowance(const WindowEvidence& evidence, std::size_t window) const;

  double scale() const noexcept;

  SlipRuleOptions options_;
  SlipSequence sequence_;
  // Whether the frame before was above a threshold that two frames in a row must exceed.
  bool pending_ = false;
  bool turnPending_ = false;
};

}  // namespace palpate
