#include "palpate/control/grasp_control.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <utility>
#include <variant>

#include "palpate/capture/link_health.h"
#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

#include "control/command_answers.h"

namespace palpate {
namespace {

using std::chrono::microseconds;

// Period of the control cycle while something moves: checks answers, axes and ports.
constexpr std::int64_t kRoundUs = 5000;
// Longest pause of the control cycle otherwise.
constexpr std::int64_t kIdleUs = 100'000;
// Time after which the same failure is reported again.
constexpr std::int64_t kFaultAgainUs = 10'000'000;
constexpr std::chrono::milliseconds kGoodbye{300};
constexpr std::size_t kMaxChanges = 1000;
// Frames of two seconds; more can only wait if this thread did not run at all.
constexpr std::size_t kWaitingFrames = 64;

CaptureQueueOptions smallFeed() {
  CaptureQueueOptions options;
  options.tactileItems = kWaitingFrames;
  options.motionItems = 8 * kWaitingFrames;
  options.eventItems = kWaitingFrames;
  options.onlyHand = true;
  return options;
}

bool isSetting(const DeviceCommand& command) {
  return std::holds_alternative<SetThreshold>(command) ||
         std::holds_alternative<SetSensitivity>(command) ||
         std::holds_alternative<SetDynamicMask>(command);
}

}  // namespace

GraspControl::GraspControl(CaptureSession& session, const Clock& clock)
    : session_(session),
      clock_(clock),
      queue_(session.subscribe("motion control", smallFeed())),
      machine_(session.device().hand()) {}

GraspControl::~GraspControl() {
  bool moving = false;
  {
    const std::lock_guard lock(mutex_);
    moving = machine_.active();
  }
  if (moving) stop();
  thread_ = {};  // requests its end and waits for it
  {
    const std::lock_guard lock(mutex_);
    if (sentCommand_) {
      sentCommand_->answer.wait_for(kGoodbye);
      runGuardedCycle();
    }
  }
  delivery_ = {};
  deliverEvents();
}

void GraspControl::run() {
  if (thread_.joinable()) return;
  delivery_ = std::jthread([this](const std::stop_token& stop) { deliverLoop(stop); });
  thread_ = std::jthread([this](const std::stop_token& stop) { loop(stop); });
}

void GraspControl::loop(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::int64_t waitUs = kIdleUs;
    {
      const std::lock_guard lock(mutex_);
      const std::int64_t nowUs = clock_.monotonicUs();
      if (machine_.active()) waitUs = kRoundUs;
      if (const auto nextUs = machine_.nextUs())
        waitUs = std::clamp<std::int64_t>(*nextUs - nowUs, 0, waitUs);
    }
    queue_->wait(microseconds(waitUs), stop);
    if (!stop.stop_requested()) step();
  }
}

void GraspControl::step() {
  {
    const std::lock_guard lock(mutex_);
    runGuardedCycle();
  }
  deliverHere();
  runTasks();
}

void GraspControl::advance(ControlTask& task) {
  const std::lock_guard lock(tasksMutex_);
  tasks_.push_back(&task);
}

void GraspControl::forget(ControlTask& task) noexcept {
  const std::lock_guard lock(tasksMutex_);
  std::erase(tasks_, &task);
}

void GraspControl::runTasks() noexcept {
  const auto failed = [this](const char* what) {
    stop();
    const std::lock_guard lock(mutex_);
    fault(what);
  };
  const std::lock_guard lock(tasksMutex_);
  for (ControlTask* task : tasks_) try {
      task->step(session_.nowUs());
    } catch (const std::exception& failure) {
      failed(failure.what());
    } catch (...) {
      failed("an unknown exception");
    }
}

void GraspControl::guarded(auto&& work) noexcept {
  try {
    work();
  } catch (const std::exception& failure) {
    fault(failure.what());
  } catch (...) {
    fault("an unknown exception");
  }
}

void GraspControl::runGuardedCycle() noexcept {
  guarded([this] { runCycle(); });
}

