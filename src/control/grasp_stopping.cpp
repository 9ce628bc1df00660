// How a grasp is stopped, how it fails and how it ends.
#include <utility>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

#include "control/grasp_texts.h"

namespace palpate {
namespace {

// Stops are repeated for as long as the motion could last, and for this time [s].
constexpr double kStopMoreS = 10.0;
constexpr std::int64_t kMissedStops = 4;
// The rubber has a lag of 0.16 s: after three lags it has almost settled.
constexpr std::int64_t kLookOnUs = 500'000;

}  // namespace

void GraspStateMachine::stopWith(GraspOutcome outcome,
                                 const std::string& text,
                                 std::int64_t monoUs) {
  interrupted_ = false;
  report_.outcome = outcome;
  state_ = State::kStopping;
  next_ = State::kIdle;
  command_ = StopMotion{};  // replaces a motion that was not taken yet
  sentUs_ = stoppingSinceUs_ = monoUs;
  stoppingUntilUs_ = monoUs + microsecondsOf(remainingMotionS(monoUs) + kStopMoreS);
  report_.text = text;  // last, because it may find no memory
}

void GraspStateMachine::stopAgain(std::int64_t monoUs) {
  command_ = StopMotion{};
  sentUs_ = monoUs;
}

// Stops the motion; the grasp continues afterwards.
void GraspStateMachine::pause(State next, const std::string& text, std::int64_t monoUs) {
  stopWith(GraspOutcome::kNone, text, monoUs);
  next_ = next;
}

void GraspStateMachine::stopForSilence(std::int64_t silenceUs, std::int64_t monoUs) {
  stopWith(GraspOutcome::kStreamLost, "stopped: " + silenceText(silenceUs), monoUs);
}

// Over the limit, and no stop has been answered.
void GraspStateMachine::onStoppingFrame(const FrameEvent& frame) {
  if (!stopsBlindly_ || !isOverLimit() || std::exchange(reportedOverLimit_, true)) return;
  stopAgain(frame.monoUs);
  const TaxelPeak& loaded = loadedTaxel(report_.request);
  note("over_limit",
       "over the limit at " + placeOf(loaded) +
           ", and no stop is answered: use the power switch if the hand moves",
       loaded.matrix);
}

void GraspStateMachine::onStoppingTime(std::int64_t monoUs) {
  if (monoUs >= stoppingUntilUs_ && monoUs - sentUs_ > kMissedStops * kStopAgainUs) {
    // This process stood still: the hand gets another second.
    stoppingUntilUs_ = monoUs + 4 * kStopAgainUs;
    return stopAgain(monoUs);
  }
  report_.stateUnknown = monoUs >= stoppingUntilUs_;
  if (report_.stateUnknown)
    return end(GraspOutcome::kFailed,
               report_.text + "; no stop was answered, state unknown: use the power switch");
  if (monoUs - sentUs_ >= kStopAgainUs) stopAgain(monoUs);
}

void GraspStateMachine::onStopAcknowledged(std::int64_t monoUs) {
  if (state_ != State::kStopping) return;
  underWay_.reset();
  if (stopsBlindly_) {
    if (report_.text.ends_with(kStopsAreSent))
      report_.text.resize(report_.text.size() - kStopsAreSent.size());
    report_.text += "; no stop was answered for " +
                    fixedText(static_cast<double>(monoUs - stoppingSinceUs_) / kUsPerS, 1) +
                    " s, and the hand may have gone on until then";
    // Whatever was asked for: the hand was without control for a while.
    report_.outcome = GraspOutcome::kFailed;
  }
  if (next_ == State::kEasing) return beginEasing(monoUs);
  if (next_ == State::kSettling) return settle(monoUs);
  if (next_ == State::kClosing) return close(monoUs);
  // A slip-aware grasp that was still moving to its start holds nothing, and must not close.
  if (report_.outcome != GraspOutcome::kLimitReached || isSlipAware())
    return end(report_.outcome, report_.text);
  state_ = State::kOvershoot;
  command_.reset();
  settledUs_ = monoUs + kLookOnUs;
}

void GraspStateMachine::end(GraspOutcome outcome, const std::string& text) {
  stopsBlindly_ = interrupted_ = false;
  report_.outcome = outcome;
  report_.text = text;
  state_ = State::kIdle;
  command_.reset();
  ended_ = report_;
  if ((outcome == GraspOutcome::kLimitReached && closedToLimit_ && !isSlipAware()) ||
      (report_.held && (report_.holdTimeOver || outcome == GraspOutcome::kStopped)))
    heldDeg_ = anglesDeg_;
}

void GraspStateMachine::onCommandFailed(const std::string& why, bool sent, std::int64_t monoUs) {
  if (active() && !sent) return end(GraspOutcome::kRefused, "refused: " + why);
  // The hand may move nevertheless, because an answer can get lost. An unanswered stop is sent
  // again later.
  if (isMoving()) stopWith(GraspOutcome::kFailed, "failed: " + why, monoUs);
}

void GraspStateMachine::onMotionPortGone(const std::string& why, std::int64_t monoUs) {
  if (!active()) return;
  if (state_ == State::kOvershoot) return endOvershoot();  // the motion has stopped already
  report_.remainingMotionS = remainingMotionS(monoUs);
  const std::string gone = "the motion port is gone: " + why;
  if (underWay_) {
    const std::string text = gone + "; the hand finishes its motion by itself";
    return end(GraspOutcome::kPortGone,
               state_ == State::kStopping ? report_.text + ", but " + text : text);
  }
  end(GraspOutcome::kPortGone,
      state_ == State::kStopping
          ? report_.text + ", and " + gone
          : gone + "; the hand holds" + (isSlipAware() ? ", without slip detection" : ""));
}

void GraspStateMachine::onTactilePortGone(const std::string& why, std::int64_t monoUs) {
  if (state_ == State::kOvershoot) return endOvershoot();
  if (isMoving() && underTactileControl())
    stopWith(GraspOutcome::kStreamLost, "stopped: the tactile port is gone: " + why, monoUs);
  else if (isHolding())
    end(GraspOutcome::kStreamLost,
        "the tactile port is gone: " + why + "; " + std::string(kUnwatched));
  else if (state_ == State::kEasing)
    end(GraspOutcome::kStreamLost,
        report_.text + "; the tactile port is gone: " + why + std::string(kNotEased));
}

// The text is set last: it may find no memory, and the stop must be sent nevertheless.
void GraspStateMachine::failWith(std::string_view why,
                                 std::string_view stoppedText,
                                 std::int64_t monoUs) {
  if (state_ == State::kOvershoot) return endOvershoot();  // the motion has stopped already
  if (state_ == State::kStopping) {
    // The stop has been sent; no further motion may follow it.
    if (next_ == State::kIdle && report_.outcome != GraspOutcome::kNone) return;
    next_ = State::kIdle;
    report_.outcome = GraspOutcome::kFailed;
    report_.text = "failed: " + std::string(why) + std::string(stoppedText);
    return;
  }
  if (!active()) return;
  const bool held = isHolding();
  stopWith(GraspOutcome::kFailed, {}, monoUs);
  report_.text = "failed: " + std::string(why) +
                 (held ? ": " + std::string(kUnwatched) : std::string(stoppedText));
}

void GraspStateMachine::stop(std::int64_t monoUs) {
  if (state_ == State::kOvershoot) return endOvershoot();
  if (isHolding() || (state_ == State::kStopping && next_ != State::kIdle))
    return stopWith(GraspOutcome::kStopped,
                    "stopped by the user" + (isSlipAware() ? ": " + std::string(kUnwatched) : ""),
                    monoUs);
  if (phase() == GraspPhase::kEasing)
    return stopWith(
        GraspOutcome::kStopped, "stopped by the user: the hand holds, at " + timesText(), monoUs);
  if (isMoving()) stopWith(GraspOutcome::kStopped, "stopped by the user", monoUs);
}

void GraspStateMachine::onMotionFault(const std::string& why, std::int64_t monoUs) {
  failWith(why, kStopsAreSent, monoUs);
  stopsBlindly_ = state_ == State::kStopping;
}

}  // namespace palpate
