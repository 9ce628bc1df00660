// Holding of a slip-aware grasp: what it does when the object slips, or the stream is silent.
#include <algorithm>
#include <utility>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/core/number_text.h"

#include "control/grasp_texts.h"

namespace palpate {
namespace {

// A hold ends after a longer silence of the stream.
constexpr std::int64_t kLongestSilenceUs = 1'000'000;

}  // namespace

void GraspStateMachine::settle(std::int64_t monoUs) {
  state_ = State::kSettling;
  command_.reset();
  const HoldingOptions& holding = report_.request.holding;
  settledUs_ = monoUs + microsecondsOf(held_ ? holding.restS : holding.settleS);
  if (endUs_ == 0 && holding.holdS > 0.0) endUs_ = settledUs_ + microsecondsOf(holding.holdS);
}

void GraspStateMachine::onSettlingFrame(const FrameEvent& frame) {
  const std::int64_t monoUs = frame.monoUs;
  if (frame.silenceUs) return onFramesBack(*frame.silenceUs, monoUs);
  if (monoUs < settledUs_) return;
  grip_.setReference();
  state_ = State::kHolding;
  lastSlipUs_ = monoUs;
  if (!held_) {
    heldFromUs_ = monoUs;
    note("holding", "holding: " + limitText());
  }
  held_ = report_.held = true;
}

void GraspStateMachine::onHoldingFrame(const FrameEvent& frame) {
  if (frame.silenceUs) return onFramesBack(*frame.silenceUs, frame.monoUs);
  if (!grip_.touches()) {
    report_.heldAxes.clear();
    return end(GraspOutcome::kFinished, std::string(kNothingHeldText));
  }
  if (const auto slip = grip_.slip()) respondToSlip(*slip, frame.monoUs);
}

void GraspStateMachine::respondToSlip(const GripSlip& slip, std::int64_t monoUs) {
  const HoldingOptions& holding = report_.request.holding;
  ++report_.slips;
  lastSlipUs_ = monoUs;
  // The peak may be above the limit because of the overshoot: with a limit below the present
  // reading the hand would not close.
  const int load = static_cast<int>(loadCounts());
  const int felt = std::max(limit_, load);
  const int raised = std::min(felt + holding.raiseCounts, holding.maxLimitCounts);
  if (raised <= load || fingerOverForce(report_.request, forces_)) {
    limit_ = std::max(limit_, std::min(felt, holding.maxLimitCounts));
    note("at_limit", "slips, and the limit can't rise: " + slip.why, slip.matrix);
    grip_.setReference();
    slippedAtLimit_ = true;
    if (state_ == State::kLoosening) pause(State::kSettling, "it slips", monoUs);
    return;
  }
  limit_ = raised;
  report_.limitCounts = limit_;
  slippedAtLimit_ = false;
  ++answeredSlips_;
  note("slip",
       "slips: " + slip.why + "; closing to " + std::to_string(limit_) + " counts",
       slip.matrix);
  // The loosening motion must stop first.
  if (state_ == State::kLoosening) return pause(State::kClosing, "it slips", monoUs);
  close(monoUs);
}

void GraspStateMachine::onHoldingTime(std::int64_t monoUs) {
  if (monoUs > holdingDeadAtUs()) return onHoldingSilence(stream_.silenceUs(monoUs).value_or(0));
  if (state_ != State::kHolding) return;
  const HoldingOptions& holding = report_.request.holding;
  if (endUs_ != 0 && monoUs >= endUs_) {
    report_.holdTimeOver = true;
    return end(GraspOutcome::kFinished, heldText());
  }
  if (monoUs < lastSlipUs_ + microsecondsOf(holding.noSlipS)) return;
  lastSlipUs_ = monoUs;
  if (holding.weightN > 0.0 && !frictionTested_) {
    frictionTested_ = frictionTestRunning_ = true;
    return loosen("friction", "opening slowly until it slips, for its friction", monoUs);
  }
  const bool mayLoosen = holding.loosen && !slippedAtLimit_;
  // The force rises after the stop, because the rubber has a lag.
  const bool overForce = mayLoosen && fingerOverForce(report_.request, forces_).has_value();
  if (limit_ <= report_.request.limitCounts) {
    if (overForce) loosen("loosen", "opening slowly to the limit in newtons", monoUs);
    return;
  }
  limit_ = std::max(limit_ - holding.raiseCounts, report_.request.limitCounts);
  report_.limitCounts = limit_;
  note("lower", "nothing slips: limit " + std::to_string(limit_) + " counts");
  if (overForce || (mayLoosen && loadCounts() > static_cast<float>(limit_)))
    loosen("loosen", "opening slowly to the lower limit", monoUs);
}

void GraspStateMachine::onHoldingSilence(std::int64_t silenceUs) {
  if (!std::exchange(interrupted_, true))
    note("interrupted",
         "not protected: " + silenceText(silenceUs) + "; " + std::string(kUnwatched));
  if (silenceUs > kLongestSilenceUs)
    end(GraspOutcome::kStreamLost, "no more tactile frames arrive: " + std::string(kUnwatched));
}

// What moved in the silence is not answered: the hand must not move because frames are back.
void GraspStateMachine::onFramesBack(std::int64_t silenceUs, std::int64_t monoUs) {
  onHoldingSilence(silenceUs);
  if (!isHolding()) return;
  interrupted_ = false;
  if (state_ == State::kHolding) grip_.setReference();
  lastSlipUs_ = monoUs;  // whether nothing slipped in the silence is not known
  note("watched", "watched again after " + millisecondsText(silenceUs) + " ms without a frame");
}

// Time from which the stream counts as dead while it is held [monotonic us].
std::int64_t GraspStateMachine::holdingDeadAtUs() const {
  return stream_.deadAtUs() - std::max<std::int64_t>(0, stream_.silenceLimitUs() - silenceLimitUs_);
}

std::int64_t GraspStateMachine::holdingNextUs() const {
  if (interrupted_) return stream_.deadAtUs() - stream_.silenceLimitUs() + kLongestSilenceUs + 1;
  std::int64_t nextUs = holdingDeadAtUs() + 1;
  if (state_ != State::kHolding) return nextUs;
  if (endUs_ != 0) nextUs = std::min(nextUs, endUs_);
  return std::min(nextUs, lastSlipUs_ + microsecondsOf(report_.request.holding.noSlipS));
}

}  // namespace palpate
