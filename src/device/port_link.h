// Base class of the threads of both ports in LiveHand: commands with answers, a status for other
// threads, connecting, and reconnecting after the port disappeared.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>
#include <palpate/device/device.h>

namespace palpate {

struct QueuedCommand {
  DeviceCommand command;
  std::promise<CommandAnswer> answer;
};

class PortLink {
 public:
  using Open = std::function<std::unique_ptr<ByteChannel>(const std::string& port)>;

  PortLink(std::string port, std::string what, Open open, const HostTime& time, const Clock& clock);
  virtual ~PortLink() = default;
  PortLink(const PortLink&) = delete;
  PortLink& operator=(const PortLink&) = delete;

  // May be called from any thread.
  std::future<CommandAnswer> submit(DeviceCommand command);
  PortStatus status() const;
  void requestStop() noexcept;

  // Called by the port's thread: begin(), step() until requestStop(), then finish().
  void begin(DeviceSink& sink);
  // Runs one round and catches every exception. If the cause is not the port (a bug, no memory
  // left), the hand is stopped, and the port is closed and opened again a second later.
  void step() noexcept;
  void finish() noexcept;
  bool stopping() const noexcept { return stopping_; }

 protected:
  // Communicates with the device behind a port that was just opened, until it delivers data. Throws
  // DeviceError.
  virtual void connect(ByteChannel& channel) = 0;
  // One round of commands and data. Must return within 100 ms when nothing is wrong.
  virtual void work() = 0;
  // The port disappeared or is given up; the channel still exists.
  virtual void disconnected() = 0;
  // The device does not answer, or its answers are not valid, and the channel will be closed:
  // writes what stops every motion, without waiting for an answer. `why` is one line.
  virtual void stopBlindly(ByteChannel& channel, const std::string& why) noexcept;
  // An unexpected exception occurred and the port will be closed: stops every motion.
  virtual void emergencyStop() {}
  // Called after the last round, whether the port is open or not.
  virtual void ended() {}
  // Called before the first round of a session: resets the counts and state of the previous
  // session.
  virtual void forget() {}
  virtual void closing() = 0;  // called on an open port before stop() returns
  virtual CommandAnswer execute(const DeviceCommand& command) = 0;

  // Executes the waiting commands one by one; the answer of a failed command contains its
  // exception. A DeviceError that means the port is gone is thrown again.
  void executeCommands();
  void rejectCommands(const std::string& why);
  bool hasQueuedCommands() const;
  // Waits for a command, at most until a monotonic time [us]. Tests replace it to advance a clock.
  virtual void waitForCommand(std::int64_t untilUs);
  // Adds a command. StopMotion goes before all others, and waiting motions are dropped.
  virtual void enqueue(QueuedCommand order);

  void setState(PortState state, const std::string& message = {}, bool unplugged = false);
  template <typename Change>
  void updateStatus(Change&& apply) {
    std::lock_guard lock(mutex_);
    apply(status_);
  }
  void event(const std::string& kind,
             const std::string& text,
             std::int64_t t0Us,
             std::int64_t t1Us,
             std::optional<int> matrix = {},
             const std::string& json = {});
  void eventNow(const std::string& kind, const std::string& text);
  // Shows how long a frame was under way beyond the time of a frame without delays.
  void measureAge(std::int64_t hostUs, std::int64_t deviceUs);
  // True if a device answered since start(); a device that answers now should be the same one.
  bool wasConnected() const noexcept { return wasConnected_; }
  // Returns the present host time, or lastUs + 1 if that is later [us since 1970]; stores it in
  // `lastUs`.
  std::int64_t stampAfter(std::int64_t& lastUs) const;

  const std::string port_;
  const std::string what_;  // such as "tactile controller"
  const HostTime& time_;
  const Clock& clock_;
  DeviceSink* sink_ = nullptr;
  mutable std::mutex mutex_;
  std::deque<QueuedCommand> commandQueue_;
  std::atomic<bool> stopping_ = false;
  // Minimum of (host time - device time) in this half minute and in the last one, that is, the
  // transmission time of a frame without delays.
  std::array<std::optional<std::int64_t>, 2> minOffsetUs_;

 private:
  void round();
  void closeAfterError(const DeviceError& error);
  void fail(const char* what) noexcept;

  Open open_;
  std::condition_variable commandQueued_;
  PortStatus status_;
  std::int64_t offsetWindowUs_ = 0;
  // Replaced only by the port's thread, under mutex_.
  std::unique_ptr<ByteChannel> channel_;
  // The device was given up although its port was there; until it answers again.
  bool gaveUp_ = false;
  // The last attempt found no port.
  bool portMissing_ = false;
  bool wasConnected_ = false;
  bool permanentlyFailed_ = false;
  std::int64_t nextTryUs_ = 0;
  std::string lastFailure_;
};

}  // namespace palpate
