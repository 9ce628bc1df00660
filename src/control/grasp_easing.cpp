// The part of the state machine that keeps the limit: the slow part of the approach, and the small
// steps after the stop until the reading at rest is the limit.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

// A reading that rises by this much, and by this part of the limit, is a touch.
constexpr float kTouchCounts = 10.0F;
constexpr float kTouchShare = 0.1F;
constexpr double kTouchDelayS = 0.2;  // between a touch and the frame that shows it, at most

constexpr double kEasingDegPerS = 1.0;
constexpr double kEasedTimes = 1.12;  // of the limit: the hand gives way until the reading is below
constexpr double kGoalTimes = 1.06;   // to which a step goes
constexpr double kSmallestStepDeg = 0.005;
constexpr double kLargestStepDeg = 0.5;
constexpr double kLargestClosingDeg = 0.1;
constexpr double kFirstStepDeg = 0.02;  // where nothing is known of the object
// The slope while it closes is measured through the lag of the rubber: it may be this much steeper.
constexpr double kSteeper = 2.0;
constexpr double kStepShare = 0.9;  // of the step that would meet the limit
constexpr double kNoFall = 0.02;    // a smaller fall tells nothing of the slope
// A reading is at rest when it changes by less than this part of the limit in so many frames.
constexpr double kSteadyTimes = 0.05;
constexpr int kRestFrames = 12;
constexpr int kSteadyFrames = 4;  // are enough to go on giving way
constexpr std::int64_t kEasingUs = 30'000'000;

}  // namespace

std::optional<double> GraspStateMachine::presentRatio() const {
  return closeRatioOf(report_.request, anglesDeg_);
}

bool GraspStateMachine::isTouching() const noexcept {
  return peak_.counts >
         restCounts_ + std::max(kTouchCounts, kTouchShare * static_cast<float>(limit_));
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
  send(motionTo(motion, motion.closeRatio, hand_, anglesDeg_), GraspPhase::kClosing, monoUs);
}