// Each step is independent: when memory is short one may fail, but the next must be tried
// nevertheless. The stop comes first.
void GraspControl::fault(const char* what) noexcept {
  const auto whateverHappens = [](auto&& work) {
    try {
      work();
    } catch (...) {
    }
  };
  const std::int64_t nowUs = clock_.monotonicUs();
  whateverHappens([&] {
    machine_.fault(what, nowUs);
    send();
  });
  // An exception in every cycle must not prevent that a stop is sent again or that its answer is
  // read.
  whateverHappens([&] { pollReplies(); });
  whateverHappens([&] {
    machine_.onTime(nowUs);
    send();
  });
  whateverHappens([&] {
    // A failure that comes and goes must not fill a recording.
    if (lastFault_ == what && nowUs - lastFaultUs_ < kFaultAgainUs) return;
    lastFault_ = what;
    lastFaultUs_ = nowUs;
    const std::string text = std::string("the program failed while it watched the hand (") + what +
                             "); what moved was stopped";
    note({session_.nowUs(), session_.nowUs(), "alarm", {}, text, {}});
  });
  whateverHappens([&] { report(); });
}

void GraspControl::processFrames() {
  items_.clear();
  queue_->take(items_);
  const std::int64_t nowUs = clock_.monotonicUs();
  for (const CaptureItem& item : items_)
    if (const auto* frame = std::get_if<SharedFrame>(&item))
      machine_.onFrame(**frame, nowUs);
    else if (const Sample* angles = sampleOf(item, kAngleSeries))
      machine_.onAngles(angles->values, nowUs);
    else if (const Sample* temperatures = sampleOf(item, kTemperatureSeries))
      onTemperatures(temperatures->values);
  items_.clear();
}

void GraspControl::onTemperatures(const std::vector<double>& degC) {
  machine_.onTemperatures(degC);
  tooHot_.clear();
  const auto& sensors = session_.device().hand().temperatureSensors;
  for (std::size_t i = 0; i < std::min(degC.size(), sensors.size()); ++i)
    if (degC[i] > HealthOptions{}.maxTemperatureDegC)
      tooHot_ +=
          (tooHot_.empty() ? "" : ", ") + sensors[i].name + " " + fixedText(degC[i], 1) + " °C";
}

void GraspControl::send() {
  while (auto command = machine_.takeCommand()) {
    const bool isStop = std::holds_alternative<StopMotion>(*command);
    if (!isStop) motorsOff_ = false;
    sentCommand_ = SentCommand{session_.device().submit(std::move(*command)), isStop};
  }
}

void GraspControl::pollReplies() {
  std::erase_if(stopResults_, [](const auto& answer) { return isReady(answer); });
  std::erase_if(settings_, [](const auto& answer) { return isReady(answer); });
  if (!sentCommand_ || !isReady(sentCommand_->answer)) return;
  SentCommand sent = std::move(*sentCommand_);
  sentCommand_.reset();
  const std::int64_t nowUs = clock_.monotonicUs();
  try {
    const CommandAnswer answer = sent.answer.get();
    if (sent.isStop)
      machine_.onStopAcknowledged(nowUs);
    else
      machine_.onMoveAcknowledged(answer.durationS, nowUs);
  } catch (const DeviceError& error) {
    machine_.onCommandFailed(error.what(), error.fault() != DeviceFault::kUnsupported, nowUs);
  } catch (const std::exception& error) {
    machine_.onCommandFailed(error.what(), true, nowUs);
  }
}

// A hand that was away may have been switched off and on: nobody knows what it holds since then.
void GraspControl::checkReturn(const DeviceStatus& status) {
  const auto returned = [](std::optional<std::uint64_t>& known, std::uint64_t now) {
    return std::exchange(known, now).value_or(now) != now;
  };
  const bool tactile = returned(tactileReturns_, status.tactile.reconnects);
  const bool motion = returned(motionReturns_, status.motion ? status.motion->reconnects : 0);
  if (!tactile && !motion) return;
  machine_.forgetHeld();
  if (machine_.active() || !lastMotion_) return;
  GraspStatus before;
  before.lastMotion = lastMotion_;
  const bool held = !motorsOff_ && conditionOf(before).condition == HandCondition::kHolding;
  if (!unprotected_.empty()) {
    constexpr std::string_view kBefore = "before the port came back: ";
    if (!unprotected_.starts_with(kBefore)) unprotected_.insert(0, kBefore);
  } else if (motion && held) {
    unprotected_ =
        "the motion port was gone, and is back: whether the hand still holds what it held is not "
        "known";
    const std::int64_t nowUs = session_.nowUs();
    note({nowUs, nowUs, "alarm", {}, "not protected: " + unprotected_, {}});
  }
  wasAway_ = wasAway_ || motion;
}

