// The motions of a grasp: to its start, and closing until the limit. Of a grasp that keeps its
// limit, also where it touches.
#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/core/time.h"
#include "palpate/device/sdh2.h"
#include "palpate/device/sdh_protocol.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

constexpr std::int64_t kAnswerUs = 5'000'000;  // time limit for the answer to a motion
// Limit of the motion time relative to the announced one: pressing fingers become slower.
constexpr double kDurationFactor = 3.0;
constexpr double kDurationMoreS = 5.0;
// Limit of the time by which a motion without resistance exceeds the announced duration, or the one
// given by its velocity alone [s].
constexpr double kStartAndStopS = 0.5;

// A reading that rises by this much, and by this part of the limit, is a touch.
constexpr float kTouchCounts = 10.0F;
constexpr float kTouchShare = 0.1F;
constexpr double kTouchDelayS = 0.2;  // between a touch and the frame that shows it, at most
// The slope while it closes is measured through the lag of the rubber: it may be this much steeper.
constexpr double kSteeper = 2.0;

}  // namespace

void GraspStateMachine::send(MoveJoints motion, State state, std::int64_t monoUs) {
  underWay_ = motion;
  command_ = std::move(motion);
  state_ = state;
  sentUs_ = monoUs;
  acknowledged_ = false;
  announcedUs_ = acknowledgedUs_ = 0;
  motionTimeoutUs_ = monoUs + kAnswerUs;
}

void GraspStateMachine::onMoveAcknowledged(double durationS, std::int64_t monoUs) {
  if (!isMoving() || acknowledged_) return;
  acknowledged_ = true;
  acknowledgedUs_ = monoUs;
  // A duration that is not finite counts as none.
  const double seconds = std::isfinite(durationS) ? std::clamp(durationS, 0.0, 1e4) : 0.0;
  announcedUs_ = monoUs + std::llround(seconds * 1e6);
  motionTimeoutUs_ = monoUs + std::llround((seconds * kDurationFactor + kDurationMoreS) * 1e6);
}

// Longest time for which the motion sent last can continue without control [s]; 0 if none runs.
double GraspStateMachine::remainingMotionS(std::int64_t monoUs) const {
  if (!underWay_) return 0.0;
  double seconds = 0.0;
  for (std::size_t axis = 0; axis < underWay_->targetDeg.size(); ++axis) {
    const double target = underWay_->targetDeg[axis];
    // Without known angles the axes may be anywhere in their range.
    const double travel =
        anglesDeg_.size() == underWay_->targetDeg.size()
            ? std::abs(target - anglesDeg_[axis])
            : std::max(target - hand_.axes[axis].minimumDeg, hand_.axes[axis].maximumDeg - target);
    seconds = std::max(seconds, travel / std::max(1e-3, underWay_->velocityDegPerS[axis]));
  }
  if (announcedUs_ <= acknowledgedUs_) return seconds + kStartAndStopS;
  // What was announced came in a line without a checksum.
  const double announcedS = static_cast<double>(announcedUs_ - monoUs) / 1e6 + kStartAndStopS;
  return std::clamp(announcedS, 0.0, seconds * kDurationFactor + kDurationMoreS);
}

// Of a motion whose reading may rise.
void GraspStateMachine::onMovingFrame(const FrameEvent& frame) {
  const bool opens = state_ == State::kEasingStep && !follows_;
  if (!opens && isOverLimit()) return onLimit(frame);
  if (frame.silenceUs) return stopForSilence(*frame.silenceUs, frame.monoUs);
  if (approach_ && state_ == State::kClosing && !held_) watchTouch(frame.monoUs);
}

void GraspStateMachine::onLimit(const FrameEvent& frame) {
  closedToLimit_ = state_ != State::kPreshaping;
  report_.peakAfterStop = report_.peak = loadedTaxel(report_.request);
  report_.limitUs = frame.hostUs;
  report_.forceFinger.reset();
  std::string text = placeOf(report_.peak);
  // The limit in counts is named where both are exceeded in the same frame.
  if (!(loadCounts() > static_cast<float>(limit_))) {
    report_.forceFinger = fingerOverForce(report_.request, forces_);
    report_.forceN = report_.forceAfterStopN = forces_->forcesN()[*report_.forceFinger];
    text = forceText(*report_.forceFinger);
  }
  text = "limit reached: " + text;
  if (approach_ && closedToLimit_ && !held_) {
    noteSlope(frame.monoUs);
    // What closes from here on is slow, wherever the hand is.
    isNear_ = true;
    approaching_ = false;
    return pause(State::kEasing, text, frame.monoUs);
  }
  if (isSlipAware() && state_ == State::kClosing)
    return pause(State::kSettling, text, frame.monoUs);
  stopWith(GraspOutcome::kLimitReached, text, frame.monoUs);
}

