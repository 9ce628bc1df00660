#include "palpate/control/empty_hand_cycle.h"

#include <exception>
#include <utility>

#include "palpate/core/time.h"

namespace palpate {

EmptyHandCycle::EmptyHandCycle(GraspControl& control, Options options)
    : control_(control), options_(std::move(options)) {
  control_.advance(*this);
}

void EmptyHandCycle::begin(std::int64_t hostUs) {
  const std::lock_guard lock(mutex_);
  state_ = State::kIdle;
  problem_.reset();
  // Time before the command: it distinguishes the new grasp from an earlier one.
  sinceUs_ = hostUs;
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.preshape = options_.preshape;
  request.startRatio = 0.0;
  request.closeRatio = 1.0;
  request.velocityDegPerS = options_.closingDegPerS;
  request.limitCounts = options_.limitCounts;
  stopsBefore_ = control_.status().stopsAsked;
  control_.grasp(request);
  state_ = State::kClosing;
}

void EmptyHandCycle::step(std::int64_t hostUs) {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kIdle) return;
  const double seconds = static_cast<double>(hostUs - sinceUs_) / kUsPerS;
  const GraspStatus status = control_.status();
  if (status.stopsAsked != stopsBefore_) return end("the hand was stopped");
  if (state_ == State::kClosing) {
    if (status.phase != GraspPhase::kIdle || !status.last || status.last->beginUs < sinceUs_)
      return;
    const GraspOutcome outcome = status.last->outcome;
    if (outcome != GraspOutcome::kLimitReached && outcome != GraspOutcome::kFinished)
      return end(status.last->text);
    state_ = State::kHolding;
    sinceUs_ = hostUs;
    return;
  }
  if (state_ == State::kOpening) {
    if (seconds > options_.maxOpenS) end("the pads didn't touch, or don't separate");
    return;
  }
  if (status.phase != GraspPhase::kIdle) return end("the hand does something else");
  if (seconds < options_.holdS) return;
  try {
    control_.preshape(options_.preshape, options_.openingDegPerS);
  } catch (const std::exception& error) {
    return end(error.what());
  }
  state_ = State::kOpening;
  sinceUs_ = hostUs;
}

std::optional<std::string> EmptyHandCycle::takeProblem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, std::nullopt);
}

std::optional<std::string> EmptyHandCycle::onPadsReleased() {
  const std::lock_guard lock(mutex_);
  const bool isOpening = std::exchange(state_, State::kIdle) == State::kOpening;
  return isOpening ? std::nullopt : std::optional<std::string>("the pads let go of each other");
}

void EmptyHandCycle::cancel() {
  const std::lock_guard lock(mutex_);
  state_ = State::kIdle;
}

EmptyHandCycle::State EmptyHandCycle::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void EmptyHandCycle::end(std::string why) {
  state_ = State::kIdle;
  problem_ = std::move(why);
}

}  // namespace palpate