// Of a frame that is not over the limit.
void GraspStateMachine::watchTouch(std::int64_t monoUs) {
  if (!isTouching()) return;
  if (!report_.touch) noteTouch(monoUs);
  if (!approaching_) return;
  isNear_ = true;
  note("touch", "touches before it was expected: closing slowly from here", peak_.matrix);
  pause(Next::kClose, "touched", monoUs);
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

double GraspStateMachine::timesLimit() const noexcept {
  const TaxelPeak& loaded = loadedTaxel(report_.request);
  const int lower = report_.request.limitCounts - limitOf(report_.request, fingerOf(loaded.matrix));
  double times = static_cast<double>(loaded.counts) / std::max(limit_ - lower, 1);
  if (!forces_) return times;
  for (std::size_t finger = 0; finger < forces_->forcesN().size(); ++finger)
    if (const auto limitN = forceLimitOf(report_.request, finger))
      times = std::max(times, forces_->forcesN()[finger] / *limitN);
  return times;
}

void GraspStateMachine::beginEasing(std::int64_t monoUs) {
  phase_ = GraspPhase::kEasing;
  command_.reset();
  stillSinceUs_ = monoUs;
  if (easingUntilUs_ == 0) easingUntilUs_ = monoUs + kEasingUs;
  easedDeg_ = 0.0;
  follows_ = false;
  restFrames_ = stillFrames_ = 0;
}

// The fingers open while the reading at rest is above the limit. They follow an object that gave
// way, as one does that was pushed by two of them and isn't held yet.
void GraspStateMachine::onEasingFrame(std::int64_t monoUs) {
  const double times = timesLimit();
  const bool isLate = monoUs >= easingUntilUs_;
  const bool areAnglesKnown = anglesUs_ > stillSinceUs_ && anglesDeg_.size() == hand_.axes.size();
  ++stillFrames_;
  if (times < kKeptFromLimit) {
    if (isLate || presentRatio().value_or(0.0) >= report_.request.closeRatio)
      return endEasing(monoUs);
    if (stillFrames_ < kSteadyFrames || !areAnglesKnown) return;
    const double step = kStepShare * (1.0 - times) / std::max(steepest_, 1e-9);
    return moveBy(-std::clamp(step, kSmallestStepDeg, kLargestClosingDeg), monoUs);
  }
  // The reading is at rest when it hardly changes during some frames.
  restTimes_ = restFrames_++ == 0 ? std::pair(times, times)
                                  : std::pair(std::min(restTimes_.first, times),
                                              std::max(restTimes_.second, times));
  if (restTimes_.second - restTimes_.first > kSteadyTimes) restFrames_ = 0;
  if (times <= kEasedTimes && restFrames_ >= kRestFrames) return endEasing(monoUs);
  if (isLate && (times <= kKeptToLimit || monoUs >= easingUntilUs_ + kEasingUs))
    return endEasing(monoUs);
  if (times <= kEasedTimes || restFrames_ < kSteadyFrames || !areAnglesKnown) return;
  if (easedDeg_ > 0.0) {
    const double fell = easedTimes_ - times;
    timesPerDeg_ = fell > kNoFall ? fell / easedDeg_ : timesPerDeg_ / 2.0;
    steepest_ = std::max(steepest_, timesPerDeg_);
  }
  const double step = kStepShare * (times - kGoalTimes) / std::max(timesPerDeg_, 1e-9);
  easedTimes_ = times;
  easedDeg_ =
      timesPerDeg_ > 0.0 ? std::clamp(step, kSmallestStepDeg, kLargestStepDeg) : kFirstStepDeg;
  moveBy(easedDeg_, monoUs);
}

// Opens each joint from where it is, or closes it with a negative angle of the fastest one [deg].
// No joint closes while the others open, whatever holds it.
void GraspStateMachine::moveBy(double openingDeg, std::int64_t monoUs) {
  const Preshape& preshape = sdh2Preshape(report_.request.preshape);
  const double ratio = openingDeg / std::max(fastestSlopeDeg(preshape), 1e-9);
  GraspRequest request = report_.request;
  follows_ = openingDeg < 0.0;
  request.velocityDegPerS = follows_ ? slowDegPerS(request, *approach_, limit_) : kEasingDegPerS;
  MoveJoints motion = motionTo(request, request.closeRatio, hand_);
  for (std::size_t axis = 0; axis < motion.targetDeg.size(); ++axis)
    motion.targetDeg[axis] = std::clamp(anglesDeg_[axis] - preshape.joints[axis].slopeDeg * ratio,
                                        hand_.axes[axis].minimumDeg,
                                        hand_.axes[axis].maximumDeg);
  send(std::move(motion), GraspPhase::kEasing, monoUs);
}

void GraspStateMachine::endEasing(std::int64_t monoUs) {
  report_.peakAtRest = loadedTaxel(report_.request);
  if (report_.touch && closingDegPerS_ <= slowDegPerS(report_.request, *approach_, limit_)) {
    const double rise = static_cast<double>(commonCounts(*report_.peakAfterStop, report_.request) -
                                            static_cast<float>(limit_));
    report_.touch->riseCounts = std::max(rise, 0.0) / closingDegPerS_;
    if (report_.forceFinger)
      report_.touch->riseN =
          std::max(report_.forceAfterStopN - *forceLimitOf(report_.request, *report_.forceFinger),
                   0.0) /
          closingDegPerS_;
  }
  if (peak_.counts <= restCounts_)
    return end(GraspOutcome::kFinished, std::string(kNothingHeldText));
  if (isSlipAware()) return settle(monoUs);
  end(GraspOutcome::kLimitReached, report_.text + riseText() + restText());
}

std::string GraspStateMachine::restText() const {
  std::string text = "; at its end ";
  if (report_.forceFinger) text += fixedText(forces_->forcesN()[*report_.forceFinger], 2) + " N, ";
  text += numberText(report_.peakAtRest->counts) + " counts";
  const double times = timesLimit();
  return times > kKeptToLimit || times < kKeptFromLimit ? text + ", " + timesText() : text;
}

std::string GraspStateMachine::timesText() const {
  return fixedText(timesLimit(), 1) + " times the limit";
}

}  // namespace palpate
