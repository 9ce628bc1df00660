// Fake device and clock that are controlled by the test.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "palpate/capture/capture_session.h"
#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/device/device.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/recording.h"

namespace palpate::testing {

constexpr std::int64_t kWallStartUs = 1'700'000'000'000'000;

// Clock that advances only when the test sets it.
class HandClock : public Clock {
 public:
  std::int64_t monotonicUs() const override { return monoUs_; }
  std::int64_t wallUs() const override { return kWallStartUs + monoUs_ + jumpUs_; }
  void pass(std::int64_t us) { monoUs_ += us; }
  void jumpWall(std::int64_t us) { jumpUs_ += us; }
  // Host time, for a session that began at monotonic time 0.
  std::int64_t hostUs() const { return kWallStartUs + monoUs_; }

 private:
  std::atomic<std::int64_t> monoUs_ = 0;
  std::atomic<std::int64_t> jumpUs_ = 0;
};

// A frame whose values encode its number n.
inline TactileFrame numberedFrame(std::size_t n, std::int64_t hostUs) {
  TactileFrame frame(sdh2().layout);
  frame.hostUs = hostUs;
  frame.deviceUs = static_cast<std::int64_t>(n) * 32'000 + 7'000;
  frame.values[0] = static_cast<float>(n % 4096);
  frame.values[1] = static_cast<float>(n / 4096 % 4096);
  for (std::size_t k = 2; k < 60; ++k)
    frame.values[k * 8] = static_cast<float>((n * 7919 + k * 104729) % 3400);
  return frame;
}
inline Sample numberedAngles(std::size_t n, std::int64_t hostUs) {
  std::vector<double> deg(7, 0.125 * static_cast<double>(n % 700));
  deg[6] = 0.1;  // not representable as float
  return {hostUs, deg};
}

class ScriptedDevice : public Device {
 public:
  // The test delivers items through this sink; valid while the device is started.
  DeviceSink* sink = nullptr;
  DeviceStatus state;
  DeviceInfo says;
  // Host time since which no frame came, which is going on; 0: frames come.
  std::int64_t silentSinceUs = 0;
  std::vector<SeriesDescription> further;  // before a session has the device
  // Called when the open gap was asked for.
  std::function<void()> afterOpenGap;

  ScriptedDevice() { state.tactile.port = "/dev/scripted"; }
  HandDescription described = sdh2();
  HandDescription hand() const override { return described; }
  std::vector<SeriesDescription> series() const override { return further; }
  DeviceInfo info() const override { return says; }
  void start(DeviceSink& to) override {
    sink = &to;
    state.tactile.state = PortState::kStreaming;
  }
  void stop() noexcept override {
    sink = nullptr;
    state.tactile.state = PortState::kClosed;
  }
  DeviceStatus status() const override { return state; }
  std::optional<Event> openGap(std::int64_t untilUs) const override {
    if (afterOpenGap) afterOpenGap();
    if (silentSinceUs == 0) return std::nullopt;
    return Event{silentSinceUs, untilUs, "gap", {}, "silent", R"({"lost":7})"};
  }
  std::future<CommandAnswer> submit(DeviceCommand) override {
    std::promise<CommandAnswer> none;
    none.set_exception(std::make_exception_ptr(
        DeviceError(DeviceFault::kUnsupported, "/dev/scripted", "takes no command")));
    return none.get_future();
  }

  void frame(std::size_t n, std::int64_t hostUs) { sink->onFrame(numberedFrame(n, hostUs)); }
  void angles(std::size_t n, std::int64_t hostUs) { sink->onSample(numberedAngles(n, hostUs)); }
  void temperatures(double degC, std::int64_t hostUs) {
    sink->onSample({hostUs, std::vector<double>(9, degC), kTemperatureSeries});
  }
};

// A session on a scripted device; the test runs its recorder and its clock.
struct ScriptedSession {
  HandClock clock;
  ScriptedDevice* device = nullptr;
  std::unique_ptr<CaptureSession> session;
  std::size_t frames = 0;  // number of frames delivered by run()
  std::size_t samples = 0;

  explicit ScriptedSession(CaptureOptions options = {},
                           std::vector<SeriesDescription> further = {}) {
    auto owned = std::make_unique<ScriptedDevice>();
    device = owned.get();
    device->further = std::move(further);
    options.ownThread = false;
    session = std::make_unique<CaptureSession>(std::move(owned), std::move(options), clock);
    session->start();
  }

  // Advances the time: a frame every 10 ms, angles every 5 ms, temperatures every second, a round
  // of the recorder every 20 ms.
  void run(double seconds, bool rounds = true) {
    const auto steps = static_cast<std::int64_t>(seconds * 200.0 + 0.5);
    for (std::int64_t i = 0; i < steps; ++i) {
      clock.pass(5'000);
      const std::int64_t now = clock.hostUs();
      const std::int64_t tick = clock.monotonicUs() / 5'000;
      if (tick % 200 == 0) device->temperatures(30.0, now);
      device->angles(samples++, now);
      if (tick % 2 == 0) device->frame(frames++, now);
      if (rounds && tick % 4 == 0) session->step();
    }
  }
};

// The number encoded in a frame of a scripted device.
inline std::size_t numberOf(const TactileFrame& frame) {
  return static_cast<std::size_t>(frame.values[0]) +
         4096 * static_cast<std::size_t>(frame.values[1]);
}

inline RecordingOptions to(const std::filesystem::path& path) {
  RecordingOptions options;
  options.path = path;
  return options;
}

// The numbers of the frames of a recording.
inline std::vector<std::size_t> numbersIn(const std::filesystem::path& path) {
  std::vector<std::size_t> numbers;
  const Profile profile = openRecording(path);
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    numbers.push_back(numberOf(profile.frame(i)));
  return numbers;
}

inline std::vector<std::size_t> upTo(std::size_t begin, std::size_t end) {
  std::vector<std::size_t> numbers;
  for (std::size_t n = begin; n < end; ++n) numbers.push_back(n);
  return numbers;
}

}  // namespace palpate::testing
