// A hand on its ports: a thread per port looks for the controller, opens it, streams, executes
// commands between two frames, notices silence and unplugging, and finds the hand again.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>
#include <palpate/device/device.h>

namespace palpate {

struct LiveHandOptions {
  std::string dsaPort;     // tactile controller; as openChannel() takes it. Empty: no tactile port
  std::string sdhPort;     // motion controller; empty: no motion port
  double angleHz = 110.0;  // joint angles are asked for so often, 1..250 [Hz]
  double temperatureHz = 1.0;  // 0.1..10 [Hz]
  bool runLength = true;       // frames run-length coded (31.7 frames/s); raw is a third as fast
  // How a port is opened; tests hand in their own line. Called from the port's thread.
  std::function<std::unique_ptr<ByteChannel>(const std::string& port)> open;
  // Throws std::invalid_argument naming the field.
  void validate() const;
};

class LiveHand : public Device {
 public:
  // Opens nothing yet. The clock must outlive the hand. Throws std::invalid_argument (options).
  explicit LiveHand(LiveHandOptions options, const Clock& clock = systemClock());
  ~LiveHand() override;
  LiveHand(const LiveHand&) = delete;
  LiveHand& operator=(const LiveHand&) = delete;

  HandDescription hand() const override;
  DeviceInfo facts() const override;
  void start(DeviceSink& sink) override;
  // A motion that this hand began is stopped first; axes keep their power.
  void stop() noexcept override;
  DeviceStatus status() const override;
  std::future<CommandAnswer> submit(DeviceCommand command) override;
  bool isFreeRunning() const override { return true; }
  std::vector<int> axisStates() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
