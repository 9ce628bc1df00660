// Test bench: a PhysicalHand without port and thread, driven by a GraspStateMachine. Time advances
// as fast as it can be computed, and every run is the same.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/emulator/physical_hand.h"

#include "testing/testing.h"

namespace palpate::testing {

class HeldObject {
 public:
  static constexpr double kPeriodS = 0.0315;

  explicit HeldObject(const Scene& scene) : hand_(scene), machine_(hand_.hand()) {
    counts_.resize(hand_.hand().layout->numCells());
    run(1.0);  // the state machine knows its stream after that
  }

  GraspStateMachine& machine() { return machine_; }
  PhysicalHand& hand() { return hand_; }
  double timeS() const { return timeS_; }
  std::int64_t us() const { return static_cast<std::int64_t>(std::llround(timeS_ * 1e6)); }
  const std::vector<GraspStep>& notes() const { return notes_; }
  // All motions that were commanded.
  const std::vector<MoveJoints>& moves() const { return moves_; }
  int actions(const std::string& action) const {
    int found = 0;
    for (const GraspStep& note : notes_) found += note.action == action ? 1 : 0;
    return found;
  }
  double farthestSlip() const {  // largest slip of a matrix now [taxels]
    double farthest = 0.0;
    for (const MatrixTruth& truth : hand_.truth())
      if (truth.contact)
        farthest = std::max(farthest, std::hypot(truth.slipXTaxels, truth.slipYTaxels));
    return farthest;
  }
  int contacts() const {
    int found = 0;
    for (const MatrixTruth& truth : hand_.truth()) found += truth.contact ? 1 : 0;
    return found;
  }

  void begin(const GraspRequest& request, const std::optional<Touch>& touch = {}) {
    machine_.begin(request, us(), us(), touch);
  }
  // Advances the time by `seconds`, or until `enough` returns true after a frame.
  bool run(double seconds, const std::function<bool()>& enough = {}) {
    const double endS = timeS_ + seconds;
    while (timeS_ < endS) {
      phase_ = machine_.phase();
      timeS_ += kPeriodS;
      hand_.advanceTo(timeS_);
      hand_.scan(counts_);
      TactileFrame frame(hand_.hand().layout);
      frame.hostUs = 1'700'000'000'000'000 + us();
      for (std::size_t i = 0; i < counts_.size(); ++i)
        frame.values[i] = static_cast<float>(counts_[i]);
      machine_.onAngles(hand_.joints().angles(), us());
      machine_.onFrame(frame, us());
      checkPhase();
      obey();
      std::vector<int> states;
      for (const AxisState state : hand_.joints().states())
        states.push_back(static_cast<int>(state));
      machine_.onAxisStates(states, us());
      checkPhase();
      machine_.onTime(us());
      checkPhase();
      obey();
      for (GraspStep& note : machine_.takeNotes()) notes_.push_back(std::move(note));
      if (enough && enough()) return true;
    }
    return !enough;
  }

 private:
  void obey() {
    while (auto command = machine_.takeCommand()) {
      JointMotion& joints = hand_.joints();
      if (const auto* move = std::get_if<MoveJoints>(&*command)) {
        moves_.push_back(*move);
        joints.setTargets(move->targetDeg);
        joints.setVelocities(move->velocityDegPerS);
        joints.setProfile(move->ramp ? VelocityProfile::kRamp : VelocityProfile::kSinSquare);
        machine_.onMoveAcknowledged(joints.startMotion(), us());
      } else {
        joints.stop();
        machine_.onStopAcknowledged(us());
      }
      checkPhase();
    }
  }

  // Whatever the hand holds, the phases follow each other as the table of states says.
  void checkPhase() {
    const GraspPhase before = std::exchange(phase_, machine_.phase());
    EXPECT_TRUE(phase_ == before || mayFollow(before, phase_))
        << nameOf(before) << ", then " << nameOf(phase_);
  }

  PhysicalHand hand_;
  GraspStateMachine machine_;
  GraspPhase phase_ = GraspPhase::kIdle;
  std::vector<std::uint16_t> counts_;
  std::vector<GraspStep> notes_;
  std::vector<MoveJoints> moves_;
  double timeS_ = 0.0;
};

}  // namespace palpate::testing
