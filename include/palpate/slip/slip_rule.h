// Slip alarm of one matrix: thresholds on the motion over three windows of past frames, raised by
// allowances for changing load and moving joints.
//
// Each window compares the frame with an earlier one of the same contact: 3, 10 and 30 frames
// before (at rates above 50 Hz 60, 200 and 600 ms, slip_windows.h). Of each, m = min(1.3 |centroid
// shift|, |d of the registration|), and
//   P m > threshold + allowance         short window: at once; the others: in two frames in a row
// m > accumulated + allowance: middle window, independent of P, because a load tilt saturates while
// slip continues. |angle| - 2 sd > rotation + allowance: middle window, P > 0.5, an alarm of
// rotation.
// allowance = rise max(0, ln(load / earlier load)) + 0.1 taxel per degree of joint motion. A window
// that reaches into the first frames of a contact is ignored, and so is the long window while the
// middle one is below half of its threshold, because the contact then no longer moves. Only the
// window closest to its threshold is compared, once per frame.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <palpate/slip/slip_hypotheses.h>

namespace palpate {

inline constexpr std::size_t kSlipWindows = 3;
enum SlipWindow : std::size_t { kShortWindow, kMiddleWindow, kLongWindow };
inline constexpr std::array<std::size_t, kSlipWindows> kWindowFrames = {3, 10, 30};

// What one window says.
struct WindowEvidence {
  bool filled = false;     // its earlier frame is of this contact, without a gap between
  double centroidX = 0.0;  // shift of the centroid [taxels]
  double centroidY = 0.0;
  double logLoadRatio = 0.0;        // ln(load now / load then)
  double jointsDeg = 0.0;           // largest change of a joint angle; 0 where none are known
  SlipHypothesisResult hypotheses;  // of the two frames, where asked for
};

struct SlipEvidence {
  bool computable = false;     // enough taxels and load
  std::size_t contactAge = 0;  // frames (above 50 Hz: steps of 20 ms) since it became computable
  std::array<WindowEvidence, kSlipWindows> windows;
};

struct SlipRuleOptions {
  double stepTaxels = 0.20;      // motion per frame that is slip, > 0; at 31 Hz 6 taxels/s
  double referenceTaxels = 1.0;  // motion in all that is slip, > 0
  double rotationDeg = 5.0;      // > 0
  // Thresholds of the windows, in steps and references.
  double shortSteps = 1.75;
  double middleSteps = 3.0;
  double longReferences = 1.2;
  double accumulatedThreshold = 1.0;
  // Allowances [taxels].
  std::array<double, kSlipWindows> allowancePerLogRise = {1.5, 1.5, 1.0};
  double allowancePerJointDeg = 0.1;
  double rotationAllowancePerLogChange = 20.0;  // [deg]: of the load's change, up or down
  // Age of the contact at a window's earlier frame, at least [frames].
  std::array<std::size_t, kSlipWindows> settled = {5, 10, 10};
  // A registered motion is rejected if it exceeds this many centroid shifts plus 0.3 taxel.
  double maxShiftRatio = 3.0;

  void validate() const;  // throws std::invalid_argument naming the field
};

// What the rule makes of one frame.
struct SlipRuleResult {
  bool alarm = false;     // of translation
  bool rotating = false;  // alarm of rotation
  // the window nearest to its threshold; nothing: none is filled
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

  // The window whose contest would decide something in this frame; nothing: no window can raise an
  // alarm.
  std::optional<SlipWindow> windowToEvaluate(const SlipEvidence& evidence) const;
  // Whether a comparison over the middle window could detect a rotation; it is then evaluated every
  // few frames even if no window requires it.
  bool mayDetectRotation(const SlipEvidence& evidence) const;
  // The next frame. Read are the contest of the window that windowToEvaluate() names, and for
  // turning that of the middle window where it was made (two such looks in a row must agree).
  SlipRuleResult decide(const SlipEvidence& evidence);
  void reset() noexcept { pending_ = turnPending_ = false; }

  const SlipRuleOptions& options() const noexcept { return options_; }

 private:
  bool counts(const SlipEvidence& evidence, std::size_t window) const;
  double threshold(std::size_t window) const;
  double allowance(const WindowEvidence& evidence, std::size_t window) const;

  SlipRuleOptions options_;
  bool pending_ = false;  // the frame before was above a threshold that wants two
  bool turnPending_ = false;
};

}  // namespace palpate
