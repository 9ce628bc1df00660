// Sequences of motions of the emulated hand, in real time: frames or answers that come late end
// them.
#include <gtest/gtest.h>

#include "palpate/control/motion_sequence.h"
#include "palpate/device/sdh2.h"

#include "control/emulated_bench.h"
#include "control/sequence_steps.h"

namespace palpate::motion_sequence_slow_test {
namespace {
using namespace testing;

using Kind = SequenceStep::Kind;

// On the emulated hand, over its ports.
class SequenceOnTheHand : public ::testing::Test {
 protected:
  void connect() {
    bench_.connect();
    run_ = std::make_unique<SequenceRun>(*bench_.control);
  }
  bool go(const std::function<bool()>& until) { return testing::eventuallyTrue(until); }
  void begin() {
    MotionSequence sequence = everyKind();
    sequence.steps = {
        opening(), grasping(GraspMode::kReactive, 0.6, 60.0), resting(Kind::kHold, 0.3), posing()};
    sequence.repetitions = 2;
    run_->begin(sequence, sdh2(), bench_.session->nowUs());
  }

  testing::EmulatedBench bench_{testing::stillHand()};
  std::unique_ptr<SequenceRun> run_;
};

TEST_F(SequenceOnTheHand, MovesItAsTheTableSays) {
  connect();
  begin();
  ASSERT_TRUE(go([&] { return !run_->running(); }));
  EXPECT_EQ(run_->status().text, "sequence finished: 4 steps, 2 times");
  EXPECT_EQ(bench_.log.named("m").size(), 6u);
  std::vector<double> angles;
  bench_.hand->withModel([&](HandModel& model) { angles = model.joints().angles(); });
  for (std::size_t axis = 0; axis < 7; ++axis)
    EXPECT_NEAR(angles[axis], axis == 0 ? 30.0 : axis % 2 == 1 ? -40.0 : 40.0, 0.01);
}

TEST_F(SequenceOnTheHand, AStopInEachStepStopsTheHandForGood) {
  connect();
  for (std::size_t step = 0; step < 4; ++step) {
    begin();
    ASSERT_TRUE(go([&] { return run_->status().step == step; }));
    const std::int64_t stoppedUs = systemClock().monotonicUs();
    bench_.control->stop();
    ASSERT_TRUE(testing::eventuallyTrue(
        [&] { return bench_.log.firstSince("stop", stoppedUs).has_value(); }));
    ASSERT_TRUE(go([&] { return !run_->running(); }));
    ASSERT_TRUE(go([&] {
      return !bench_.handMoves() && bench_.control->status().phase == GraspPhase::kIdle;
    }));
    const std::int64_t arrivedUs = bench_.log.firstSince("stop", stoppedUs)->monoUs;
    for (const testing::ArrivedCommand& deed : bench_.log.deeds())
      EXPECT_LE(deed.monoUs, arrivedUs) << deed.name << " behind the stop in step " << step;
  }
}

TEST_F(SequenceOnTheHand, UnpluggingItEndsTheSequence) {
  connect();
  for (const std::size_t step : {std::size_t{1}, std::size_t{2}}) {
    begin();
    ASSERT_TRUE(go([&] { return run_->status().step == step; }));
    bench_.hand->unplug(true, true);
    ASSERT_TRUE(go([&] { return !run_->running(); })) << step;
    EXPECT_TRUE(run_->status().failed);
    bench_.hand->replug();
    ASSERT_TRUE(
        go([&] { return bench_.control->status().cannotReact.empty() && !bench_.handMoves(); }));
    const std::size_t motions = bench_.log.named("m").size();
    for (int i = 0; i < 50; ++i) run_->step(bench_.session->nowUs() + i * 1'000'000);
    EXPECT_EQ(bench_.log.named("m").size(), motions) << "it doesn't go on by itself";
  }
}

}  // namespace
}  // namespace palpate::motion_sequence_slow_test
