// An emulated hand, the session on its two ports and the control of it, with a log of what arrives
// on the motion port. Everything is as in the program: threads, ptys, the machine's clock.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "palpate/control/grasp_control.h"
#include "palpate/core/error.h"
#include "palpate/device/live_hand.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/physical_hand.h"

#include "control/motion_log.h"
#include "emulator/still_hand.h"
#include "testing/awaited.h"
#include "testing/testing.h"

namespace palpate::testing {

inline bool eventuallyTrue(const std::function<bool()>& condition,
                           std::chrono::milliseconds limit = std::chrono::seconds(20)) {
  return awaited(condition, limit);
}

inline std::unique_ptr<HandModel> handWith(const std::string& scene) {
  Scene loaded = loadScene(scene, dataFolder() / "scenes");
  loaded.script.clear();  // who moves it is the test
  return std::make_unique<PhysicalHand>(loaded);
}

// Centrical, open: where a grasp begins.
inline std::unique_ptr<HandModel> stillHand() {
  return std::make_unique<StillHand>(std::vector<double>{60, -75, 75, -75, 75, -75, 75});
}

struct EmulatedBench {
  const TemporaryFolder folder;
  MotionLog log;
  std::unique_ptr<EmulatedHand> hand;
  std::unique_ptr<CaptureSession> session;
  std::unique_ptr<GraspControl> control;

  explicit EmulatedBench(std::unique_ptr<HandModel> model,
                         EmulatedHandOptions options = {},
                         FrameObserver observer = {}) {
    options.dsaPort = (folder / "dsa").string();
    options.sdhPort = (folder / "sdh").string();
    options.received = log.observer();
    hand =
        std::make_unique<EmulatedHand>(std::move(model), std::move(options), std::move(observer));
  }
  ~EmulatedBench() {
    control.reset();
    session.reset();
  }

  // Connects, and waits until both ports stream.
  void connect() {
    LiveHandOptions ports;
    ports.dsaPort = hand->dsaPort();
    ports.sdhPort = hand->sdhPort();
    session = std::make_unique<CaptureSession>(std::make_unique<LiveHand>(ports));
    control = std::make_unique<GraspControl>(*session);
    control->run();
    session->start();
    ASSERT_TRUE(eventuallyTrue([&] { return control->status().cannotReact.empty(); }))
        << control->status().cannotReact;
  }
  bool handMoves() {
    bool moves = false;
    hand->withModel([&](HandModel& model) { moves = model.joints().moving(); });
    return moves;
  }
  bool awaitMotion() {
    return eventuallyTrue([this] { return handMoves(); });
  }
  // Until the grasp has ended; its report.
  std::optional<GraspReport> awaitEnd() {
    if (!eventuallyTrue([this] { return control->status().phase == GraspPhase::kIdle; }))
      return std::nullopt;
    return control->status().last;
  }
};

inline GraspRequest reactiveGrasp(int limit = 200, double velocity = 30.0) {
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.closeRatio = 1.0;
  request.velocityDegPerS = velocity;
  request.limitCounts = limit;
  return request;
}

}  // namespace palpate::testing
