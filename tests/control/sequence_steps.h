// Steps of sequences for tests.
#pragma once

#include "palpate/control/motion_sequence.h"
#include "palpate/device/sdh2.h"

namespace palpate::testing {

inline SequenceStep opening(double velocity = 100.0) {
  SequenceStep step;
  step.kind = SequenceStep::Kind::kOpen;
  step.request.closeRatio = 0.0;
  step.request.velocityDegPerS = velocity;
  return step;
}
inline SequenceStep grasping(GraspMode mode, double closeRatio = 1.0, double velocity = 100.0) {
  SequenceStep step;
  step.kind = SequenceStep::Kind::kGrasp;
  step.request.mode = mode;
  step.request.closeRatio = closeRatio;
  step.request.velocityDegPerS = velocity;
  return step;
}
inline SequenceStep resting(SequenceStep::Kind kind, double seconds) {
  SequenceStep step;
  step.kind = kind;
  step.seconds = seconds;
  return step;
}
inline SequenceStep posing() {
  SequenceStep step;
  step.kind = SequenceStep::Kind::kPose;
  step.pose = {"half", sdh2().name, {30, -40, 40, -40, 40, -40, 40}};
  step.request.velocityDegPerS = 90.0;
  return step;
}
// One step of each kind.
inline MotionSequence everyKind() {
  MotionSequence sequence;
  sequence.hand = sdh2().name;
  sequence.steps = {opening(),
                    posing(),
                    grasping(GraspMode::kReactive, 0.8),
                    resting(SequenceStep::Kind::kHold, 2.0),
                    resting(SequenceStep::Kind::kWait, 1.0)};
  return sequence;
}

}  // namespace palpate::testing
