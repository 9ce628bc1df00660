#include "palpate/slip/slip_rule.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/option_check.h"

namespace palpate {
namespace {

// Factor on the shift of the centroid, which is smaller than the motion where a contact extends
// over an edge.
constexpr double kSlipRuleCentroidPart = 1.3;
// Fraction of the threshold of the middle window.
constexpr double kStillMoves = 0.5;
constexpr double kUndecided = 0.5;
constexpr double kFarSlack = 0.3;  // [taxels]
constexpr double kSds = 2.0;

double shiftOf(const WindowEvidence& window) {
  return std::hypot(window.centroidX, window.centroidY);
}

}  // namespace

void SlipRuleOptions::validate() const {
  constexpr OptionCheck check{"SlipRuleOptions"};
  check(kStepTaxels, "stepTaxels", stepTaxels);
  check(kReferenceTaxels, "referenceTaxels", referenceTaxels);
  check(kRotationDeg, "rotationDeg", rotationDeg);
  check(shortSteps > 0.0, "shortSteps", shortSteps);
  check(middleSteps > 0.0, "middleSteps", middleSteps);
  check(longReferences > 0.0, "longReferences", longReferences);
  check(accumulatedThreshold > 0.0, "accumulatedThreshold", accumulatedThreshold);
  check(certainScore >= 0.0 && certainScore <= 1.0, "certainScore", certainScore);
  sequence.validate();
  for (const double value : allowancePerLogRise) check(value >= 0.0, "allowancePerLogRise", value);
  check(allowancePerJointDeg >= 0.0, "allowancePerJointDeg", allowancePerJointDeg);
  check(rotationAllowancePerLogChange >= 0.0,
        "rotationAllowancePerLogChange",
        rotationAllowancePerLogChange);
  check(maxShiftRatio >= 1.0, "maxShiftRatio", maxShiftRatio);
}

SlipRule::SlipRule(const SlipRuleOptions& options)
    : options_(options), sequence_(options.sequence) {
  options_.validate();
}

// The weights of the sequential test belong to the default step.
double SlipRule::scale() const noexcept {
  return SlipRuleOptions{}.stepTaxels / options_.stepTaxels;
}

bool SlipRule::needsRecent(const SlipEvidence& evidence) const {
  return evidence.computable && evidence.stored && evidence.recent.filled &&
         shiftOf(evidence.recent) > kMinComparedShift;
}

bool SlipRule::counts(const SlipEvidence& evidence, std::size_t window) const {
  if (!evidence.computable || !evidence.windows[window].filled ||
      evidence.contactAge <= kWindowFrames[window] + options_.settled[window])
    return false;
  // The long window still contains the motion long after a slip has ended.
  const WindowEvidence& middle = evidence.windows[kMiddleWindow];
  return window != kLongWindow || !middle.filled ||
         kSlipRuleCentroidPart * shiftOf(middle) > kStillMoves * threshold(kMiddleWindow);
}

double SlipRule::threshold(std::size_t window) const {
  switch (window) {
    case kShortWindow:
      return options_.shortSteps * options_.stepTaxels;
    case kMiddleWindow:
      return options_.middleSteps * options_.stepTaxels;
    default:
      return options_.longReferences * options_.referenceTaxels;
  }
}

double SlipRule::allowance(const WindowEvidence& evidence, std::size_t window) const {
  return options_.allowancePerLogRise[window] * std::max(0.0, evidence.logLoadRatio) +
         options_.allowancePerJointDeg * evidence.jointsDeg;
}

bool SlipRule::mayDetectRotation(const SlipEvidence& evidence) const {
  return counts(evidence, kMiddleWindow);
}

std::optional<SlipWindow> SlipRule::windowToEvaluate(const SlipEvidence& evidence) const {
  std::optional<SlipWindow> best;
  double most = 1.0;
  for (std::size_t i = 0; i < kSlipWindows; ++i) {
    if (!counts(evidence, i)) continue;
    const WindowEvidence& window = evidence.windows[i];
    const double thresholdRatio =
        kSlipRuleCentroidPart * shiftOf(window) / (threshold(i) + allowance(window, i));
    if (thresholdRatio <= most) continue;
    most = thresholdRatio;
    best = static_cast<SlipWindow>(i);
  }
  return best;
}

SlipRuleResult SlipRule::decide(const SlipEvidence& evidence) {
  SlipRuleResult outcome;
  bool above = false;
  for (std::size_t i = 0; i < kSlipWindows; ++i) {
    if (!counts(evidence, i)) continue;
    const WindowEvidence& window = evidence.windows[i];
    const double most = kSlipRuleCentroidPart * shiftOf(window);
    const double thresholdRatio = most / threshold(i);
    if (outcome.leading && thresholdRatio <= outcome.thresholdRatio) continue;
    outcome.leading = static_cast<SlipWindow>(i);
    outcome.thresholdRatio = thresholdRatio;
    outcome.allowedThresholdRatio = most / (threshold(i) + allowance(window, i));
  }
  if (const auto asked = windowToEvaluate(evidence)) {
    const WindowEvidence& window = evidence.windows[*asked];
    const SlipHypothesisResult& hypotheses = window.hypotheses;
    outcome.leading = asked;
    outcome.thresholdRatio = kSlipRuleCentroidPart * shiftOf(window) / threshold(*asked);
    const double allowed = allowance(window, *asked);
    outcome.allowedThresholdRatio =
        kSlipRuleCentroidPart * shiftOf(window) / (threshold(*asked) + allowed);
    // If the registration failed, the motion is that of the centroid, and P is 0.5.
    const double shift = shiftOf(window);
    const double registered =
        hypotheses.computed ? std::hypot(hypotheses.motion.dx, hypotheses.motion.dy) : shift;
    const double motion = std::min(kSlipRuleCentroidPart * shift, registered);
    const bool believed =
        hypotheses.computed && registered <= options_.maxShiftRatio * shift + kFarSlack;
    const double p = believed ? hypotheses.pMoved : 0.5;
    const bool settled = evidence.contactAge >= options_.certainFrames;
    above = motion * p > threshold(*asked) + allowed &&
            (*asked != kShortWindow || settled || p > options_.certainScore);
    if (*asked == kShortWindow && above) outcome.alarm = true;
    if (*asked == kMiddleWindow &&
        motion > options_.accumulatedThreshold * options_.referenceTaxels + allowed)
      above = true;
  }
  if (!evidence.computable || (evidence.stored && evidence.contactAge <= 1)) sequence_.reset();
  if (evidence.computable && evidence.stored && evidence.recent.filled) {
    sequence_.add(slipFeatures(evidence, scale(), options_.allowancePerJointDeg));
    outcome.alarm = outcome.alarm || sequence_.exceeds();
  }
  outcome.alarm = outcome.alarm || (above && pending_);
  pending_ = above;
  const WindowEvidence& middle = evidence.windows[kMiddleWindow];
  if (!evidence.computable) turnPending_ = false;
  if (counts(evidence, kMiddleWindow) && middle.hypotheses.computed) {
    const SlipHypothesisResult& hypotheses = middle.hypotheses;
    const bool turns = std::abs(hypotheses.motion.angleDeg) - kSds * hypotheses.sdAngleDeg >
                           options_.rotationDeg + options_.rotationAllowancePerLogChange *
                                                      std::abs(middle.logLoadRatio) &&
                       hypotheses.pMoved > kUndecided;
    outcome.rotating = turns && turnPending_;
    turnPending_ = turns;
  }
  return outcome;
}

}  // namespace palpate
