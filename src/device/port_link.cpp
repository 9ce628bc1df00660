#include "device/port_link.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "device/wrong_controller_error.h"

namespace palpate {
namespace {
constexpr std::int64_t kRetryUs = 100'000;  // between two attempts to open a port that is gone
constexpr std::int64_t kFaultRetryUs = 1'000'000;  // after an unexpected exception
constexpr std::int64_t kOffsetWindowUs = 30'000'000;

// True for a pseudo-terminal named by its number, not by a link. Once it is gone, the number may
// belong to a terminal of another program.
bool namesAPtyByNumber(const std::string& port) { return port.starts_with("/dev/pts/"); }

// Runs `work` and ignores exceptions: when memory is short one step may fail, but the next must run
// nevertheless.
template <typename Work>
void whateverHappens(Work&& work) noexcept {
  try {
    work();
  } catch (...) {
  }
}

}  // namespace

PortLink::PortLink(
    std::string port, std::string what, Open open, const HostTime& time, const Clock& clock)
    : port_(std::move(port)),
      what_(std::move(what)),
      time_(time),
      clock_(clock),
      open_(std::move(open)) {
  status_.port = port_;
}

std::future<CommandAnswer> PortLink::submit(DeviceCommand command) {
  QueuedCommand order{std::move(command), {}};
  std::future<CommandAnswer> answer = order.answer.get_future();
  std::lock_guard lock(mutex_);
  if (sink_ == nullptr || stopping_) {
    order.answer.set_exception(std::make_exception_ptr(
        DeviceError(DeviceFault::kSilent, port_, "not connected: the hand was not started")));
    return answer;
  }
  enqueue(std::move(order));
  if (channel_) channel_->interrupt();
  commandQueued_.notify_all();
  return answer;
}

void PortLink::enqueue(QueuedCommand order) { commandQueue_.push_back(std::move(order)); }

PortStatus PortLink::status() const {
  std::lock_guard lock(mutex_);
  return status_;
}

void PortLink::requestStop() noexcept {
  stopping_ = true;
  std::lock_guard lock(mutex_);
  if (channel_) channel_->interrupt();
  commandQueued_.notify_all();
}

void PortLink::begin(DeviceSink& sink) {
  forget();
  minOffsetUs_ = {};
  offsetWindowUs_ = 0;
  std::lock_guard lock(mutex_);
  sink_ = &sink;
  stopping_ = false;
  wasConnected_ = false;
  gaveUp_ = false;
  permanentlyFailed_ = false;
  portMissing_ = false;
  nextTryUs_ = 0;
  lastFailure_.clear();
  status_ = PortStatus{};
  status_.port = port_;
  status_.state = PortState::kConnecting;
  status_.message = "looking for the " + what_;
}

void PortLink::step() noexcept {
  try {
    try {
      round();
    } catch (const DeviceError& error) {
      closeAfterError(error);
    }
  } catch (const std::exception& failure) {
    fail(failure.what());
  } catch (...) {
    fail("an unknown exception");
  }
}

void PortLink::round() {
  if (channel_) {
    work();
    return;
  }
  rejectCommands("the " + what_ + " is not connected");
  if (permanentlyFailed_) nextTryUs_ = clock_.monotonicUs() + kRetryUs;
  if (clock_.monotonicUs() < nextTryUs_) {
    waitForCommand(nextTryUs_);
    return;
  }
  nextTryUs_ = clock_.monotonicUs() + kRetryUs;
  std::unique_ptr<ByteChannel> channel = open_(port_);
  {
    std::lock_guard lock(mutex_);
    channel_ = std::move(channel);
  }
  // Looking for the controller may take seconds on a noisy line; what was said of a port that was
  // not there is not true any more.
  if (std::exchange(portMissing_, false))
    setState(PortState::kConnecting, port_ + ": the port is there; looking for the " + what_);
  connect(*channel_);
  gaveUp_ = false;
  setState(PortState::kStreaming);
  updateStatus([&](PortStatus& status) {
    if (wasConnected_) ++status.reconnects;
  });
  lastFailure_.clear();
  eventNow("link",
           "the " + what_ + (std::exchange(wasConnected_, true) ? " is back" : " is connected"));
}

void PortLink::fail(const char* what) noexcept {
  nextTryUs_ = clock_.monotonicUs() + kFaultRetryUs;
  if (channel_) {
    stopBlindly(*channel_, what);
    whateverHappens([&] { emergencyStop(); });
    whateverHappens([&] { disconnected(); });
    std::unique_ptr<ByteChannel> closed;
    std::lock_guard lock(mutex_);
    closed = std::exchange(channel_, nullptr);
  }
  if (stopping_) return;
  {
    std::lock_guard lock(mutex_);
    status_.state = PortState::kFault;
    status_.message.clear();
  }
  whateverHappens([&] {
    const std::string message = port_ + ": the program failed at the " + what_ + " (" + what +
                                "); the port was closed and will be retried";
    setState(PortState::kFault, message);
    if (std::exchange(lastFailure_, message) != message) eventNow("alarm", message);
  });
}

void PortLink::stopBlindly(ByteChannel&, const std::string&) noexcept {}

void PortLink::closeAfterError(const DeviceError& error) {
  // A port that can't be opened again after its device was given up need not be unplugged.
  const bool isGone = error.fault() == DeviceFault::kDisconnected ||
                      (error.fault() == DeviceFault::kNotFound && !gaveUp_);
  if (channel_) {
    gaveUp_ = !isGone;
    // Of a port that is gone nobody may be sure: writing fails at once where it is.
    if (error.fault() != DeviceFault::kWrongDevice) stopBlindly(*channel_, error.what());
    disconnected();
    std::unique_ptr<ByteChannel> closed;
    std::lock_guard lock(mutex_);
    closed = std::exchange(channel_, nullptr);
  }
  if (stopping_) return;
  nextTryUs_ = clock_.monotonicUs() + kRetryUs;
  if (isGone && namesAPtyByNumber(port_)) {
    permanentlyFailed_ = true;
    const std::string message = port_ +
                                ": this pseudo-terminal doesn't exist (any more); connect again (a "
                                "link to it would be followed)";
    setState(PortState::kLost, message, /*unplugged=*/true);
    eventNow("alarm", message);
    return;
  }
  portMissing_ = isGone;
  setState(wasConnected_ ? PortState::kLost : PortState::kConnecting, error.what(), isGone);
  if (const auto* other = dynamic_cast<const WrongControllerError*>(&error))
    updateStatus([&](PortStatus& status) { status.found = other->found(); });
  // Reported once, not ten times a second.
  if (std::exchange(lastFailure_, error.what()) != error.what())
    eventNow(wasConnected_ ? "alarm" : "link", error.what());
}

void PortLink::finish() noexcept {
  try {
    if (channel_) closing();
  } catch (...) {
    // The port disappeared during closing(); it is closed in any case.
  }
  whateverHappens([&] { ended(); });
  whateverHappens([&] { rejectCommands("the hand was stopped"); });
  std::unique_ptr<ByteChannel> closed;
  std::lock_guard lock(mutex_);
  closed = std::exchange(channel_, nullptr);
  status_.state = PortState::kClosed;
  status_.message.clear();
  sink_ = nullptr;
}

void PortLink::executeCommands() {
  while (true) {
    std::optional<QueuedCommand> order;
    {
      std::lock_guard lock(mutex_);
      if (commandQueue_.empty()) return;
      order = std::move(commandQueue_.front());
      commandQueue_.pop_front();
    }
    try {
      order->answer.set_value(execute(order->command));
    } catch (const DeviceError& error) {
      order->answer.set_exception(std::current_exception());
      if (error.fault() != DeviceFault::kRefused && error.fault() != DeviceFault::kUnsupported)
        throw;
    } catch (const std::invalid_argument&) {
      order->answer.set_exception(
          std::current_exception());  // an error of the caller: nothing was sent
    } catch (...) {
      order->answer.set_exception(std::current_exception());
      throw;
    }
  }
}

void PortLink::rejectCommands(const std::string& why) {
  std::deque<QueuedCommand> orders;
  {
    std::lock_guard lock(mutex_);
    orders.swap(commandQueue_);
  }
  for (QueuedCommand& order : orders)
    order.answer.set_exception(
        std::make_exception_ptr(DeviceError(DeviceFault::kSilent, port_, why)));
}

bool PortLink::hasQueuedCommands() const {
  std::lock_guard lock(mutex_);
  return !commandQueue_.empty();
}

void PortLink::waitForCommand(std::int64_t untilUs) {
  std::unique_lock lock(mutex_);
  const std::int64_t leftUs = untilUs - clock_.monotonicUs();
  if (leftUs <= 0) return;
  commandQueued_.wait_for(
      lock, std::chrono::microseconds(leftUs), [&] { return stopping_ || !commandQueue_.empty(); });
}

void PortLink::measureAge(std::int64_t hostUs, std::int64_t deviceUs) {
  const std::int64_t offsetUs = hostUs - deviceUs;
  if (hostUs - offsetWindowUs_ > kOffsetWindowUs) {
    offsetWindowUs_ = hostUs;
    minOffsetUs_[1] = std::exchange(minOffsetUs_[0], std::nullopt);
  }
  minOffsetUs_[0] = std::min(minOffsetUs_[0].value_or(offsetUs), offsetUs);
  const std::int64_t least = std::min(*minOffsetUs_[0], minOffsetUs_[1].value_or(*minOffsetUs_[0]));
  updateStatus(
      [&](PortStatus& status) { status.ageMs = static_cast<double>(offsetUs - least) / 1000.0; });
}

void PortLink::setState(PortState state, const std::string& message, bool unplugged) {
  std::lock_guard lock(mutex_);
  status_.state = state;
  status_.message = message;
  status_.unplugged = unplugged;
  status_.found.reset();
}

void PortLink::event(const std::string& kind,
                     const std::string& text,
                     std::int64_t t0Us,
                     std::int64_t t1Us,
                     std::optional<int> matrix,
                     const std::string& json) {
  sink_->onEvent({t0Us, t1Us, kind, matrix, text, json});
}

void PortLink::eventNow(const std::string& kind, const std::string& text) {
  const std::int64_t nowUs = time_.nowUs();
  event(kind, text, nowUs, nowUs);
}

std::int64_t PortLink::stampAfter(std::int64_t& lastUs) const {
  // lastUs is 0 before the first stamp. A wrong clock may give times before 1970.
  const std::int64_t nowUs = time_.nowUs();
  lastUs = lastUs == 0 ? nowUs : std::max(lastUs + 1, nowUs);
  if (lastUs == 0) lastUs = 1;
  return lastUs;
}

}  // namespace palpate
