// The small steps after the stop of a grasp that keeps its limit, until the reading at rest is the
// limit.
#include <algorithm>
#include <string>
#include <utility>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/preshape.h"

#include "control/grasp_texts.h"

namespace palpate {
namespace {

constexpr double kEasingDegPerS = 1.0;
constexpr double kEasedTimes = 1.12;  // of the limit: the hand gives way until the reading is below
constexpr double kGoalTimes = 1.06;   // to which a step goes
constexpr double kSmallestStepDeg = 0.005;
constexpr double kLargestStepDeg = 0.5;
constexpr double kLargestClosingDeg = 0.1;
constexpr double kFirstStepDeg = 0.02;  // where nothing is known of the object
constexpr double kStepShare = 0.9;      // of the step that would meet the limit
constexpr double kNoFall = 0.02;        // a smaller fall tells nothing of the slope
// A reading is at rest when it changes by less than this part of the limit in so many frames.
constexpr double kSteadyTimes = 0.05;
constexpr int kRestFrames = 12;
constexpr int kSteadyFrames = 4;  // are enough to go on giving way
constexpr std::int64_t kEasingUs = 30'000'000;

}  // namespace

void GraspStateMachine::beginEasing(std::int64_t monoUs) {
  state_ = State::kEasing;
  command_.reset();
  stillSinceUs_ = monoUs;
  if (easingUntilUs_ == 0) easingUntilUs_ = monoUs + kEasingUs;
  easedDeg_ = 0.0;
  follows_ = false;
  restFrames_ = stillFrames_ = 0;
}

// The fingers open while the reading at rest is above the limit. They follow an object that gave
// way, as one does that was pushed by two of them and isn't held yet.
void GraspStateMachine::onEasingFrame(const FrameEvent& frame) {
  const std::int64_t monoUs = frame.monoUs;
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

void GraspStateMachine::onEasingTime(std::int64_t monoUs) {
  if (monoUs > stream_.deadAtUs())
    end(GraspOutcome::kStreamLost,
        report_.text + "; no more tactile frames arrive" + std::string(kNotEased));
}

void GraspStateMachine::onStepEnd(const std::vector<int>&, std::int64_t monoUs) {
  underWay_.reset();
  // After a step that followed the slope is not known: the object moved.
  if (follows_) return beginEasing(monoUs);
  state_ = State::kEasing;
  stillSinceUs_ = monoUs;
  restFrames_ = stillFrames_ = 0;
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
  send(std::move(motion), State::kEasingStep, monoUs);
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

}  // namespace palpate
