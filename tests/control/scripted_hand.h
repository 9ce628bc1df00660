// Test bench: a fake hand that behaves as the test specifies and stores the received commands, with
// its session and its GraspControl, on a clock of the test and without a thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/control/grasp_control.h"
#include "palpate/device/sdh2.h"

#include "capture/scripted_device.h"

namespace palpate::testing {

class ScriptedHand : public ScriptedDevice {
 public:
  ScriptedHand() {
    state.motion.emplace();
    state.motion->port = "/dev/motion";
    state.motion->state = PortState::kStreaming;
  }
  std::future<CommandAnswer> submit(DeviceCommand command) override {
    std::promise<CommandAnswer> answer;
    std::future<CommandAnswer> future = answer.get_future();
    if (answers)
      answer.set_value({.durationS = durationS});
    else
      waiting.push_back(std::move(answer));
    commands.push_back(std::move(command));
    return future;
  }
  std::vector<int> axisStates() const override {
    if (fails) fails();
    return states;
  }

  DeviceStatus status() const override {
    if (statusFails) statusFails();
    return state;
  }

  template <typename Command>
  std::size_t count() const {
    std::size_t found = 0;
    for (const DeviceCommand& command : commands) found += std::holds_alternative<Command>(command);
    return found;
  }

  std::function<void()> fails;        // throws when the axis states are read
  std::function<void()> statusFails;  // throws when the port status is read
  bool answers = true;  // answers at once; otherwise the test answers pending commands
  double durationS = 1.0;
  std::vector<DeviceCommand> commands;  // all commands received
  std::vector<std::promise<CommandAnswer>> waiting;
  std::vector<int> states = std::vector<int>(7, 6);
};

struct GraspBench {
  HandClock clock;
  ScriptedHand* hand = nullptr;
  std::unique_ptr<CaptureSession> session;
  std::unique_ptr<GraspControl> control;
  std::size_t frames = 0;

  GraspBench() {
    auto owned = std::make_unique<ScriptedHand>();
    hand = owned.get();
    CaptureOptions options;
    options.ownThread = false;
    session = std::make_unique<CaptureSession>(std::move(owned), options, clock);
    session->start();
    control = std::make_unique<GraspControl>(*session, clock);
    feel(20);
  }
  // Sends frames every 30 ms whose largest taxel is at finger 2 distal, x 1, y 6.
  void feel(int count, float counts = 0.0F) {
    for (int i = 0; i < count; ++i) {
      clock.pass(30'000);
      TactileFrame frame(sdh2().layout);
      frame.hostUs = clock.hostUs();
      frame.matrix(5)(6, 1) = counts;
      hand->sink->onFrame(std::move(frame));
      control->step();
    }
  }
  void wait(std::int64_t us) {
    clock.pass(us);
    control->step();
  }
};

}  // namespace palpate::testing
