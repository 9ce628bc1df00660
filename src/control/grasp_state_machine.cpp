#include "palpate/control/grasp_state_machine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/device/sdh_protocol.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

constexpr std::int64_t kAnswerUs = 5'000'000;   // time limit for the answer to a motion
constexpr std::int64_t kStopAgainUs = 250'000;  // an unanswered stop is sent again after this time
// Stops are repeated for as long as the motion could last, and for this time [s].
constexpr double kStopMoreS = 10.0;
constexpr std::int64_t kMissedStops = 4;
constexpr std::string_view kStopsAreSent = ": stops are sent until one is answered";
// Limit of the motion time relative to the announced one: pressing fingers become slower.
constexpr double kDurationFactor = 3.0;
constexpr double kDurationMoreS = 5.0;
// Limit of the time by which a motion without resistance exceeds the announced duration, or the one
// given by its velocity alone [s].
constexpr double kStartAndStopS = 0.5;
// The rubber has a lag of 0.16 s: after three lags it has almost settled.
constexpr std::int64_t kLookOnUs = 500'000;
constexpr float kRiseCounts = 10.0F;   // a smaller rise is noise
constexpr double kStillRisen = 0.5;    // of the rise: below it the rise is past
constexpr double kFarOverLimit = 1.5;  // the report mentions a rise to this multiple of the limit

// Axis states of the SDH-2.
constexpr int kBlockedClockwise = 4;
constexpr int kBlockedCounterClockwise = 5;

// Joints that changed by less were not moved by anybody.
constexpr double kUnmovedDeg = 0.2;
// The creep of the rubber raises a reading to no more than this multiple of what was left.
constexpr float kMaxCreep = 1.5F;

constexpr std::string_view kNotEased = ": the hand holds, perhaps above its limit";
std::string millisecondsText(std::int64_t us) {
  return fixedText(static_cast<double>(us) / 1e3, 0);
}

constexpr double kLooseningDegPerS = 1.0;
// Opening for the measurement of friction ends at this fraction of the limit: a safe hold is more
// important than the result.
constexpr double kLeastOfLimit = 0.25;
constexpr double kLongestLooseningS = 20.0;
// A hold ends after a longer silence of the stream.
constexpr std::int64_t kLongestSilenceUs = 1'000'000;

std::int64_t microsecondsOf(double seconds) { return std::llround(seconds * 1e6); }

// The largest taxel of each matrix, into `peaks`; returns the largest of all.
TaxelPeak taxelPeaks(const TactileFrame& frame, std::vector<TaxelPeak>& peaks) {
  peaks.resize(frame.layout->numMatrices());
  TaxelPeak largest;
  for (std::size_t m = 0; m < peaks.size(); ++m) {
    peaks[m] = taxelPeak(frame, m);
    if (peaks[m].counts > largest.counts) largest = peaks[m];
  }
  return largest;
}

}  // namespace

std::string_view nameOf(GraspPhase phase) {
  switch (phase) {
    case GraspPhase::kIdle:
      break;
    case GraspPhase::kPreshaping:
      return "preshaping";
    case GraspPhase::kClosing:
      return "closing";
    case GraspPhase::kStopping:
      return "stopping";
    case GraspPhase::kSettling:
      return "settling";
    case GraspPhase::kEasing:
      return "easing";
    case GraspPhase::kHolding:
      return "holding";
    case GraspPhase::kLoosening:
      return "loosening";
  }
  return "idle";
}

void GraspStateMachine::refuse(const std::string& why) const {
  throw DeviceError(DeviceFault::kRefused, "grasp", why);
}

int GraspStateMachine::fingerOf(std::size_t matrix) const noexcept {
  return matrix < hand_.matrices.size() ? hand_.matrices[matrix].finger : -1;
}

std::string GraspStateMachine::placeOf(const TaxelPeak& peak) const {
  return hand_.matrixName(peak.matrix) + ", x " + std::to_string(peak.column) + ", y " +
         std::to_string(peak.row) + ": " + numberText(peak.counts) + " counts";
}

