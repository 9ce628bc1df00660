#include "palpate/control/empty_hand_cycle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "control/scripted_hand.h"

namespace palpate::empty_hand_cycle_test {
namespace {

class EmptyHandCycleTest : public ::testing::Test {
 protected:
  std::int64_t now() const { return bench_.clock.hostUs(); }
  std::size_t numMotions() const { return bench_.hand->count<MoveJoints>(); }
  // Begins a cycle, moves to the open preshape, and closes until the pads touch.
  void closeUntilThePadsTouch() {
    run_.begin(now());
    pass(1.2, 0.0F);  // each motion takes a second
    bench_.hand->states.assign(7, 1);
    pass(0.06, 700.0F);  // above the limit of 600
    bench_.hand->states.assign(7, 6);
    for (int i = 0; i < 40 && run_.state() != EmptyHandCycle::State::kHolding; ++i) pass(0.03);
  }
  // Advances the time with a frame every 30 ms.
  void pass(double seconds, float counts = 650.0F) {
    bench_.feel(static_cast<int>(std::lround(seconds / 0.03)), counts);
  }

  testing::GraspBench bench_;
  EmptyHandCycle run_{*bench_.control};
};

TEST_F(EmptyHandCycleTest, ClosesHoldsAndOpens) {
  closeUntilThePadsTouch();
  ASSERT_EQ(bench_.control->status().phase, GraspPhase::kIdle);
  ASSERT_EQ(bench_.control->status().last->outcome, GraspOutcome::kLimitReached);
  const std::size_t motions = numMotions();
  EXPECT_EQ(run_.takeProblem(), std::nullopt);
  EXPECT_EQ(run_.state(), EmptyHandCycle::State::kHolding);
  pass(1.35);
  EXPECT_EQ(run_.takeProblem(), std::nullopt);
  EXPECT_EQ(numMotions(), motions) << "holds for 1.5 s";
  pass(0.3);
  EXPECT_EQ(run_.takeProblem(), std::nullopt);
  EXPECT_EQ(run_.state(), EmptyHandCycle::State::kOpening);
  EXPECT_EQ(numMotions(), motions + 1);
  EXPECT_EQ(run_.onPadsReleased(), std::nullopt) << "as it should be";
  EXPECT_FALSE(run_.active());
}

TEST_F(EmptyHandCycleTest, AStopOfTheHandEndsItAndNothingMovesAfterwards) {
  run_.begin(now());
  bench_.control->stop();
  bench_.feel(5);
  const std::size_t motions = numMotions();
  EXPECT_EQ(run_.takeProblem(), "the hand was stopped");
  EXPECT_FALSE(run_.active());
  pass(5.1);
  EXPECT_EQ(run_.takeProblem(), std::nullopt) << "told once";
  EXPECT_EQ(numMotions(), motions);
}

// Nothing moves while it holds: no grasp runs in GraspControl that could end.
TEST_F(EmptyHandCycleTest, AStopWhileItHoldsEndsItToo) {
  for (const bool relaxed : {false, true}) {
    closeUntilThePadsTouch();
    ASSERT_EQ(run_.state(), EmptyHandCycle::State::kHolding);
    relaxed ? bench_.control->relax() : bench_.control->stop();
    const std::size_t motions = numMotions();
    pass(3.0);
    EXPECT_EQ(run_.takeProblem(), "the hand was stopped");
    EXPECT_EQ(numMotions(), motions) << "it doesn't open";
    pass(0.9, 0.0F);
  }
}

TEST_F(EmptyHandCycleTest, AMotionOfSomebodyElseWhileItHoldsEndsIt) {
  closeUntilThePadsTouch();
  bench_.control->preshape("centrical", 5.0);
  const std::size_t motions = numMotions();
  pass(0.3);
  EXPECT_EQ(run_.takeProblem(), "the hand does something else");
  EXPECT_EQ(numMotions(), motions);
}

TEST_F(EmptyHandCycleTest, PadsThatLetGoTooEarlyGiveNoResult) {
  closeUntilThePadsTouch();
  EXPECT_EQ(run_.takeProblem(), std::nullopt);
  EXPECT_EQ(run_.onPadsReleased(), "the pads let go of each other");
  EXPECT_FALSE(run_.active());
}

TEST_F(EmptyHandCycleTest, PadsThatNeverLetGoAreWaitedForTenSeconds) {
  closeUntilThePadsTouch();
  pass(1.65);
  ASSERT_EQ(run_.state(), EmptyHandCycle::State::kOpening);
  pass(9.6);
  EXPECT_EQ(run_.takeProblem(), std::nullopt);
  pass(0.6);
  EXPECT_EQ(run_.takeProblem(), "the pads didn't touch, or don't separate");
  EXPECT_FALSE(run_.active());
}

TEST_F(EmptyHandCycleTest, AfterItWasGivenUpNothingOfItMovesTheHand) {
  closeUntilThePadsTouch();
  run_.cancel();
  const std::size_t motions = numMotions();
  pass(5.1);
  EXPECT_EQ(run_.takeProblem(), std::nullopt);
  EXPECT_EQ(numMotions(), motions);
}

TEST_F(EmptyHandCycleTest, AnEarlierGraspIsNotTakenForItsOwn) {
  closeUntilThePadsTouch();
  ASSERT_TRUE(bench_.control->status().last.has_value());
  pass(0.9, 0.0F);
  run_.begin(now());
  EXPECT_EQ(run_.takeProblem(), std::nullopt);
  EXPECT_EQ(run_.state(), EmptyHandCycle::State::kClosing);
}

TEST_F(EmptyHandCycleTest, ARefusalIsThrownAndNothingRuns) {
  bench_.hand->state.motion->state = PortState::kFault;
  bench_.wait(10'000);
  EXPECT_THROW(run_.begin(now()), DeviceError);
  EXPECT_FALSE(run_.active());
  EXPECT_EQ(numMotions(), 0u);
}

}  // namespace
}  // namespace palpate::empty_hand_cycle_test