void GraspControl::checkLinks() {
  const DeviceStatus status = session_.device().status();
  checkReturn(status);
  if (!machine_.active()) {
    if (portGone_ && motionProblem(status).empty()) portGone_.reset();
    return;
  }
  const std::int64_t nowUs = clock_.monotonicUs();
  // The port's thread has sent stops, and opens the port again: the stop is repeated until it is
  // answered.
  if (status.motion && status.motion->state == PortState::kFault)
    return machine_.onMotionFault("the motion port failed", nowUs);
  if (status.motion && status.motion->state == PortState::kLost && !status.motion->unplugged)
    return machine_.onMotionFault(status.motion->message, nowUs);
  if (const std::string why = motionProblem(status); !why.empty())
    return machine_.onMotionPortGone(why, nowUs);
  if (isTactilePortGone(status))
    machine_.onTactilePortGone(status.tactile.message.empty() ? "closed" : status.tactile.message,
                               nowUs);
  machine_.onAxisStates(session_.device().axisStates(), nowUs);
}

bool GraspControl::isTactilePortGone(const DeviceStatus& status) {
  switch (status.tactile.state) {
    case PortState::kStreaming:
    case PortState::kSilent:
      return false;
    case PortState::kConnecting:  // it is there again, the controller hasn't answered yet
    case PortState::kLost:
    case PortState::kFault:
    case PortState::kClosed:
      break;
  }
  return true;
}

std::string GraspControl::motionProblem(const DeviceStatus& status) {
  const std::optional<PortStatus>& motion = status.motion;
  if (!motion) return "no motion port is connected";
  // Checked first, since the motion port can't detect a tactile controller that sends no lines.
  if (status.tactile.found == PortAnswer::kMotion) return "the two ports are swapped";
  switch (motion->state) {
    case PortState::kStreaming:
    case PortState::kSilent:  // asked again, or given up as lost, within a second
      return {};
    case PortState::kClosed:
      return "it is closed";
    case PortState::kConnecting:
    case PortState::kLost:
    case PortState::kFault:
      break;
  }
  return motion->message.empty() ? "no motion controller answers" : motion->message;
}

void GraspControl::report() {
  for (const GraspStep& note : machine_.takeNotes()) {
    this->note(noteEvent(machine_.running(), note, session_.nowUs()));
    reportPhase(machine_.phase(), note.text);
  }
  if (auto ended = machine_.takeReport()) {
    ended->endUs = session_.nowUs();
    sentCommand_.reset();
    note(endEvent(*ended), /*ends=*/true);
    onEnded(*ended);
    reportPhase(GraspPhase::kIdle, ended->text, ended);
    if (std::exchange(relaxWhenStopped_, false)) {
      if (!ended->stateUnknown && ended->outcome != GraspOutcome::kPortGone)
        switchMotorsOff(/*isNote=*/true);
      else
        note({ended->endUs,
              ended->endUs,
              "alarm",
              {},
              "the motors were not switched off: no stop was answered",
              {}});
    }
  }
  if (machine_.phase() == reportedPhase_) return;
  const bool stopping = machine_.phase() == GraspPhase::kStopping;
  reportPhase(
      machine_.phase(),
      std::string(nameOf(machine_.phase())) + (stopping ? ": " + machine_.running().text : ""));
}

void GraspControl::onEnded(const GraspReport& ended) {
  last_ = ended;
  if (ended.outcome == GraspOutcome::kPortGone) portGone_ = ended;
  if (touches_.learn(ended)) ++touchesLearnt_;
  if (ended.outcome == GraspOutcome::kRefused) return;
  lastMotion_ = ended;
  if (!protectionEnded(ended)) return;
  unprotected_ = ended.text;
  note({ended.endUs, ended.endUs, "alarm", {}, "not protected: " + unprotected_, {}});
}

void GraspControl::reportPhase(GraspPhase phase,
                               const std::string& text,
                               std::optional<GraspReport> report) {
  reportedPhase_ = phase;
  if (changes_.size() == kMaxChanges) changes_.pop_front();
  changes_.push_back(
      {session_.nowUs(), phase, text, std::move(report), conditionOf(presentStatus())});
}

void GraspControl::refused(const GraspRequest& request, const std::string& why) {
  GraspReport report;
  report.request = request;
  report.outcome = GraspOutcome::kRefused;
  // The text becomes "reactive grasp refused: limit 1 is not in ..", wherever the error was found.
  std::string_view reason = why;
  for (const std::string_view part : {"grasp: ", "refused: "})
    if (reason.substr(0, part.size()) == part) reason.remove_prefix(part.size());
  report.text = kindOf(request) + " refused: " + std::string(reason);
  report.beginUs = report.endUs = session_.nowUs();
  note(endEvent(report));
  last_ = report;
}