void GraspStateMachine::begin(const GraspRequest& request,
                              std::int64_t monoUs,
                              std::int64_t hostUs,
                              const std::optional<Touch>& touch) {
  request.validate();
  if (active()) refuse("refused: the hand is " + std::string(nameOf(phase_)) + "; stop it first");
  std::optional<FingerForces> forces;
  bool goesOn = false;
  if (request.mode != GraspMode::kPlain) {
    if (!stream_.alive(monoUs)) {
      const auto silence = stream_.silenceUs(monoUs);
      refuse("refused: a " +
             std::string(request.mode == GraspMode::kSlip ? "slip-aware" : "reactive") +
             " grasp needs tactile frames, and " +
             (silence ? "none has arrived for " + millisecondsText(*silence) + " ms"
                      : std::string("none has arrived yet")));
    }
    requireMeasurableLimit(request);
    const TaxelPeak& loaded = loadedTaxel(request);
    const bool isOver = commonCounts(loaded, request) > static_cast<float>(request.limitCounts);
    const bool holds = holdsAlready(request);
    if (!holds && isOver)
      refuse("refused: over the limit of " +
             std::to_string(limitOf(request, fingerOf(loaded.matrix))) + " already, at " +
             placeOf(loaded) + "; open the hand, or raise the limit");
    forces = forcesFor(request, holds);
    goesOn = holds && (isOver || fingerOverForce(request, forces));
  }
  GraspReport report;
  report.request = request;
  report.beginUs = hostUs;
  report.limitCounts = request.limitCounts;
  if (goesOn) {
    // A slip may have raised the limit at which it is held.
    report.limitCounts = std::max(report_.limitCounts, request.limitCounts);
    report.peak = report_.peak;
    report.peakAfterStop = report_.peakAfterStop;
    report.forceFinger = report_.forceFinger;
    report.forceN = report_.forceN;
    report.forceAfterStopN = report_.forceAfterStopN;
  }
  // Both motions are checked before the first one is sent.
  if (request.startRatio) motionTo(request, *request.startRatio, hand_);
  motionTo(request, request.closeRatio, hand_, anglesDeg_);
  forces_ = std::move(forces);
  report_ = report;
  limit_ = report_.limitCounts;
  next_ = Next::kEnd;
  stopsBlindly_ = reportedOverLimit_ = interrupted_ = false;
  held_ = slippedAtLimit_ = frictionTestRunning_ = frictionTested_ = false;
  closedToLimit_ = false;
  endUs_ = heldFromUs_ = 0;
  silenceLimitUs_ = stream_.silenceLimitUs();
  answeredSlips_ = 0;
  notes_.clear();
  grip_.reset();
  approach_.reset();
  if (keepsLimit(request)) approach_ = approachOf(request, touch);
  approaching_ = false;
  isNear_ = goesOn;
  heldDeg_.clear();
  restCounts_ = peak_.counts;
  timesPerDeg_ = steepest_ = 0.0;
  follows_ = false;
  easingUntilUs_ = 0;
  if (goesOn) {
    const TaxelPeak& loaded = loadedTaxel(request);
    note("already", "holds already, at " + placeOf(loaded) + ": nothing moves", loaded.matrix);
    settle(monoUs);
  } else if (request.startRatio) {
    send(motionTo(request, *request.startRatio, hand_), GraspPhase::kPreshaping, monoUs);
  } else {
    close(monoUs);
  }
}

bool GraspStateMachine::holdsAlready(const GraspRequest& request) const {
  const GraspRequest& last = report_.request;
  if (request.mode != GraspMode::kSlip || request.startRatio || isJointMotion(request) ||
      isJointMotion(last) || heldDeg_.size() != anglesDeg_.size())
    return false;
  const auto terms = [](const GraspRequest& of) {
    return std::tie(of.preshape,
                    of.closeRatio,
                    of.object,
                    of.limitCounts,
                    of.fingerLimitCounts,
                    of.forceLimitsN,
                    of.keepsLimit);
  };
  const float left = report_.peakAfterStop ? commonCounts(*report_.peakAfterStop, request) : 0.0F;
  const float most = kMaxCreep * std::max(left, static_cast<float>(report_.limitCounts));
  if (terms(request) != terms(last) || commonCounts(loadedTaxel(request), request) > most)
    return false;
  return !heldDeg_.empty() &&
         std::equal(heldDeg_.begin(), heldDeg_.end(), anglesDeg_.begin(), [](double a, double b) {
           return std::abs(a - b) < kUnmovedDeg;
         });
}

// Throws when a matrix that may come into contact can't measure the limit.
void GraspStateMachine::requireMeasurableLimit(const GraspRequest& request) const {
  std::string text;
  for (const UnmeasurableLimit& unfelt : unmeasurableLimits(hand_, settings_, request))
    text += (text.empty() ? "" : "; ") + unfelt.why;
  if (!text.empty())
    refuse("refused: a limit of " + std::to_string(maxLimitOf(request)) +
           " counts can't be measured: " + text);
}

bool GraspStateMachine::isOverLimit() const noexcept {
  // The limit is below saturation: see requireMeasurableLimit().
  return loadCounts() > static_cast<float>(limit_) || fingerOverForce(report_.request, forces_);
}

