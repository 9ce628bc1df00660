// The scene of the tour in which a pen slips, by its mechanics alone.
#include "commands/demo_grasps.h"

#include <cmath>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/emulator/physical_hand.h"

#include "testing/testing.h"

namespace palpate::commands::demo_grasps_test {
namespace {

Scene sceneNamed(const char* name) { return loadScene(name, testing::dataFolder() / "scenes"); }

TEST(PullTimes, AreThoseOfTheScript) {
  const PullTimes times = pullTimesOf(sceneNamed("slipping_pen"));
  EXPECT_EQ(times.pullS, 4.0);
  EXPECT_EQ(times.releaseS, 7.0);
  EXPECT_GT(times.endS, times.releaseS);
  EXPECT_EQ(pullTimesOf(sceneNamed("slipping_handle")).releaseS, 15.0);
  EXPECT_THROW(pullTimesOf(sceneNamed("ball")), Error) << "nothing is pulled";
  EXPECT_THROW(pullTimesOf(sceneNamed("empty")), Error);
}

// Friction of 0.35 holds the pen until the pull, less its weight, is more than what both pads
// press; then it slips upwards, and stays in the fingers when the pull ends.
TEST(SlippingPen, SlipsWhenFrictionHoldsItNoLongerAndIsCaught) {
  const Scene scene = sceneNamed("slipping_pen");
  const PullTimes times = pullTimesOf(scene);
  PhysicalHand hand(scene);
  std::vector<std::uint16_t> counts(hand.hand().layout->numCells());
  const auto truthAt = [&](double timeS) {
    hand.advanceTo(timeS);
    hand.scan(counts);
    return hand.truth();
  };
  const auto held = truthAt(times.pullS - 0.5);
  ASSERT_TRUE(held[1].contact && held[5].contact);
  const auto rested = truthAt(times.pullS);
  EXPECT_NEAR(rested[1].slipYTaxels, held[1].slipYTaxels, 0.01) << "at rest";
  const double frictionLimitN = 0.35 * (rested[1].forceN + rested[5].forceN);
  const double weightN = 0.02 * 9.81, pullNPerS = 20.0 / 2.0;
  const double slipsS = times.pullS + (frictionLimitN + weightN) / pullNPerS;
  ASSERT_LT(slipsS, times.pullS + 2.0) << "the pull is strong enough";
  EXPECT_NEAR(truthAt(slipsS - 0.15)[1].slipYTaxels, rested[1].slipYTaxels, 0.1);
  EXPECT_LT(truthAt(slipsS + 0.4)[1].slipYTaxels, rested[1].slipYTaxels - 0.1) << "upwards";
  const auto caught = truthAt(times.releaseS - 0.4), last = truthAt(times.releaseS - 0.01);
  EXPECT_TRUE(last[1].contact && last[5].contact);
  EXPECT_LT(last[1].slipYTaxels, rested[1].slipYTaxels - 2.0);
  EXPECT_NEAR(last[1].slipYTaxels, caught[1].slipYTaxels, 0.05) << "it slips no longer";
}

}  // namespace
}  // namespace palpate::commands::demo_grasps_test
