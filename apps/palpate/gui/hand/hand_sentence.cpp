#include "gui/hand/hand_sentence.h"

#include <cmath>
#include <optional>

#include <palpate/control/grasp_approach.h>
#include <palpate/core/time.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

QString handText(std::string_view from) {
  return QString::fromUtf8(from.data(), static_cast<qsizetype>(from.size()));
}

// How far the hand has closed, as a close ratio: ", at 0.42"; empty: not known. A grasp of an
// unknown object may take minutes.
QString progressOf(const GraspStatus& status) {
  if (status.phase != GraspPhase::kClosing || isJointMotion(*status.request)) return {};
  const auto ratio = closeRatioOf(*status.request, status.anglesDeg);
  return ratio ? ", at " + figure(*ratio, 2) : QString();
}

QString phaseText(const GraspStatus& status) {
  QString phase = handText(nameOf(status.phase));
  if (!status.request) return phase;
  phase += progressOf(status);
  QString what = handText(describe(*status.request));
  // "opening: centrical, 10 deg/s" already names the phase.
  if (isOpening(*status.request) && status.phase == GraspPhase::kClosing)
    return what.replace(": ", " · ");
  // How it holds, and what may be wrong with it, comes before what was asked for.
  if (status.phase == GraspPhase::kHolding && !status.holding.empty())
    return handText(status.holding) + " · " + what;
  return phase + " · " + what;
}

QString blockedText(const HandFacts& facts) {
  const GraspStatus& status = facts.status;
  const QString why = handText(status.cannotMove);
  const QString powerOff = "If the hand moves, use the emergency stop or switch its power off. ";
  if (status.phase == GraspPhase::kStopping)
    return "Stop commands are sent, but the hand does not answer. " + powerOff + why;
  if (!status.portGone && status.last && status.last->stateUnknown)
    return "No stop was answered: the state of the hand is unknown. " + powerOff + why;
  if (!status.portGone) return "The hand can't be moved: " + why;
  // What the hand does comes first. The status is in red, and the hand is looked for all the time.
  const QString gone = " The motion port is disconnected: plug it in again.";
  const double remainingMotionS = status.portGone->remainingMotionS.value_or(0.0);
  if (remainingMotionS == 0.0) return "The hand does not move; the motors are on and hold." + gone;
  const double leftS =
      remainingMotionS - static_cast<double>(facts.nowUs - status.portGone->endUs) / kUsPerS;
  if (leftS > 0.0)
    return "The hand is still moving to its target (up to " + figure(std::ceil(leftS), 0) +
           " s). The window can't stop it: use the emergency stop, or switch its power off." + gone;
  return "Its motion has ended, and the motors hold." + gone;
}

// When the reason that ended the last grasp no longer exists.
QString overText(const GraspReport& last, const HandFacts& facts) {
  if (last.outcome == GraspOutcome::kPortGone)
    return "Ready. The motion port was disconnected during a motion; when it came back, the hand "
           "was stopped.";
  if (facts.goneUs > last.endUs) return "Ready. The motion port was disconnected, and is back.";
  if (last.outcome == GraspOutcome::kRefused && facts.limitMeasurable)
    return "Ready. The last grasp was refused: its limit couldn't be measured; now it can.";
  if (last.outcome == GraspOutcome::kStreamLost && !last.held && facts.status.cannotReact.empty())
    return "Ready. The last grasp was stopped: no tactile frames arrived; they arrive again.";
  return {};
}

HandSentence afterGrasp(const GraspReport& last, const HandFacts& facts) {
  if (const QString over = overText(last, facts); !over.isEmpty())
    return {withFriction(over, facts.status)};
  HandSentence said{withFriction(handText(last.text), facts.status)};
  switch (last.outcome) {
    case GraspOutcome::kFinished:
    case GraspOutcome::kLimitReached:
    case GraspOutcome::kStopped:
    case GraspOutcome::kRelaxed:
      break;
    default:
      said.bad = true;
      said.endUs = last.endUs;
      said.why = said.text;
  }
  return said;
}

HandSentence atRest(const HandFacts& facts) {
  const GraspStatus& status = facts.status;
  if (!status.unprotected.empty()) {
    const QString why = handText(status.unprotected);
    return {"Not protected: " + why + ". Use Hand > Acknowledge when you have seen it." +
                (facts.refusal.isEmpty() ? "" : "\n" + facts.refusal),
            true,
            {},
            status.lastMotion->endUs,
            why};
  }
  if (!facts.refusal.isEmpty()) return {facts.refusal, true};
  if (!facts.ownMotion.isEmpty())
    return {"The emulated hand follows the script of its scene: " + facts.ownMotion +
            ". Stop (Esc) or any command you send ends it."};
  if (status.motorsOff)
    return {
        "The motors are off: the fingers can be moved by hand, and an object may fall. The next "
        "motion switches them on."};
  if (facts.foundMovingUs > 0 && (!status.last || status.last->endUs < facts.foundMovingUs))
    return {"The hand was moving unattended when it was connected: it was stopped. Ready.", true};
  if (facts.sceneStopped) return {"Stopped. " + sceneStoppedText()};
  return status.last ? afterGrasp(*status.last, facts) : HandSentence{"Ready."};
}

}  // namespace

QString sceneStoppedText() {
  return "The hand no longer follows a script, and holds what it held; what its scene does to "
         "objects, such as a pull, continues.";
}

QString withFriction(const QString& text, const GraspStatus& status) {
  std::optional<double> friction = status.friction;
  if (!status.request && status.last) friction = status.last->friction;
  if (!friction) return text;
  const QString said = "friction about " + figure(*friction, 2);
  // The text of a grasp that ended after its time has it already.
  return text.contains(said) ? text : said + "\n" + text;
}

HandSentence handSentence(const HandFacts& facts) {
  switch (facts.hand) {
    case HandFacts::Hand::kNone:
      return {"No hand is connected."};
    case HandFacts::Hand::kStreamed:
      return {"This hand is read, not moved: its stream takes no commands."};
    case HandFacts::Hand::kReplayed:
      return {"A recording is replayed: there is nothing to move."};
    case HandFacts::Hand::kMovable:
      break;
  }
  const GraspStatus& status = facts.status;
  const bool idle = status.phase == GraspPhase::kIdle;
  if (!facts.sequence.isEmpty())
    return {facts.sequence + (idle ? "" : "\n" + phaseText(status).section(" · ", 0, 0))};
  if (!status.cannotMove.empty() && (idle || status.phase == GraspPhase::kStopping))
    return {blockedText(facts), true, handText(status.cannotMove)};
  if (idle) return atRest(facts);
  if (const ExplainedCondition now = conditionOf(status);
      now.condition == HandCondition::kNotProtected)
    return {"Not protected: " + handText(now.sentence), true};
  const QString slowly =
      facts.touchUnknown
          ? "\nSlowly: where it touches isn't known. For the next grasp, give its size (More)."
          : QString();
  return {withFriction(phaseText(status) + slowly, status)};
}

}  // namespace palpate::gui