float GraspStateMachine::commonCounts(const TaxelPeak& peak,
                                      const GraspRequest& request) const noexcept {
  return peak.counts +
         static_cast<float>(request.limitCounts - limitOf(request, fingerOf(peak.matrix)));
}

const TaxelPeak& GraspStateMachine::loadedTaxel(const GraspRequest& request) const noexcept {
  if (request.fingerLimitCounts.empty()) return peak_;
  const TaxelPeak* loaded = &peak_;
  for (const TaxelPeak& each : matrixPeaks_)
    if (each.counts > 0.0F && commonCounts(each, request) > commonCounts(*loaded, request))
      loaded = &each;
  return *loaded;
}

std::optional<std::size_t> GraspStateMachine::fingerOverForce(
    const GraspRequest& request,
    const std::optional<FingerForces>& forces,
    std::optional<std::size_t> except) noexcept {
  if (!forces) return std::nullopt;
  for (std::size_t finger = 0; finger < forces->forcesN().size(); ++finger)
    if (const auto limitN = forceLimitOf(request, finger);
        finger != except && limitN && !(forces->forcesN()[finger] <= *limitN))
      return finger;
  return std::nullopt;
}

std::string GraspStateMachine::forceText(std::size_t finger) const {
  return "finger " + std::to_string(finger) + ": " + fixedText(forces_->forcesN()[finger], 2) +
         " N";
}

void GraspStateMachine::setSettings(std::vector<MatrixSettings> settings) {
  if (settings != settings_) forgetHeld();  // counts mean something else
  settings_ = std::move(settings);
}

void GraspStateMachine::setCalibration(std::optional<Calibration> calibration) {
  forgetHeld();
  calibration_ = std::move(calibration);
}

// Throws when a force limit of the request can't be measured, or is exceeded already and may not
// be.
std::optional<FingerForces> GraspStateMachine::forcesFor(const GraspRequest& request,
                                                         bool mayBeOver) const {
  if (request.forceLimitsN.empty()) return std::nullopt;
  if (!calibration_)
    refuse("refused: a limit in newtons needs a calibration of this hand, and none is applied");
  std::optional<FingerForces> forces;
  try {
    forces.emplace(*calibration_, hand_, settings_);
    if (newest_.layout) forces->apply(newest_, degC_);
  } catch (const std::invalid_argument& error) {
    refuse("refused: forces can't be measured: " + std::string(error.what()));
  }
  for (std::size_t finger = 0; finger < forces->forcesN().size(); ++finger) {
    const auto limitN = forceLimitOf(request, finger);
    const double largestN = forces->largestN(finger);
    if (limitN && !(*limitN <= largestN))
      refuse("refused: a limit of " + numberText(*limitN) + " N would not be felt: finger " +
             std::to_string(finger) + " measures no more than " + fixedText(largestN, 1) + " N");
    if (!mayBeOver && limitN && !(forces->forcesN()[finger] <= *limitN))
      refuse("refused: over the limit of " + numberText(*limitN) + " N already, at finger " +
             std::to_string(finger) + ": " + fixedText(forces->forcesN()[finger], 2) +
             " N; open the hand, or raise the limit");
  }
  return forces;
}

// True when the matrices have changed, or the set of scanned taxels.
bool GraspStateMachine::updateLayout(const TactileFrame& frame) {
  if (!frame.layout || frame.layout == hand_.layout) return false;
  const bool another = !(*frame.layout == *hand_.layout);
  if (another) {
    forgetHeld();
    hand_ = describeHand(*frame.layout, hand_.axes.size(), hand_.temperatureSensors.size());
    grip_ = GripMonitor(hand_);
    forces_.reset();
  }
  hand_.layout = frame.layout;
  return another;
}

void GraspStateMachine::send(MoveJoints motion, GraspPhase phase, std::int64_t monoUs) {
  underWay_ = motion;
  command_ = std::move(motion);
  phase_ = phase;
  sentUs_ = monoUs;
  acknowledged_ = false;
  announcedUs_ = acknowledgedUs_ = 0;
  motionTimeoutUs_ = monoUs + kAnswerUs;
}

