// Test bench: a GraspStateMachine with simulated time and frames.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/device/sdh2.h"

namespace palpate::testing {

constexpr std::int64_t kPeriodUs = 31'546;
inline const std::vector<int> kIdle(7, 0);
inline const std::vector<int> kMoving{0, 1, 1, 0, 0, 1, 1};
inline const std::vector<int> kHeld{0, 4, 0, 0, 0, 4, 0};

struct MachineBench {
  GraspStateMachine machine{sdh2()};
  std::int64_t us = 1'000'000;

  MachineBench() { frames(20); }
  void frame(float counts = 0.0F, std::size_t matrix = 1, int row = 3, int column = 2) {
    TactileFrame felt(sdh2().layout);
    felt.hostUs = 1'700'000'000'000'000 + us;
    felt.matrix(matrix)(row, column) = counts;
    machine.onFrame(felt, us);
  }
  void frames(int count, float counts = 0.0F) {
    for (int i = 0; i < count; ++i) {
      us += kPeriodUs;
      frame(counts);
    }
  }
  void begin(const GraspRequest& request) { machine.begin(request, us, 42); }
  // Takes the motion command and acknowledges it for the hand.
  MoveJoints take(double durationS = 2.0) {
    const auto command = machine.takeCommand();
    const MoveJoints move = std::get<MoveJoints>(command.value());
    machine.onMoveAcknowledged(durationS, us);
    return move;
  }
  // Advances by the half second after the stop at a limit.
  void lookOn(float counts = 0.0F) {
    for (int i = 0; i < 17; ++i) {
      frames(1, counts);
      machine.onTime(us);
    }
  }
  bool takeStop() {
    const auto command = machine.takeCommand();
    return command && std::holds_alternative<StopMotion>(*command);
  }
};

inline GraspRequest reactive(int limit = 200) {
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.closeRatio = 1.0;
  request.limitCounts = limit;
  return request;
}

}  // namespace palpate::testing