void GraspControl::grasp(const GraspRequest& request, std::optional<std::uint64_t> stopsBefore) {
  // The events are delivered before the caller returns, also after a refusal.
  const struct Delivery {
    GraspControl& control;
    ~Delivery() { control.deliverHere(); }
  } delivery{*this};
  {
    const std::lock_guard lock(mutex_);
    runGuardedCycle();  // processes what has arrived until now
    try {
      request.validate();  // motionTo() does, too: an invalid request is named before any refusal
      if (stopsBefore && *stopsBefore != stopsAsked_)
        throw DeviceError(DeviceFault::kRefused, "grasp", "refused: the hand was stopped");
      if (const std::string why = motionProblem(session_.device().status()); !why.empty())
        throw DeviceError(DeviceFault::kRefused, "grasp", "refused: the hand can't move: " + why);
      if (request.mode != GraspMode::kPlain && settingsPending())
        throw DeviceError(DeviceFault::kRefused,
                          "grasp",
                          "refused: a tactile setting is being changed; try again in a second");
      machine_.setSettings(session_.device().info().matrices);
      machine_.begin(request,
                     clock_.monotonicUs(),
                     session_.nowUs(),
                     touches_.find(request.preshape, request.object));
      lastFault_.clear();
      portGone_.reset();
      unprotected_.clear();
      wasAway_ = false;
    } catch (const std::exception& error) {
      refused(request, error.what());
      throw;
    }
    note(beginEvent(machine_.running()));
    send();
    report();
  }
  queue_->wake();
}

void GraspControl::preshape(const std::string& name, double velocityDegPerS) {
  GraspRequest open;
  open.preshape = name;
  open.closeRatio = 0.0;
  open.velocityDegPerS = velocityDegPerS;
  grasp(open);
}

void GraspControl::stop() noexcept {
  {
    const std::lock_guard lock(mutex_);
    ++stopsAsked_;
    guarded([this] {
      machine_.stop(clock_.monotonicUs());
      const bool sentBefore = sentCommand_ && sentCommand_->isStop;
      send();
      // No known motion runs, or a stop was sent already: it is sent in any case.
      if (sentBefore || !machine_.active())
        stopResults_.push_back(session_.device().submit(StopMotion{}));
      report();
    });
  }
  deliverHere();
  queue_->wake();
}

void GraspControl::switchMotorsOff(bool isNote) {
  machine_.forgetHeld();
  stopResults_.push_back(session_.device().submit(SetPower{}));
  motorsOff_ = true;
  if (!isNote) return;
  const std::int64_t nowUs = session_.nowUs();
  note({nowUs,
        nowUs,
        "grasp",
        {},
        std::string(kRelaxedText),
        Json::object().set("outcome", nameOf(GraspOutcome::kRelaxed)).text(-1)});
}

void GraspControl::relax() noexcept {
  {
    const std::lock_guard lock(mutex_);
    ++stopsAsked_;
    guarded([this] {
      stopResults_.push_back(session_.device().submit(StopMotion{}));
      relaxWhenStopped_ = machine_.stopsBlindly();
      unprotected_.clear();
      if (!relaxWhenStopped_) {
        const bool ends = machine_.active();
        machine_.relax();
        // Of a hand that stood still or held, too, a recording tells that it may have let go.
        switchMotorsOff(/*isNote=*/!ends);
        report();
      }
    });
  }
  deliverHere();
}

void GraspControl::acknowledge() {
  {
    const std::lock_guard lock(mutex_);
    if (unprotected_.empty()) return;
    const std::int64_t nowUs = session_.nowUs();
    note({nowUs, nowUs, "grasp", {}, "acknowledged: not protected: " + unprotected_, {}});
    unprotected_.clear();
  }
  deliverHere();
}

bool GraspControl::settingsPending() const {
  return std::any_of(
      settings_.begin(), settings_.end(), [](const auto& answer) { return !isReady(answer); });
}

void GraspControl::setCalibration(std::optional<Calibration> calibration) {
  const std::lock_guard lock(mutex_);
  calibrated_ = calibration.has_value();
  machine_.setCalibration(std::move(calibration));
}

void GraspControl::setTouches(TouchMemory touches) {
  const std::lock_guard lock(mutex_);
  touches_ = std::move(touches);
}

TouchMemory GraspControl::touches() const {
  const std::lock_guard lock(mutex_);
  return touches_;
}

