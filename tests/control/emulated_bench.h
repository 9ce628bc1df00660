// Test bench: an emulated hand, the session on its two ports and its GraspControl, with a log of
// the bytes that arrive at the motion port. It uses threads, ptys and the machine's clock, as the
// program does.
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
  loaded.script.clear();  // the test moves the hand
  return std::make_unique<PhysicalHand>(loaded);
}

// A hand without objects in the open centrical preshape, in which a grasp begins.
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

  // Connects, and waits until both ports stream. `open` opens a port instead of openChannel().
  void connect(decltype(LiveHandOptions::open) open = {}) {
    LiveHandOptions ports;
    ports.open = std::move(open);
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
  // Waits until the grasp has ended; returns its report.
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
