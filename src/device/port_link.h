// What the threads of the two ports have in common: orders with answers, a status to read from
// outside, connecting, losing and finding the port again.
#pragma once

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

  // Any thread.
  std::future<CommandAnswer> submit(DeviceCommand command);
  PortStatus status() const;
  void requestStop() noexcept;

  // The port's thread: step() until requestStop(), then finish().
  void begin(DeviceSink& sink);
  // Whatever is thrown inside ends here: where it is no trouble of the port (a bug, no memory left)
  // the hand is stopped, the port closed and tried anew a second later.
  void step() noexcept;
  void finish() noexcept;
  bool stopping() const noexcept { return stopping_; }

 protected:
  // Talks to a device behind a port that was just opened, until data can come. Throws DeviceError.
  virtual void connect(ByteChannel& channel) = 0;
  // One round: orders, data. Must return within 100 ms when nothing is wrong.
  virtual void work() = 0;
  // The port is gone or given up; the channel still exists.
  virtual void disconnected() = 0;
  // The program failed, and the port will be closed: nothing may be left moving.
  virtual void emergencyStop() {}
  // After the last round, whether the port is open or not.
  virtual void ended() {}
  // Before the first round of a session: what was counted and seen in the one before is forgotten.
  virtual void forget() {}
  virtual void closing() = 0;  // last words on an open port, before stop() returns
  virtual CommandAnswer execute(const DeviceCommand& command) = 0;

  // Takes orders one by one; an order that fails carries its exception. DeviceErrors that mean the
  // port is gone are thrown on.
  void executeCommands();
  void rejectCommands(const std::string& why);
  bool hasQueuedCommands() const;
  // Waits for an order, at most until a monotonic time [us].
  void waitForCommand(std::int64_t untilUs);
  // Stops: StopMotion goes ahead, and moves that wait are dropped.
  virtual void enqueue(QueuedCommand order);

  void setState(PortState state, const std::string& message = {});
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
  // Since start(); a device that answers now should be the same one.
  bool wasConnected() const noexcept { return wasConnected_; }
  // A stamp later than the last one given for `lastUs` [us since 1970].
  std::int64_t stampAfter(std::int64_t& lastUs) const;

  const std::string port_;
  const std::string what_;  // "tactile controller"
  const HostTime& time_;
  const Clock& clock_;
  DeviceSink* sink_ = nullptr;
  mutable std::mutex mutex_;
  std::deque<QueuedCommand> commandQueue_;
  std::atomic<bool> stopping_ = false;

 private:
  void round();
  void closeAfterError(const DeviceError& error);
  void fail(const char* what) noexcept;

  Open open_;
  std::condition_variable commandQueued_;
  PortStatus status_;
  std::unique_ptr<ByteChannel> channel_;  // replaced by the port's thread only, under mutex_
  bool wasConnected_ = false;
  bool permanentlyFailed_ = false;
  std::int64_t nextTryUs_ = 0;
  std::string lastFailure_;
};

}  // namespace palpate