GraspForecast GraspControl::forecast(const GraspRequest& request) const {
  const std::lock_guard lock(mutex_);
  return forecastOf(request, touches_.find(request.preshape, request.object), machine_.anglesDeg());
}

std::shared_future<CommandAnswer> GraspControl::change(const DeviceCommand& setting) {
  if (!isSetting(setting))
    throw std::invalid_argument("GraspControl::change: that is not a tactile setting");
  const std::lock_guard lock(mutex_);
  if (machine_.underTactileControl())
    throw DeviceError(DeviceFault::kRefused,
                      "settings",
                      "refused: fingers move under tactile control; stop the grasp first");
  std::shared_future<CommandAnswer> answer = session_.device().submit(setting).share();
  settings_.push_back(answer);
  return answer;
}

GraspStatus GraspControl::status() const {
  const std::lock_guard lock(mutex_);
  GraspStatus status = presentStatus();
  // A grasp counts as ended only after its end was delivered to the session, too.
  if (!machine_.active() && pendingEndEvents_ > 0) status.phase = GraspPhase::kStopping;
  return status;
}

GraspStatus GraspControl::presentStatus() const {
  GraspStatus status;
  status.phase = machine_.phase();
  if (machine_.active()) {
    status.running = machine_.running();
    status.request = machine_.running().request;
    status.friction = machine_.running().friction;
    if (machine_.phase() == GraspPhase::kHolding)
      status.holding = machine_.holdingText(clock_.monotonicUs());
    if (const auto unwatchedUs = machine_.unwatchedUs(clock_.monotonicUs()))
      status.unwatchedMs = static_cast<double>(*unwatchedUs) / 1e3;
  }
  status.last = last_;
  status.lastMotion = lastMotion_;
  status.unprotected = unprotected_;
  status.wasAway = wasAway_;
  const DeviceStatus device = session_.device().status();
  status.cannotMove = motionProblem(device);
  if (!status.cannotMove.empty()) status.portGone = portGone_;
  status.tooHot = tooHot_;
  status.motorsOff = motorsOff_;
  status.stopsAsked = stopsAsked_;
  status.calibrated = calibrated_;
  status.touchesLearnt = touchesLearnt_;
  status.anglesDeg = machine_.anglesDeg();
  status.cannotReact = status.cannotMove;
  if (status.cannotReact.empty() &&
      (isTactilePortGone(device) || !machine_.stream().alive(clock_.monotonicUs())))
    status.cannotReact = "no tactile frames come";
  if (status.cannotReact.empty() && settingsPending()) {
    status.cannotReact = "a tactile setting is being changed";
    status.changesSetting = true;
  }
  if (machine_.underTactileControl()) status.cannotChange = "fingers move under tactile control";
  status.periodMs = static_cast<double>(machine_.stream().medianPeriodUs()) / 1e3;
  status.silenceLimitMs = static_cast<double>(machine_.stream().silenceLimitUs()) / 1e3;
  return status;
}

std::vector<GraspChange> GraspControl::takeChanges() {
  const std::lock_guard lock(mutex_);
  std::vector<GraspChange> changes(changes_.begin(), changes_.end());
  changes_.clear();
  return changes;
}

void GraspControl::note(Event event, bool ends) {
  pendingEvents_.push_back({std::move(event), ends});
  if (ends) ++pendingEndEvents_;
  pendingEventsChanged_.notify_one();
}

void GraspControl::deliverEvents() {
  while (true) {
    PendingEvent pending;
    {
      const std::lock_guard lock(mutex_);
      if (pendingEvents_.empty()) return;
      pending = std::move(pendingEvents_.front());
      pendingEvents_.pop_front();
    }
    try {
      session_.note(pending.event);
    } catch (...) {
      // No memory: controlling the hand is more important than this event.
    }
    if (!pending.ends) continue;
    const std::lock_guard lock(mutex_);
    --pendingEndEvents_;
  }
}

void GraspControl::deliverLoop(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex_);
      if (!pendingEventsChanged_.wait(lock, stop, [this] { return !pendingEvents_.empty(); }))
        return;
    }
    deliverEvents();
  }
}

// Delivers in the caller's thread when there is no delivery thread.
void GraspControl::deliverHere() {
  if (!delivery_.joinable()) deliverEvents();
}

void GraspControl::runCycle() {
  processFrames();
  send();
  pollReplies();
  checkLinks();
  machine_.onTime(clock_.monotonicUs());
  send();
  report();
}

}  // namespace palpate
