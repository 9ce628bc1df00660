#include "palpate/control/hand_condition.h"

#include "palpate/control/grasp_control.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

using Condition = HandCondition;

constexpr std::string_view kPowerOff =
    "if the hand moves, use the emergency stop or switch its power off";

ExplainedCondition whileGone(const GraspStatus& status) {
  const std::string powerOff = std::string(kPowerOff) + "; " + status.cannotMove;
  if (status.phase != GraspPhase::kIdle && status.running)
    return {Condition::kGone, "stop commands are sent, but the hand does not answer: " + powerOff};
  if (status.portGone)
    return {Condition::kGone,
            status.portGone->text + "; plug it in again" +
                (status.portGone->remainingMotionS.value_or(0.0) > 0.0
                     ? "; until then nothing can stop the hand: " + std::string(kPowerOff)
                     : std::string())};
  if (status.lastMotion && status.lastMotion->stateUnknown)
    return {Condition::kGone,
            "no stop was answered, and the state of the hand is unknown: " + powerOff};
  return {Condition::kGone, "the hand can't be moved: " + status.cannotMove};
}

ExplainedCondition whileStopping(const GraspReport& running) {
  if (protectionEnded(running)) return {Condition::kNotProtected, running.text};
  // A hand that holds doesn't move.
  if (running.outcome == GraspOutcome::kStopped && running.held)
    return {Condition::kStopped, running.text};
  return {Condition::kMoving, "stopping: " + running.text};
}

ExplainedCondition whileHolding(const GraspStatus& status, const GraspReport& running) {
  if (status.unwatchedMs)
    return {Condition::kNotProtected,
            "no tactile frames for " + fixedText(*status.unwatchedMs, 0) +
                " ms: the hand holds, without slip detection; it is watched again when frames are "
                "back within 1 s"};
  if (status.phase == GraspPhase::kHolding) return {Condition::kWatched, status.holding};
  if (running.request.mode == GraspMode::kSlip)
    return {Condition::kHolding, "the reading settles; then the hand is watched for slip"};
  return {Condition::kHolding, running.text + "; the hand holds, without slip detection"};
}

ExplainedCondition whileRunning(const GraspStatus& status, const GraspReport& running) {
  const std::string what = describe(running.request);
  switch (status.phase) {
    case GraspPhase::kStopping:
      return whileStopping(running);
    case GraspPhase::kSettling:
    case GraspPhase::kHolding:
      return whileHolding(status, running);
    case GraspPhase::kEasing:
      return {Condition::kEasing, "small steps, until the reading at rest is the limit: " + what};
    case GraspPhase::kIdle:
    case GraspPhase::kPreshaping:
    case GraspPhase::kClosing:
    case GraspPhase::kLoosening:
      break;
  }
  if (isOpening(running.request)) return {Condition::kMoving, what};
  return {Condition::kMoving, std::string(nameOf(status.phase)) + ": " + what};
}

ExplainedCondition afterMotion(const GraspReport& last) {
  const std::string unwatched = last.text + "; the hand holds, without slip detection";
  switch (last.outcome) {
    case GraspOutcome::kFinished:
      if (last.holdTimeOver) return {Condition::kHolding, last.text};
      if (last.heldAxes.empty()) return {Condition::kReady, last.text};
      return {Condition::kHolding, unwatched};
    case GraspOutcome::kLimitReached:
      return {Condition::kHolding, unwatched};
    case GraspOutcome::kStopped:
      return {Condition::kStopped, last.text};
    case GraspOutcome::kStreamLost:
    case GraspOutcome::kPortGone:
    case GraspOutcome::kFailed:
      // At its limit it holds something.
      return {last.held || last.peakAfterStop ? Condition::kHolding : Condition::kStopped,
              last.text};
    case GraspOutcome::kNone:
    case GraspOutcome::kRelaxed:
    case GraspOutcome::kRefused:
      break;
  }
  return {Condition::kReady, "a motion can begin"};
}

}  // namespace

std::string_view nameOf(HandCondition condition) {
  switch (condition) {
    case Condition::kReady:
      break;
    case Condition::kRelaxed:
      return "relaxed";
    case Condition::kMoving:
      return "moving";
    case Condition::kEasing:
      return "easing";
    case Condition::kHolding:
      return "holding";
    case Condition::kWatched:
      return "holding and watched";
    case Condition::kNotProtected:
      return "not protected";
    case Condition::kStopped:
      return "stopped";
    case Condition::kGone:
      return "gone";
  }
  return "ready";
}

bool protectionEnded(const GraspReport& report) {
  if (report.stateUnknown) return true;
  if (report.request.mode == GraspMode::kPlain) return false;
  const bool isSlipAware = report.request.mode == GraspMode::kSlip;
  switch (report.outcome) {
    case GraspOutcome::kStreamLost:
    case GraspOutcome::kPortGone:
    case GraspOutcome::kFailed:
      return true;
    case GraspOutcome::kLimitReached:
      return isSlipAware;  // already on its way to the start: it was never watched for slip
    case GraspOutcome::kFinished:
      return isSlipAware && !report.holdTimeOver && !report.heldAxes.empty();
    case GraspOutcome::kNone:
    case GraspOutcome::kStopped:
    case GraspOutcome::kRelaxed:
    case GraspOutcome::kRefused:
      break;
  }
  return false;
}

ExplainedCondition conditionOf(const GraspStatus& status) {
  if (!status.cannotMove.empty()) return whileGone(status);
  if (status.phase != GraspPhase::kIdle && status.running)
    return whileRunning(status, *status.running);
  if (!status.unprotected.empty()) return {Condition::kNotProtected, status.unprotected};
  if (status.motorsOff)
    return {Condition::kRelaxed,
            "the motors are off: the fingers can be moved by hand, and an object may fall; the "
            "next motion switches them on"};
  if (status.wasAway)
    return {Condition::kReady,
            "the motion port was gone since the last motion: what the hand holds is not known; a "
            "motion can begin"};
  return status.lastMotion ? afterMotion(*status.lastMotion)
                           : ExplainedCondition{Condition::kReady, "a motion can begin"};
}

}  // namespace palpate
