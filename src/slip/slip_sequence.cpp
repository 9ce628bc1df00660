#include "palpate/slip/slip_sequence.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/option_check.h"
#include "palpate/slip/slip_rule.h"

namespace palpate {
namespace {

constexpr double kMaxLogLoad = 1.5;
constexpr double kMaxShift = 2.0;  // [taxels]
constexpr double kShiftFloor = 0.05;
constexpr double kMaxResidual = 200.0;
constexpr double kYoungFrames = 4.0;
constexpr double kSettlingFrames = 12.0;

double slipSequenceShift(const WindowEvidence& window) {
  return std::hypot(window.centroidX, window.centroidY);
}

double rise(double logRatio) { return std::clamp(logRatio, 0.0, kMaxLogLoad); }

double logResidual(double residual) { return std::log1p(std::min(residual, kMaxResidual)); }

}  // namespace

void SlipSequenceOptions::validate() const {
  constexpr OptionCheck check{"SlipSequenceOptions"};
  check(std::isfinite(bias), "bias", bias);
  for (const double weight : weights) check(std::isfinite(weight), "weights", weight);
  check(memory >= 0.0 && memory <= 1.0, "memory", memory);
  check(mostPerFrame > 0.0, "mostPerFrame", mostPerFrame);
  check(threshold > 0.0, "threshold", threshold);
}

SlipFeatures slipFeatures(const SlipEvidence& evidence, double scale, double allowancePerJointDeg) {
  const WindowEvidence& recent = evidence.recent;
  const WindowEvidence& last = evidence.last;
  const double shift = slipSequenceShift(recent);
  const double allowed =
      std::max(0.0, std::min(kMaxShift, scale * shift) - allowancePerJointDeg * recent.jointsDeg);
  const bool compared = shift > kMinComparedShift;
  const double still = compared ? logResidual(recent.hypotheses.loadShiftResidual) : 0.0;
  const double moved = compared ? logResidual(recent.hypotheses.motionResidual) : 0.0;
  const auto age = static_cast<double>(evidence.contactAge);
  return {rise(recent.logLoadRatio),
          rise(-recent.logLoadRatio),
          std::log(kShiftFloor + allowed),
          still - moved,
          moved,
          rise(last.logLoadRatio),
          rise(-last.logLoadRatio),
          std::min(kMaxShift, scale * slipSequenceShift(last)),
          std::exp(-age / kYoungFrames),
          std::exp(-age / kSettlingFrames)};
}

SlipSequence::SlipSequence(const SlipSequenceOptions& options) : options_(options) {
  options_.validate();
}

double SlipSequence::add(const SlipFeatures& features) noexcept {
  double evidence = options_.bias;
  for (std::size_t i = 0; i < kSlipFeatures; ++i) evidence += options_.weights[i] * features[i];
  evidence = std::clamp(evidence, -options_.mostPerFrame, options_.mostPerFrame);
  sum_ = std::max(0.0, options_.memory * sum_ + evidence);
  return sum_;
}

}  // namespace palpate
