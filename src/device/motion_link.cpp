#include "device/motion_link.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/device/sdh_protocol.h"
#include "palpate/model/hand_description.h"

#include "device/sdh_link.h"

namespace palpate {
namespace {

// period of requests for the axis states while a motion runs
constexpr std::int64_t kStatesPeriodUs = 50'000;
constexpr int kBlindStops = 3;
constexpr int kLastReads = 6;
constexpr double kMinAnswerLimitS = 0.1;
constexpr double kMaxAnswerLimitS = 3.0;
// Axes that still move after a confirmed stop get another one.
constexpr std::int64_t kStopAgainAfterUs = 1'000'000;
constexpr int kSinSquareProfile = 0;
constexpr int kRampProfile = 1;

// Checks values before a byte is sent. NaN is outside every range.
void checkAxes(const char* what,
               const char* unit,
               const std::vector<double>& values,
               const std::vector<double>& least,
               const std::vector<double>& most) {
  if (values.size() != least.size())
    throw std::invalid_argument(std::string(what) + ": " + std::to_string(values.size()) +
                                " values for " + std::to_string(least.size()) + " axes");
  for (std::size_t axis = 0; axis < values.size(); ++axis)
    if (!(values[axis] >= least[axis] && values[axis] <= most[axis]))
      throw std::invalid_argument(std::string(what) + " of axis " + std::to_string(axis) + ": " +
                                  numberText(values[axis]) + " " + unit + " is not in " +
                                  numberText(least[axis]) + ".." + numberText(most[axis]));
}

bool anyMoves(const std::vector<int>& states) {
  return std::any_of(states.begin(), states.end(), sdhAxisMoves);
}

}  // namespace

MotionLink::MotionLink(const std::string& port,
                       Open open,
                       double angleHz,
                       double temperatureHz,
                       const HostTime& time,
                       const Clock& clock)
    : PortLink(port, "motion controller", std::move(open), time, clock),
      anglePeriodUs_(std::llround(1e6 / angleHz)),
      temperaturePeriodUs_(std::llround(1e6 / temperatureHz)) {}

MotionLink::~MotionLink() = default;

std::vector<int> MotionLink::axisStates() const {
  std::lock_guard lock(mutex_);
  return states_;
}

std::optional<SdhControllerInfo> MotionLink::info() const {
  std::lock_guard lock(mutex_);
  return known_;
}

bool MotionLink::stopWaits() const {
  std::lock_guard lock(mutex_);
  return !commandQueue_.empty() &&
         std::holds_alternative<StopMotion>(commandQueue_.front().command);
}

// Requires mutex_. A stop goes before all other commands; waiting commands that would move the hand
// after it are dropped.
void MotionLink::enqueue(QueuedCommand order) {
  if (!std::holds_alternative<StopMotion>(order.command)) {
    commandQueue_.push_back(std::move(order));
    return;
  }
  for (auto waiting = commandQueue_.begin(); waiting != commandQueue_.end();) {
    if (!std::holds_alternative<MoveJoints>(waiting->command)) {
      ++waiting;
      continue;
    }
    waiting->answer.set_exception(std::make_exception_ptr(
        DeviceError(DeviceFault::kRefused, port_, "stopped before it began")));
    waiting = commandQueue_.erase(waiting);
  }
  commandQueue_.push_front(std::move(order));
}

// Stops the hand, also for all stops that wait.
void MotionLink::confirmStops() {
  controller_->stop();
  session_.settling = true;
  session_.stoppedUs = clock_.monotonicUs();
  std::lock_guard lock(mutex_);
  while (!commandQueue_.empty() &&
         std::holds_alternative<StopMotion>(commandQueue_.front().command)) {
    sentStops_.push_back(std::move(commandQueue_.front()));
    commandQueue_.pop_front();
  }
}

void MotionLink::answerStops() {
  for (QueuedCommand& order : std::exchange(sentStops_, {})) order.answer.set_value({});
}

// Stops that come meanwhile go first.
void MotionLink::openController() {
  while (true) try {
      controller_->open();
      return;
    } catch (const SdhInterrupted&) {
      if (stopping()) throw;
      confirmStops();
    }
}

void MotionLink::connect(ByteChannel& channel) {
  SdhControllerOptions options;
  options.urgent = [this] { return stopping() || stopWaits(); };
  opened_ = &channel;
  controller_ = std::make_unique<SdhController>(channel, clock_, options);
  const bool leftMoving = stopAfterReconnect_;
  if (leftMoving) {
    prepareLastStop();
    // The controller was lost during a motion, which may have run without control. Send a stop
    // before any other request.
    confirmStops();
    stopAfterReconnect_ = false;
    eventNow("motion", "stopped: the motion controller had been lost during a motion");
  }
  openController();
  const SdhControllerInfo& facts = controller_->info();
  answered_ = true;
  if (const auto known = this->info(); wasConnected() && known && known->serial != facts.serial)
    throw DeviceError(
        DeviceFault::kWrongDevice,
        port_,
        "a hand with another serial number answers at this port; to use it, disconnect and "
        "connect again");
  if (anyMoves(controller_->states())) {
    // The motion was left by a program that died, or by one on another port.
    prepareLastStop();
    confirmStops();
    if (!leftMoving) {
      eventNow("motion", "stopped: the hand was moving unattended when it was connected");
      updateStatus([&](PortStatus& status) { status.foundMovingUs = time_.nowUs(); });
    }
  }
  answerStops();
  std::lock_guard lock(mutex_);
  known_ = facts;
  session_.nextAnglesUs = session_.nextTemperaturesUs = clock_.monotonicUs();
}

void MotionLink::disconnected() {
  lastStop_.reset();
  countBytes();
  if (controller_) {
    const SdhStats stats = controller_->stats();
    session_.before.bytesRead += stats.bytesRead;
    session_.before.badChecksums += stats.badChecksums;
    session_.before.retries += stats.retries;
    session_.before.suspect += stats.suspect;
    session_.before.skippedBytes += stats.skippedBytes;
  }
  controller_.reset();
  session_.answersLimited = false;
  if (std::exchange(session_.moving, false)) stopAfterReconnect_ = true;
  for (QueuedCommand& order : std::exchange(sentStops_, {}))
    order.answer.set_exception(std::make_exception_ptr(DeviceError(
        DeviceFault::kSilent, port_, "the stop was sent, and the state of the hand is unknown")));
  std::lock_guard lock(mutex_);
  states_.clear();
}

void MotionLink::stopBlindly(ByteChannel& channel, const std::string& why) noexcept {
  if (!answered_) return;  // another device may be connected there
  try {
    const std::int64_t decidedUs = time_.nowUs();
    const std::string_view stop = sdhStopBytes(!channel.isNetwork());
    for (int i = 0; i < kBlindStops; ++i)
      channel.write(std::as_bytes(std::span<const char>(stop.data(), stop.size())));
    // A connection that is closed with unread bytes may drop what is on its way.
    std::array<std::byte, 1024> unread;
    for (int i = 0; channel.isNetwork() && i < kLastReads; ++i)
      channel.read(unread, std::chrono::milliseconds(5));
    if (session_.moving)
      event("motion",
            "stops were sent without waiting for an answer: " + why,
            decidedUs,
            time_.nowUs());
  } catch (...) {
    // The port accepts no bytes, or no memory is left: nothing else can be sent.
  }
}

void MotionLink::emergencyStop() {
  if (!controller_ || !session_.moving) return;
  controller_->stop();
  session_.moving = false;
  event("motion", "stopped: the program failed", session_.motionFromUs, time_.nowUs());
}

void MotionLink::forget() {
  session_ = {};
  answered_ = false;
  std::lock_guard lock(mutex_);
  states_.clear();
}

void MotionLink::closing() {
  if (controller_ && std::exchange(session_.moving, false)) {
    controller_->stop();
    eventNow("motion", "stopped: the connection was closed during a motion");
  }
}

void MotionLink::ended() { lastStop_.reset(); }

void MotionLink::countBytes() {
  if (!controller_) return;
  const SdhStats stats = controller_->stats();
  updateStatus([&](PortStatus& status) {
    status.bytes = session_.before.bytesRead + stats.bytesRead;
    status.skippedBytes = session_.before.skippedBytes + stats.skippedBytes;
    status.badChecksums = session_.before.badChecksums + stats.badChecksums;
    status.retries = session_.before.retries + stats.retries;
    status.suspect = session_.before.suspect + stats.suspect;
  });
}

void MotionLink::work() {
  try {
    executeCommands();
  } catch (const SdhInterrupted&) {
    // A motion was ended early for a waiting stop; the connection is in order.
    return;
  }
  if (stopping()) return;
  const std::int64_t nowUs = clock_.monotonicUs();
  try {
    if (nowUs >= session_.nextTemperaturesUs) {
      session_.nextTemperaturesUs = nowUs + temperaturePeriodUs_;
      pollTemperatures();
    } else if (statesAreDue() && nowUs >= session_.nextStatesUs) {
      session_.nextStatesUs = nowUs + kStatesPeriodUs;
      pollStates();
    } else if (nowUs >= session_.nextAnglesUs) {
      // After a delay, missed requests are not made up for, so that there is no burst.
      session_.nextAnglesUs = std::max(session_.nextAnglesUs + anglePeriodUs_, nowUs);
      pollAngles();
    } else {
      waitForCommand(statesAreDue() ? std::min(session_.nextAnglesUs, session_.nextStatesUs)
                                    : session_.nextAnglesUs);
    }
    session_.failures = 0;
    relaxAnswerLimit();
  } catch (const DeviceError& error) {
    // An urgent command ends an exchange early; this is no failure of the connection.
    if (stopping() || stopWaits()) return;
    // With a limit the exchange was repeated until the limit was over.
    if (error.fault() == DeviceFault::kDisconnected || session_.answersLimited ||
        ++session_.failures >= 2)
      throw;
    setState(PortState::kSilent, error.what());
  }
  countBytes();
}

void MotionLink::pollAngles() {
  Sample angles;
  angles.values = controller_->angles();
  angles.hostUs = stampAfter(session_.lastAngleStampUs);
  ++session_.samples;
  updateStatus([&](PortStatus& status) {
    status.items = session_.samples;
    status.lastItemUs = angles.hostUs;
    status.state = PortState::kStreaming;
    status.message.clear();
  });
  sink_->onSample(std::move(angles));
}

void MotionLink::pollTemperatures() {
  Sample temperatures{0, {}, kTemperatureSeries};
  temperatures.values = controller_->temperatures();
  temperatures.hostUs = stampAfter(session_.lastTemperatureStampUs);
  sink_->onSample(std::move(temperatures));
}

// At rest a single failure is no reason to give up the port: the limits of each call hold again.
void MotionLink::relaxAnswerLimit() {
  if (!session_.answersLimited || session_.answersLimitedAtRest || statesAreDue() ||
      clock_.monotonicUs() < session_.motionUntilUs)
    return;
  session_.answersLimited = false;
  session_.failures = 0;
  controller_->limitBadAnswers({});
}

void MotionLink::pollStates() {
  const std::vector<int> states = controller_->states();
  const bool moves = anyMoves(states);
  {
    std::lock_guard lock(mutex_);
    states_ = states;
  }
  if (moves) {
    const std::int64_t nowUs = clock_.monotonicUs();
    if (session_.settling && session_.stoppedUs != 0 &&
        nowUs - session_.stoppedUs > kStopAgainAfterUs) {
      confirmStops();
      answerStops();
      eventNow("motion", "stopped again: axes moved a second after a stop");
    }
    return;
  }
  session_.settling = false;
  if (!std::exchange(session_.moving, false)) return;
  event("motion", "motion ended", session_.motionFromUs, time_.nowUs());
}

void MotionLink::prepareLastStop() {
  if (lastStop_ && lastStop_->isReady()) return;
  lastStop_.emplace(*opened_);
  if (lastStop_->problem().empty() || std::exchange(session_.saidNoLastStop, true)) return;
  eventNow("alarm", lastStop_->problem());
}

CommandAnswer MotionLink::move(const MoveJoints& move) {
  const std::vector<AxisDescription>& axes = sdh2().axes;
  std::vector<double> least, most;
  for (const AxisDescription& axis : axes) {
    least.push_back(axis.minimumDeg);
    most.push_back(axis.maximumDeg);
  }
  checkAxes("target", "deg", move.targetDeg, least, most);
  if (!move.velocityDegPerS.empty())
    checkAxes("velocity",
              "deg/s",
              move.velocityDegPerS,
              std::vector<double>(axes.size(), 0.0),
              controller_->info().maximumVelocity);
  if (!(move.answerLimitS >= kMinAnswerLimitS && move.answerLimitS <= kMaxAnswerLimitS))
    throw std::invalid_argument("answer limit: " + numberText(move.answerLimitS) + " s is not in " +
                                numberText(kMinAnswerLimitS) + ".." + numberText(kMaxAnswerLimitS));
  controller_->setProfile(move.ramp ? kRampProfile : kSinSquareProfile);
  if (!move.velocityDegPerS.empty()) controller_->setVelocities(move.velocityDegPerS);
  controller_->setTargets(move.targetDeg);
  prepareLastStop();
  session_.motionFromUs = time_.nowUs();
  // Set even if the answer gets lost, because the hand may move then, too.
  session_.moving = true;
  session_.answersLimited = true;
  session_.answersLimitedAtRest = move.limitsAnswersAtRest;
  session_.settling = false;
  session_.stoppedUs = 0;
  controller_->limitBadAnswers(
      std::chrono::milliseconds(std::llround(move.answerLimitS * kMsPerS)));
  CommandAnswer answer;
  {
    // Until the states are read, so that a caller that waits for the end of the motion does not see
    // the states from before it.
    std::lock_guard lock(mutex_);
    states_.assign(axes.size(), kSdhAxisPositioning);
  }
  answer.durationS = controller_->move();
  session_.motionUntilUs =
      clock_.monotonicUs() + static_cast<std::int64_t>(answer.durationS * kUsPerS);
  session_.nextStatesUs = clock_.monotonicUs() + kStatesPeriodUs;
  event("motion",
        "motion began",
        session_.motionFromUs,
        session_.motionFromUs,
        {},
        Json::object()
            .set("target_deg", jsonList(move.targetDeg))
            .set("velocity_deg_per_s", jsonList(move.velocityDegPerS))
            .set("duration_s", answer.durationS)
            .text(-1));
  return answer;
}

void MotionLink::stopMotion() {
  controller_->stop();
  session_.settling = true;
  session_.motionUntilUs = session_.stoppedUs = clock_.monotonicUs();
  if (!std::exchange(session_.moving, false)) return;
  event("motion", "stopped", session_.motionFromUs, time_.nowUs());
}

CommandAnswer MotionLink::execute(const DeviceCommand& command) {
  if (const auto* joints = std::get_if<MoveJoints>(&command)) return move(*joints);
  if (std::holds_alternative<StopMotion>(command)) {
    stopMotion();
  } else if (const auto* power = std::get_if<SetPower>(&command)) {
    controller_->setPower(power->on);
    session_.settling = true;
    if (!power->on) session_.moving = false;
    eventNow("motion", power->on ? "axes powered" : "axes without power");
  }
  return {};
}

}  // namespace palpate
