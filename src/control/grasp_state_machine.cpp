#include "palpate/control/grasp_state_machine.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "palpate/device/sdh_protocol.h"

#include "control/grasp_texts.h"

namespace palpate {
namespace {

// Phases as bits.
constexpr unsigned setOf(auto... phases) {
  return (0U | ... | (1U << static_cast<unsigned>(phases)));
}

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

// What a state does at a frame under tactile control, when its motion has ended (null exactly where
// none runs) and in time; null: nothing. And which phases may follow.
struct GraspStateMachine::StateRow {
  State state;
  GraspPhase phase;
  std::string_view name;  // of the phase
  struct {
    void (Self::*onFrame)(const FrameEvent& frame);
    void (Self::*onMotionEnd)(const std::vector<int>& states, std::int64_t monoUs);
    void (Self::*onTime)(std::int64_t monoUs);
  } does;
  unsigned next;
};

constexpr GraspStateMachine::StateRow GraspStateMachine::kStates[] = {
    {State::kIdle,
     Phase::kIdle,
     "idle",
     {nullptr, nullptr, nullptr},
     setOf(Phase::kPreshaping, Phase::kClosing, Phase::kSettling)},
    {State::kPreshaping,
     Phase::kPreshaping,
     "preshaping",
     {&Self::onMovingFrame, &Self::onMotionEnd, &Self::onMovingTime},
     setOf(Phase::kClosing, Phase::kStopping, Phase::kIdle)},
    {State::kClosing,
     Phase::kClosing,
     "closing",
     {&Self::onMovingFrame, &Self::onMotionEnd, &Self::onMovingTime},
     setOf(Phase::kClosing, Phase::kStopping, Phase::kIdle)},
    {State::kStopping,
     Phase::kStopping,
     "stopping",
     {&Self::onStoppingFrame, nullptr, &Self::onStoppingTime},
     setOf(Phase::kSettling, Phase::kEasing, Phase::kClosing, Phase::kStopping, Phase::kIdle)},
    {State::kOvershoot,
     Phase::kSettling,
     "settling",
     {nullptr, nullptr, &Self::onOvershootTime},
     setOf(Phase::kIdle)},
    {State::kSettling,
     Phase::kSettling,
     "settling",
     {&Self::onSettlingFrame, nullptr, &Self::onHoldingTime},
     setOf(Phase::kHolding, Phase::kStopping, Phase::kIdle)},
    {State::kEasing,
     Phase::kEasing,
     "easing",
     {&Self::onEasingFrame, nullptr, &Self::onEasingTime},
     setOf(Phase::kEasing, Phase::kSettling, Phase::kStopping, Phase::kIdle)},
    {State::kEasingStep,
     Phase::kEasing,
     "easing",
     {&Self::onMovingFrame, &Self::onStepEnd, &Self::onMovingTime},
     setOf(Phase::kEasing, Phase::kStopping, Phase::kIdle)},
    {State::kHolding,
     Phase::kHolding,
     "holding",
     {&Self::onHoldingFrame, nullptr, &Self::onHoldingTime},
     setOf(Phase::kClosing, Phase::kLoosening, Phase::kStopping, Phase::kIdle)},
    {State::kLoosening,
     Phase::kLoosening,
     "loosening",
     {&Self::onLooseningFrame, &Self::onMotionEnd, &Self::onMovingTime},
     setOf(Phase::kClosing, Phase::kStopping, Phase::kIdle)},
};

// row() finds a row by its number.
constexpr bool GraspStateMachine::eachRowHasItsState() {
  for (std::size_t i = 0; i < std::size(kStates); ++i)
    if (kStates[i].state != static_cast<State>(i)) return false;
  return std::size(kStates) == static_cast<std::size_t>(State::kLoosening) + 1;
}

const GraspStateMachine::StateRow& GraspStateMachine::row() const noexcept {
  static_assert(eachRowHasItsState());
  return kStates[static_cast<std::size_t>(state_)];
}

GraspPhase GraspStateMachine::phase() const noexcept { return row().phase; }
bool GraspStateMachine::isMoving() const noexcept { return row().does.onMotionEnd != nullptr; }

std::string_view nameOf(GraspPhase phase) {
  for (const auto& row : GraspStateMachine::kStates)
    if (row.phase == phase) return row.name;
  return "idle";
}

bool mayFollow(GraspPhase phase, GraspPhase next) {
  return std::any_of(
      std::begin(GraspStateMachine::kStates),
      std::end(GraspStateMachine::kStates),
      [&](const auto& row) { return row.phase == phase && (row.next & setOf(next)) != 0; });
}

void GraspStateMachine::begin(const GraspRequest& request,
                              std::int64_t monoUs,
                              std::int64_t hostUs,
                              const std::optional<Touch>& touch) {
  request.validate();  // motionTo() owns this rule; here an invalid request is named before others
  if (active()) refuse("refused: the hand is " + std::string(nameOf(phase())) + "; stop it first");
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
  std::optional<MoveJoints> toStart;
  if (request.startRatio) toStart = motionTo(request, *request.startRatio, hand_);
  motionTo(request, request.closeRatio, hand_, anglesDeg_);
  forces_ = std::move(forces);
  report_ = report;
  limit_ = report_.limitCounts;
  next_ = State::kIdle;
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
  } else if (toStart) {
    send(std::move(*toStart), State::kPreshaping, monoUs);
  } else {
    close(monoUs);
  }
}

void GraspStateMachine::setSettings(std::vector<MatrixSettings> settings) {
  if (settings != settings_) forgetHeld();  // counts mean something else
  settings_ = std::move(settings);
}

void GraspStateMachine::setCalibration(std::optional<Calibration> calibration) {
  forgetHeld();
  calibration_ = std::move(calibration);
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

void GraspStateMachine::onFrame(const TactileFrame& frame, std::int64_t monoUs) {
  const auto noticed = unwatchedUs(monoUs);
  FrameEvent event{monoUs, frame.hostUs, stream_.frame(frame.hostUs, monoUs)};
  if (isHolding() && noticed) event.silenceUs = std::max(*noticed, event.silenceUs.value_or(0));
  const bool anotherLayout = updateLayout(frame);
  peak_ = taxelPeaks(frame, matrixPeaks_);
  if (!active() && !isTouched(peak_.counts)) forgetHeld();
  if (calibration_) newest_ = frame;
  if (anotherLayout && underTactileControl())
    return fault("the layout of the tactile sensor has changed since the start", monoUs);
  if (active() && forces_) forces_->apply(frame, degC_);
  if (active() && isSlipAware()) grip_.onFrame(frame);
  // From the stop until the reading has settled.
  if (report_.peakAfterStop && (phase() == GraspPhase::kStopping ||
                                phase() == GraspPhase::kSettling || phase() == GraspPhase::kEasing))
    measurePeakAfterStop();
  if (row().does.onFrame && underTactileControl()) (this->*row().does.onFrame)(event);
}

void GraspStateMachine::onTime(std::int64_t monoUs) {
  if (row().does.onTime) (this->*row().does.onTime)(monoUs);
}

std::optional<std::int64_t> GraspStateMachine::nextUs() const {
  if (state_ == State::kStopping) return std::min(sentUs_ + kStopAgainUs, stoppingUntilUs_);
  if (state_ == State::kOvershoot) return settledUs_;
  if (isHolding()) return holdingNextUs();
  if (state_ == State::kEasing) return stream_.deadAtUs() + 1;
  if (!isMoving()) return std::nullopt;
  return underTactileControl() ? std::min(motionTimeoutUs_, stream_.deadAtUs() + 1)
                               : motionTimeoutUs_;
}

void GraspStateMachine::onAxisStates(const std::vector<int>& states, std::int64_t monoUs) {
  if (!isMoving() || !acknowledged_ || states.empty()) return;
  bool held = false;
  for (const int state : states) {
    if (sdhAxisMoves(state)) return;
    held = held || sdhAxisBlocks(state);
  }
  // Old firmware reports "idle" too early.
  if (!held && monoUs < announcedUs_) return;
  (this->*row().does.onMotionEnd)(states, monoUs);
}

}  // namespace palpate
