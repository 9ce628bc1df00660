// A real or emulated hand on its ports, as a Device. One thread per port looks for the controller,
// opens it, streams, executes commands between two frames, detects silence and unplugging, and
// reconnects when the hand is back.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>
#include <palpate/device/device.h>

namespace palpate {

struct LiveHandOptions {
  // Port of the tactile controller, as openChannel() takes it; empty for none.
  std::string dsaPort;
  // Port of the motion controller; empty for none.
  std::string sdhPort;
  // Rate at which joint angles are requested, 1..250 [Hz].
  double angleHz = 110.0;
  // Rate at which temperatures are requested, 0.1..10 [Hz].
  double temperatureHz = 1.0;
  // Run-length coded frames arrive at 31.7 frames/s; raw frames at a third of that rate.
  bool runLength = true;
  // Opens a port; empty means openChannel(). Tests pass their own channel. Called from the port's
  // thread.
  std::function<std::unique_ptr<ByteChannel>(const std::string& port)> open;
  // Throws std::invalid_argument naming the field.
  void validate() const;
};

class LiveHand : public Device {
 public:
  // Opens no port yet. The clock must outlive the hand. Throws std::invalid_argument (options).
  explicit LiveHand(LiveHandOptions options, const Clock& clock = systemClock());
  ~LiveHand() override;
  LiveHand(const LiveHand&) = delete;
  LiveHand& operator=(const LiveHand&) = delete;

  HandDescription hand() const override;
  DeviceInfo info() const override;
  void start(DeviceSink& sink) override;
  // Also stops a motion that this object began; the axes keep their power.
  void stop() noexcept override;
  DeviceStatus status() const override;
  std::future<CommandAnswer> submit(DeviceCommand command) override;
  bool isFreeRunning() const override { return true; }
  std::optional<Event> openGap(std::int64_t untilUs) const override;
  std::vector<int> axisStates() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