void GraspStateMachine::onFrame(const TactileFrame& frame, std::int64_t monoUs) {
  const auto noticed = unwatchedUs(monoUs);
  const auto silence = stream_.frame(frame.hostUs, monoUs);
  const bool anotherLayout = updateLayout(frame);
  peak_ = taxelPeaks(frame, matrixPeaks_);
  if (!active() && peak_.counts <= 0.0F) forgetHeld();
  if (calibration_) newest_ = frame;
  if (anotherLayout && underTactileControl())
    return fault("the layout of the tactile sensor is another one than at the begin", monoUs);
  if (active() && forces_) forces_->apply(frame, degC_);
  if (active() && isSlipAware()) grip_.onFrame(frame);
  // From the stop until the reading has settled.
  if (report_.peakAfterStop && (phase_ == GraspPhase::kStopping ||
                                phase_ == GraspPhase::kSettling || phase_ == GraspPhase::kEasing))
    measurePeakAfterStop();
  if (observesOvershoot()) return;
  if (stopsBlindly_ && underTactileControl() && isOverLimit()) return onOverLimitUnanswered(monoUs);
  if (isHolding() && (noticed || silence))
    return onFramesBack(std::max(noticed.value_or(0), silence.value_or(0)), monoUs);
  if (isHolding()) return onHoldingFrame(monoUs);
  if (phase_ == GraspPhase::kEasing && !underWay_) return onEasingFrame(monoUs);
  if (!isMoving() || !underTactileControl()) return;
  if (phase_ == GraspPhase::kLoosening && !silence) return onLooseningFrame(monoUs);
  const bool eases = phase_ == GraspPhase::kEasing;
  const bool opens = phase_ == GraspPhase::kLoosening || (eases && !follows_);
  if (!opens && isOverLimit()) {
    closedToLimit_ = phase_ != GraspPhase::kPreshaping;
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
    if (approach_ && (eases || phase_ == GraspPhase::kClosing) && !held_) {
      noteSlope(monoUs);
      // What closes from here on is slow, wherever the hand is.
      isNear_ = true;
      approaching_ = false;
      return pause(Next::kEase, text, monoUs);
    }
    if (isSlipAware() && phase_ == GraspPhase::kClosing) return pause(Next::kSettle, text, monoUs);
    stopWith(GraspOutcome::kLimitReached, text, monoUs);
  } else if (silence) {
    stopWith(GraspOutcome::kStreamLost,
             "stopped: no tactile frames for " + millisecondsText(*silence) + " ms",
             monoUs);
  } else if (approach_ && phase_ == GraspPhase::kClosing && !held_) {
    watchTouch(monoUs);
  }
}

