// A slip-aware grasp opens slowly: to its lower limit, or until the object slips, for its friction.
#include <algorithm>
#include <utility>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kLooseningDegPerS = 1.0;
// Opening for the measurement of friction ends at this fraction of the limit: a safe hold is more
// important than the result.
constexpr double kMinOfLimit = 0.25;
constexpr double kLongestLooseningS = 20.0;

}  // namespace

void GraspStateMachine::loosen(const char* action, const std::string& text, std::int64_t monoUs) {
  note(action, text);
  grip_.setReference();
  MoveJoints open = motionTo(report_.request, 0.0, hand_);
  for (double& velocity : open.velocityDegPerS) velocity = std::min(velocity, kLooseningDegPerS);
  send(std::move(open), State::kLoosening, monoUs);
  settledUs_ = monoUs + microsecondsOf(kLongestLooseningS);
}

void GraspStateMachine::onLooseningFrame(const FrameEvent& frame) {
  const std::int64_t monoUs = frame.monoUs;
  if (frame.silenceUs) return stopForSilence(*frame.silenceUs, monoUs);
  if (const auto slip = grip_.slip()) {
    if (frictionTestRunning_) reportFriction(*slip);
    frictionTestRunning_ = false;
    return respondToSlip(*slip, monoUs);
  }
  const double enough = frictionTestRunning_ ? kMinOfLimit * report_.request.limitCounts : limit_;
  const bool tooMuch = static_cast<double>(loadCounts()) > enough ||
                       (!frictionTestRunning_ && fingerOverForce(report_.request, forces_));
  if (tooMuch && monoUs < settledUs_) return;
  if (!frictionTestRunning_) return pause(State::kSettling, "loose enough", monoUs);
  frictionTestRunning_ = false;
  note("friction",
       grip_.touches()
           ? "it doesn't slip at " + numberText(peak_.counts) + " counts: closing again"
           : std::string("the object was lost before a slip was seen: closing again; no friction"));
  pause(State::kClosing, "loose enough", monoUs);
}

// The force at the begin of slip carried the weight: weight = friction times normal force.
void GraspStateMachine::reportFriction(const GripSlip& slip) {
  const HoldingOptions& holding = report_.request.holding;
  report_.countsAtSlip = grip_.sumCounts();
  std::string text = "slips at " + numberText(grip_.sumCounts()) + " counts in sum";
  if (holding.newtonsPerCount > 0.0 && grip_.sumCounts() > 0.0) {
    report_.friction = holding.weightN / (holding.newtonsPerCount * grip_.sumCounts());
    text += ": friction about " + fixedText(*report_.friction, 2);
  }
  note("friction", text, slip.matrix);
}

}  // namespace palpate