void GraspStateMachine::onMovingTime(std::int64_t monoUs) {
  if (underTactileControl() && monoUs > stream_.deadAtUs())
    return stopForSilence(stream_.silenceUs(monoUs).value_or(0), monoUs);
  if (monoUs > motionTimeoutUs_)
    stopWith(GraspOutcome::kFailed,
             acknowledged_ ? "failed: the motion didn't end in time: stopped"
                           : "failed: the hand didn't answer: stopped",
             monoUs);
}

void GraspStateMachine::onMotionEnd(const std::vector<int>& states, std::int64_t monoUs) {
  std::string axes;
  underWay_.reset();
  report_.heldAxes.clear();
  for (std::size_t axis = 0; axis < states.size(); ++axis) {
    if (!sdhAxisBlocks(states[axis])) continue;
    report_.heldAxes.push_back(static_cast<int>(axis));
    axes += (axes.empty() ? "" : ", ") +
            (axis < hand_.axes.size() ? hand_.axes[axis].name : std::to_string(axis));
  }
  if (axes.empty() && (state_ == State::kPreshaping || approaching_)) {
    isNear_ = approaching_;
    return close(monoUs);
  }
  // A slip-aware grasp continues with the object that it touches.
  if (isSlipAware() && state_ != State::kPreshaping && grip_.touches()) {
    // It may have been blocked in the fast part of its way: over an object nothing is fast.
    isNear_ = true;
    approaching_ = false;
    return pause(State::kSettling, "closed as far as it goes", monoUs);
  }
  // It closed again because something slipped, and touches nothing now.
  const bool lost = isSlipAware() && held_;
  const bool closes = !isJointMotion(report_.request) && report_.request.closeRatio > 0.0;
  const bool touchesNothing = closes && stream_.alive(monoUs) && !isTouched(peak_.counts);
  const std::string text = !axes.empty()    ? "finished: held at the joints: " + axes
                           : lost           ? std::string(kNothingHeldText)
                           : touchesNothing ? "finished: at its target, touching nothing"
                                            : "finished: at its target";
  // Motors of blocked axes keep pushing. After the grasp the taxels are no longer monitored, so the
  // motion must be stopped.
  if (!axes.empty() && underTactileControl())
    return stopWith(GraspOutcome::kFinished, text + "; the limit was not reached", monoUs);
  end(GraspOutcome::kFinished, text);
}

void GraspStateMachine::close(std::int64_t monoUs) {
  GraspRequest motion = report_.request;
  approaching_ = false;
  if (approach_) {
    // Where the joints' angles are not known nothing is fast.
    const auto present = presentRatio();
    approaching_ = !isNear_ && present && *present < approach_->fastToRatio;
    if (approaching_)
      motion.closeRatio = approach_->fastToRatio;
    else
      motion.velocityDegPerS = slowDegPerS(motion, *approach_, limit_);
  }
  closingDegPerS_ = motion.velocityDegPerS;
  send(motionTo(motion, motion.closeRatio, hand_, anglesDeg_), State::kClosing, monoUs);
}

// Of a frame that is not over the limit.
void GraspStateMachine::watchTouch(std::int64_t monoUs) {
  const float rise = std::max(kTouchCounts, kTouchShare * static_cast<float>(limit_));
  if (!(peak_.counts > restCounts_ + rise)) return;
  if (!report_.touch) noteTouch(monoUs);
  if (!approaching_) return;
  isNear_ = true;
  note("touch", "touches before it was expected: closing slowly from here", peak_.matrix);
  pause(State::kClosing, "touched", monoUs);
}

void GraspStateMachine::noteTouch(std::int64_t monoUs) {
  touchedUs_ = monoUs;
  touchedTimes_ = timesLimit();
  const double slope = std::max(fastestSlopeDeg(sdh2Preshape(report_.request.preshape)), 1e-9);
  if (const auto present = presentRatio())
    report_.touch =
        Touch{.ratio = std::max(*present - closingDegPerS_ * kTouchDelayS / slope, 0.0)};
}

// Over the limit: how steeply the reading rose with the angle since the touch.
void GraspStateMachine::noteSlope(std::int64_t monoUs) {
  if (!report_.touch) return noteTouch(monoUs);
  const double deg = closingDegPerS_ * static_cast<double>(monoUs - touchedUs_) / kUsPerS;
  if (!follows_ && deg > 0.0)
    steepest_ = timesPerDeg_ = kSteeper * (timesLimit() - touchedTimes_) / deg;
}

}  // namespace palpate