// Over the limit, and no stop has been answered.
void GraspStateMachine::onOverLimitUnanswered(std::int64_t monoUs) {
  if (std::exchange(reportedOverLimit_, true)) return;
  stopAgain(monoUs);
  const TaxelPeak& loaded = loadedTaxel(report_.request);
  note("over_limit",
       "over the limit at " + placeOf(loaded) +
           ", and no stop is answered: use the power switch if the hand moves",
       loaded.matrix);
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

void GraspStateMachine::onAxisStates(const std::vector<int>& states, std::int64_t monoUs) {
  if (!isMoving() || !acknowledged_ || states.empty()) return;
  bool held = false;
  for (const int state : states) {
    if (sdhAxisMoves(state)) return;
    held = held || state == kBlockedClockwise || state == kBlockedCounterClockwise;
  }
  // Old firmware reports "idle" too early.
  if (!held && monoUs < announcedUs_) return;
  motionEnded(states, monoUs);
}

void GraspStateMachine::motionEnded(const std::vector<int>& states, std::int64_t monoUs) {
  std::string axes;
  underWay_.reset();
  if (phase_ == GraspPhase::kEasing) {
    // After a step that followed the slope is not known: the object moved.
    if (follows_) return beginEasing(monoUs);
    stillSinceUs_ = monoUs;
    restFrames_ = stillFrames_ = 0;
    return;
  }
  report_.heldAxes.clear();
  for (std::size_t axis = 0; axis < states.size(); ++axis) {
    if (states[axis] != kBlockedClockwise && states[axis] != kBlockedCounterClockwise) continue;
    report_.heldAxes.push_back(static_cast<int>(axis));
    axes += (axes.empty() ? "" : ", ") +
            (axis < hand_.axes.size() ? hand_.axes[axis].name : std::to_string(axis));
  }
  if (axes.empty() && (phase_ == GraspPhase::kPreshaping || approaching_)) {
    isNear_ = approaching_;
    return close(monoUs);
  }
  // A slip-aware grasp continues with the object that it touches.
  if (isSlipAware() && phase_ != GraspPhase::kPreshaping && grip_.touches())
    return pause(Next::kSettle, "closed as far as it goes", monoUs);
  // It closed again because something slipped, and touches nothing now.
  const bool lost = isSlipAware() && held_;
  const bool closes = !isJointMotion(report_.request) && report_.request.closeRatio > 0.0;
  const bool touchesNothing = closes && stream_.alive(monoUs) && peak_.counts <= 0.0F;
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

void GraspStateMachine::stopWith(GraspOutcome outcome,
                                 const std::string& text,
                                 std::int64_t monoUs) {
  interrupted_ = false;
  report_.outcome = outcome;
  phase_ = GraspPhase::kStopping;
  next_ = Next::kEnd;
  command_ = StopMotion{};  // replaces a motion that was not taken yet
  sentUs_ = stoppingSinceUs_ = monoUs;
  stoppingUntilUs_ = monoUs + microsecondsOf(remainingMotionS(monoUs) + kStopMoreS);
  report_.text = text;  // last, because it may find no memory
}

void GraspStateMachine::stopAgain(std::int64_t monoUs) {
  command_ = StopMotion{};
  sentUs_ = monoUs;
}

void GraspStateMachine::end(GraspOutcome outcome, const std::string& text) {
  stopsBlindly_ = interrupted_ = false;
  report_.outcome = outcome;
  report_.text = text;
  phase_ = GraspPhase::kIdle;
  command_.reset();
  ended_ = report_;
  if ((outcome == GraspOutcome::kLimitReached && closedToLimit_ && !isSlipAware()) ||
      (report_.held && (report_.holdTimeOver || outcome == GraspOutcome::kStopped)))
    heldDeg_ = anglesDeg_;
}

void GraspStateMachine::onStopAcknowledged(std::int64_t monoUs) {
  if (phase_ != GraspPhase::kStopping) return;
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
  if (next_ == Next::kEase) return beginEasing(monoUs);
  if (next_ == Next::kSettle) return settle(monoUs);
  if (next_ == Next::kClose) return close(monoUs);
  // A slip-aware grasp that was still moving to its start holds nothing, and must not close.
  if (report_.outcome == GraspOutcome::kLimitReached && !isSlipAware())
    return observeOvershoot(monoUs);
  end(report_.outcome, report_.text);
}

void GraspStateMachine::observeOvershoot(std::int64_t monoUs) {
  phase_ = GraspPhase::kSettling;
  command_.reset();
  settledUs_ = monoUs + kLookOnUs;
}

// Only after the limit was reached.
void GraspStateMachine::measurePeakAfterStop() {
  const TaxelPeak& loaded = loadedTaxel(report_.request);
  if (commonCounts(loaded, report_.request) > commonCounts(*report_.peakAfterStop, report_.request))
    report_.peakAfterStop = loaded;
  if (report_.forceFinger && forces_)
    report_.forceAfterStopN =
        std::max(report_.forceAfterStopN, forces_->forcesN()[*report_.forceFinger]);
}

// Text such as "; rose to 3222 counts after the stop, 16 times the limit: close more slowly", or
// empty. With a limit in newtons: "; rose to 23.1 N (2859 counts) after the stop, ..".
std::string GraspStateMachine::riseText() const {
  if (!report_.peakAfterStop || report_.peakAfterStop->counts < report_.peak.counts + kRiseCounts)
    return {};
  const int lower = report_.request.limitCounts -
                    limitOf(report_.request, fingerOf(report_.peakAfterStop->matrix));
  const double times =
      static_cast<double>(report_.peakAfterStop->counts) / std::max(limit_ - lower, 1);
  const std::string counts = numberText(report_.peakAfterStop->counts) + " counts";
  if (report_.forceFinger) {
    const double limitN =
        forceLimitOf(report_.request, *report_.forceFinger).value_or(report_.forceN);
    const double timesN = report_.forceAfterStopN / limitN;
    std::string text =
        "; rose to " + fixedText(report_.forceAfterStopN, 1) + " N (" + counts + ") after the stop";
    if (timesN >= kFarOverLimit && !approach_)
      text += ", " + fixedText(timesN, 1) + " times the limit: close more slowly";
    return text;
  }
  std::string text = "; rose to " + counts + " after the stop";
  if (times >= kFarOverLimit && !approach_)
    text += ", " + fixedText(times, 1) + " times the limit: close more slowly";
  return text;
}

// Text such as "; finger 1: 5.78 N, above its limit of 3 N: close more slowly" of a grasp that its
// limit in counts has stopped, or empty.
std::string GraspStateMachine::overForceText() const {
  const auto over = fingerOverForce(report_.request, forces_, report_.forceFinger);
  if (!over) return {};
  return "; " + forceText(*over) + ", above its limit of " +
         numberText(*forceLimitOf(report_.request, *over)) + " N: close more slowly";
}

void GraspStateMachine::endOvershoot() {
  end(report_.outcome, report_.text + riseText() + overForceText());
}

void GraspStateMachine::onCommandFailed(const std::string& why, bool sent, std::int64_t monoUs) {
  if (active() && !sent) return end(GraspOutcome::kRefused, "refused: " + why);
  // The hand may move nevertheless, because an answer can get lost. An unanswered stop is sent
  // again later.
  if (isMoving()) stopWith(GraspOutcome::kFailed, "failed: " + why, monoUs);
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

void GraspStateMachine::onMotionPortGone(const std::string& why, std::int64_t monoUs) {
  if (!active()) return;
  if (observesOvershoot()) return endOvershoot();  // the motion has stopped already
  report_.remainingMotionS = remainingMotionS(monoUs);
  const std::string gone = "the motion port is gone: " + why;
  if (underWay_) {
    const std::string text = gone + "; the hand finishes its motion by itself";
    return end(GraspOutcome::kPortGone,
               phase_ == GraspPhase::kStopping ? report_.text + ", but " + text : text);
  }
  end(GraspOutcome::kPortGone,
      phase_ == GraspPhase::kStopping
          ? report_.text + ", and " + gone
          : gone + "; the hand holds" + (isSlipAware() ? ", without slip detection" : ""));
}

void GraspStateMachine::onTactilePortGone(const std::string& why, std::int64_t monoUs) {
  if (observesOvershoot()) return endOvershoot();
  if (isMoving() && underTactileControl())
    stopWith(GraspOutcome::kStreamLost, "stopped: the tactile port is gone: " + why, monoUs);
  else if (isHolding())
    end(GraspOutcome::kStreamLost,
        "the tactile port is gone: " + why + "; the hand holds, without slip detection");
  else if (phase_ == GraspPhase::kEasing)
    end(GraspOutcome::kStreamLost,
        report_.text + "; the tactile port is gone: " + why + std::string(kNotEased));
}

void GraspStateMachine::onMotionFault(const std::string& why, std::int64_t monoUs) {
  failWith(why, kStopsAreSent, monoUs);
  stopsBlindly_ = phase_ == GraspPhase::kStopping;
}

void GraspStateMachine::fault(std::string_view why, std::int64_t monoUs) {
  failWith(why, ": stopped", monoUs);
}

// The text is set last: it may find no memory, and the stop must be sent nevertheless.
void GraspStateMachine::failWith(std::string_view why,
                                 std::string_view stoppedText,
                                 std::int64_t monoUs) {
  if (observesOvershoot()) return endOvershoot();  // the motion has stopped already
  if (phase_ == GraspPhase::kStopping) {
    // The stop has been sent; no further motion may follow it.
    if (next_ == Next::kEnd && report_.outcome != GraspOutcome::kNone) return;
    next_ = Next::kEnd;
    report_.outcome = GraspOutcome::kFailed;
    report_.text = "failed: " + std::string(why) + std::string(stoppedText);
    return;
  }
  if (!active()) return;
  const bool held = isHolding();
  stopWith(GraspOutcome::kFailed, {}, monoUs);
  report_.text = "failed: " + std::string(why) +
                 (held ? ": the hand holds, without slip detection" : std::string(stoppedText));
}

void GraspStateMachine::stop(std::int64_t monoUs) {
  if (observesOvershoot()) return endOvershoot();
  if (isHolding() || (phase_ == GraspPhase::kStopping && next_ != Next::kEnd))
    return stopWith(GraspOutcome::kStopped,
                    std::string("stopped by the user") +
                        (isSlipAware() ? ": the hand holds, without slip detection" : ""),
                    monoUs);
  if (phase_ == GraspPhase::kEasing)
    return stopWith(
        GraspOutcome::kStopped, "stopped by the user: the hand holds, at " + timesText(), monoUs);
  if (isMoving()) stopWith(GraspOutcome::kStopped, "stopped by the user", monoUs);
}

void GraspStateMachine::relax() {
  if (active()) end(GraspOutcome::kRelaxed, std::string(kRelaxedText));
}

void GraspStateMachine::onTime(std::int64_t monoUs) {
  if (phase_ == GraspPhase::kStopping) {
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
    return;
  }
  if (observesOvershoot()) {
    if (monoUs >= settledUs_) endOvershoot();
    return;
  }
  if (isHolding()) return onHoldingTime(monoUs);
  if (phase_ == GraspPhase::kEasing && !underWay_ && monoUs > stream_.deadAtUs())
    return end(GraspOutcome::kStreamLost,
               report_.text + "; no more tactile frames arrive" + std::string(kNotEased));
  if (!isMoving()) return;
  if (underTactileControl() && monoUs > stream_.deadAtUs())
    return stopWith(GraspOutcome::kStreamLost,
                    "stopped: no tactile frames for " +
                        millisecondsText(stream_.silenceUs(monoUs).value_or(0)) + " ms",
                    monoUs);
  if (monoUs > motionTimeoutUs_)
    stopWith(GraspOutcome::kFailed,
             acknowledged_ ? "failed: the motion didn't end in time: stopped"
                           : "failed: the hand didn't answer: stopped",
             monoUs);
}

std::optional<std::int64_t> GraspStateMachine::nextUs() const {
  if (phase_ == GraspPhase::kStopping) return std::min(sentUs_ + kStopAgainUs, stoppingUntilUs_);
  if (observesOvershoot()) return settledUs_;
  if (isHolding()) return holdingNextUs();
  if (phase_ == GraspPhase::kEasing && !underWay_) return stream_.deadAtUs() + 1;
  if (!isMoving()) return std::nullopt;
  return underTactileControl() ? std::min(motionTimeoutUs_, stream_.deadAtUs() + 1)
                               : motionTimeoutUs_;
}

std::optional<DeviceCommand> GraspStateMachine::takeCommand() {
  return std::exchange(command_, std::nullopt);
}

std::optional<GraspReport> GraspStateMachine::takeReport() {
  return std::exchange(ended_, std::nullopt);
}

void GraspStateMachine::note(const char* action,
                             const std::string& text,
                             std::optional<std::size_t> matrix) {
  notes_.push_back({action, text, matrix, limit_});
}

// Stops the motion; the grasp continues afterwards.
void GraspStateMachine::pause(Next next, const std::string& text, std::int64_t monoUs) {
  stopWith(GraspOutcome::kNone, text, monoUs);
  next_ = next;
}

void GraspStateMachine::settle(std::int64_t monoUs) {
  phase_ = GraspPhase::kSettling;
  command_.reset();
  const HoldingOptions& holding = report_.request.holding;
  settledUs_ = monoUs + microsecondsOf(held_ ? holding.restS : holding.settleS);
  if (endUs_ == 0 && holding.holdS > 0.0) endUs_ = settledUs_ + microsecondsOf(holding.holdS);
}

std::string GraspStateMachine::holdingText(std::int64_t monoUs) const {
  const auto seconds =
      static_cast<std::int64_t>(static_cast<double>(monoUs - heldFromUs_) / kUsPerS);
  const auto slips = static_cast<std::uint64_t>(report_.slips);
  const std::string answered =
      report_.slips == answeredSlips_
          ? counted(slips, "slip") + " answered"
          : counted(slips, "slip") + ", " + std::to_string(answeredSlips_) + " answered";
  return "holding for " + std::to_string(seconds) + " s, " + answered + ": " + limitText();
}

bool GraspStateMachine::isStillRisen() const {
  if (!report_.peakAfterStop) return false;
  if (report_.forceFinger && forces_)
    return forces_->forcesN()[*report_.forceFinger] - report_.forceN >
           kStillRisen * (report_.forceAfterStopN - report_.forceN);
  const float atStop = commonCounts(report_.peak, report_.request);
  const float rise = commonCounts(*report_.peakAfterStop, report_.request) - atStop;
  return static_cast<double>(loadCounts() - atStop) > kStillRisen * static_cast<double>(rise);
}

std::string GraspStateMachine::limitText() const {
  std::string text = "limit " + std::to_string(limit_) + " counts" + overForceText();
  if (!isStillRisen()) return text;
  const int highest = report_.request.holding.maxLimitCounts;
  if (report_.peakAfterStop->counts <= static_cast<float>(highest) ||
      peak_.counts <= static_cast<float>(highest))
    return text + riseText();
  return text + "; rose to " + numberText(report_.peakAfterStop->counts) +
         " counts after the stop, above its highest limit of " + std::to_string(highest) +
         ": close more slowly";
}

void GraspStateMachine::onHoldingFrame(std::int64_t monoUs) {
  if (phase_ == GraspPhase::kSettling) {
    if (monoUs < settledUs_) return;
    grip_.setReference();
    phase_ = GraspPhase::kHolding;
    lastSlipUs_ = monoUs;
    if (!held_) {
      heldFromUs_ = monoUs;
      note("holding", "holding: " + limitText());
    }
    held_ = report_.held = true;
    return;
  }
  if (!grip_.touches()) {
    report_.heldAxes.clear();
    return end(GraspOutcome::kFinished, std::string(kNothingHeldText));
  }
  if (const auto slip = grip_.slip()) respondToSlip(*slip, monoUs);
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
    if (phase_ == GraspPhase::kLoosening) pause(Next::kSettle, "it slips", monoUs);
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
  if (phase_ == GraspPhase::kLoosening) return pause(Next::kClose, "it slips", monoUs);
  close(monoUs);
}

void GraspStateMachine::onHoldingTime(std::int64_t monoUs) {
  if (monoUs > holdingDeadAtUs()) return onHoldingSilence(stream_.silenceUs(monoUs).value_or(0));
  if (phase_ != GraspPhase::kHolding) return;
  const HoldingOptions& holding = report_.request.holding;
  if (endUs_ != 0 && monoUs >= endUs_) {
    report_.holdTimeOver = true;
    return end(GraspOutcome::kFinished,
               "finished: held for " + numberText(holding.holdS) + " s, " +
                   counted(static_cast<std::uint64_t>(report_.slips), "slip") + ", limit " +
                   std::to_string(limit_) + " counts" +
                   (report_.friction ? ", friction roughly " + fixedText(*report_.friction, 2)
                                     : std::string()) +
                   "; the hand keeps holding");
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

void GraspStateMachine::loosen(const char* action, const std::string& text, std::int64_t monoUs) {
  note(action, text);
  grip_.setReference();
  MoveJoints open = motionTo(report_.request, 0.0, hand_);
  for (double& velocity : open.velocityDegPerS) velocity = std::min(velocity, kLooseningDegPerS);
  send(std::move(open), GraspPhase::kLoosening, monoUs);
  settledUs_ = monoUs + microsecondsOf(kLongestLooseningS);
}

void GraspStateMachine::onLooseningFrame(std::int64_t monoUs) {
  if (const auto slip = grip_.slip()) {
    if (frictionTestRunning_) reportFriction(*slip);
    frictionTestRunning_ = false;
    return respondToSlip(*slip, monoUs);
  }
  const double enough = frictionTestRunning_ ? kLeastOfLimit * report_.request.limitCounts : limit_;
  const bool tooMuch = static_cast<double>(loadCounts()) > enough ||
                       (!frictionTestRunning_ && fingerOverForce(report_.request, forces_));
  if (tooMuch && monoUs < settledUs_) return;
  if (!frictionTestRunning_) return pause(Next::kSettle, "loose enough", monoUs);
  frictionTestRunning_ = false;
  note("friction",
       grip_.touches()
           ? "it doesn't slip at " + numberText(peak_.counts) + " counts: closing again"
           : std::string("the object was lost before a slip was seen: closing again; no friction"));
  pause(Next::kClose, "loose enough", monoUs);
}

// The force at the begin of slip carried the weight: weight = friction times normal force.
void GraspStateMachine::reportFriction(const GripSlip& slip) {
  const HoldingOptions& holding = report_.request.holding;
  report_.countsAtSlip = grip_.sumCounts();
  std::string text = "slips at " + numberText(grip_.sumCounts()) + " counts in sum";
  if (holding.newtonsPerCount > 0.0 && grip_.sumCounts() > 0.0) {
    report_.friction = holding.weightN / (holding.newtonsPerCount * grip_.sumCounts());
    text += ": friction roughly " + fixedText(*report_.friction, 2);
  }
  note("friction", text, slip.matrix);
}

std::optional<std::int64_t> GraspStateMachine::unwatchedUs(std::int64_t monoUs) const {
  return interrupted_ ? stream_.silenceUs(monoUs) : std::nullopt;
}

void GraspStateMachine::onHoldingSilence(std::int64_t silenceUs) {
  if (!std::exchange(interrupted_, true))
    note("interrupted",
         "not protected: no tactile frames for " + millisecondsText(silenceUs) +
             " ms; the hand holds, without slip detection");
  if (silenceUs > kLongestSilenceUs)
    end(GraspOutcome::kStreamLost,
        "no more tactile frames arrive: the hand holds, without slip detection");
}

// What moved in the silence is not answered: the hand must not move because frames are back.
void GraspStateMachine::onFramesBack(std::int64_t silenceUs, std::int64_t monoUs) {
  onHoldingSilence(silenceUs);
  if (!isHolding()) return;
  interrupted_ = false;
  if (phase_ == GraspPhase::kHolding) grip_.setReference();
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
  if (phase_ != GraspPhase::kHolding) return nextUs;
  if (endUs_ != 0) nextUs = std::min(nextUs, endUs_);
  return std::min(nextUs, lastSlipUs_ + microsecondsOf(report_.request.holding.noSlipS));
}

}  // namespace palpate
