#include "palpate/control/empty_hand_cycle.h"

#include <exception>
#include <utility>

#include "palpate/core/time.h"

namespace palpate {

EmptyHandCycle::EmptyHandCycle(GraspControl& control, Options options)
    : control_(control), options_(std::move(options)) {}

void EmptyHandCycle::begin(std::int64_t hostUs) {
  state_ = State::kIdle;
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

std::optional<std::string> EmptyHandCycle::step(std::int64_t hostUs) {
  if (state_ == State::kIdle) return std::nullopt;
  const double seconds = static_cast<double>(hostUs - sinceUs_) / kUsPerS;
  const GraspStatus status = control_.status();
  if (status.stopsAsked != stopsBefore_) return ended("the hand was stopped");
  if (state_ == State::kClosing) {
    if (status.phase != GraspPhase::kIdle || !status.last || status.last->beginUs < sinceUs_)
      return std::nullopt;
    const GraspOutcome outcome = status.last->outcome;
    if (outcome != GraspOutcome::kLimitReached && outcome != GraspOutcome::kFinished)
      return ended(status.last->text);
    state_ = State::kHolding;
    sinceUs_ = hostUs;
    return std::nullopt;
  }
  if (state_ == State::kOpening) {
    if (seconds > options_.maxOpenS) return ended("the pads didn't touch, or don't separate");
    return std::nullopt;
  }
  if (status.phase != GraspPhase::kIdle) return ended("the hand does something else");
  if (seconds < options_.holdS) return std::nullopt;
  try {
    control_.preshape(options_.preshape, options_.openingDegPerS);
  } catch (const std::exception& error) {
    return ended(error.what());
  }
  state_ = State::kOpening;
  sinceUs_ = hostUs;
  return std::nullopt;
}

std::optional<std::string> EmptyHandCycle::onPadsReleased() {
  if (state_ == State::kOpening) {
    state_ = State::kIdle;
    return std::nullopt;
  }
  return ended("the pads let go of each other");
}

std::string EmptyHandCycle::ended(std::string why) {
  state_ = State::kIdle;
  return why;
}

}  // namespace palpate
