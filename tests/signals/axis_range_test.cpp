#include "palpate/signals/axis_range.h"

#include "testing/testing.h"

namespace palpate::axis_range_test {
namespace {

TEST(AxisRange, NiceNumbersAreOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(niceAbove(1.0), 1.0);
  EXPECT_DOUBLE_EQ(niceAbove(1.1), 2.0);
  EXPECT_DOUBLE_EQ(niceAbove(2.1), 5.0);
  EXPECT_DOUBLE_EQ(niceAbove(730.0), 1000.0);
  EXPECT_DOUBLE_EQ(niceAbove(0.03), 0.05);
}

TEST(AxisRange, FittedItHoldsAllValuesWithRoom) {
  EXPECT_EQ(fittedRange(std::nullopt, true), (AxisRange{0.0, 1.06}));
  EXPECT_EQ(fittedRange(ValueExtent{20.0, 100.0}, true), (AxisRange{0.0, 106.0}));
  const AxisRange around = fittedRange(ValueExtent{20.0, 120.0}, false);
  EXPECT_NEAR(around.from, 14.0, 1e-9);
  EXPECT_NEAR(around.to, 126.0, 1e-9);
  const AxisRange below = fittedRange(ValueExtent{-50.0, 50.0}, true);
  EXPECT_NEAR(below.from, -56.0, 1e-9);
  EXPECT_NEAR(below.to, 56.0, 1e-9);
}

TEST(AxisRange, RollingItChangesOnlyInSteps) {
  RollingRange range;
  EXPECT_EQ(range.update(std::nullopt, {}), (AxisRange{0.0, 1.0}));
  EXPECT_EQ(range.update(ValueExtent{10.0, 730.0}, {}), (AxisRange{0.0, 1000.0}));
  EXPECT_EQ(range.update(ValueExtent{10.0, 990.0}, {}), (AxisRange{0.0, 1000.0}));
  EXPECT_EQ(range.update(ValueExtent{10.0, 400.0}, {}), (AxisRange{0.0, 1000.0}));
  EXPECT_EQ(range.update(std::nullopt, {}), (AxisRange{0.0, 1000.0}));
  EXPECT_EQ(range.update(ValueExtent{10.0, 20.0}, {}), (AxisRange{0.0, 50.0}));
  EXPECT_EQ(range.update(ValueExtent{0.0, 0.0}, {}), (AxisRange{0.0, 1.0}));
}

TEST(AxisRange, ItDoesNotGoFurtherThanValuesCan) {
  RollingRange range;
  const AxisRangeOptions options{.fromZero = true, .ceiling = 3500.0};
  EXPECT_EQ(range.update(ValueExtent{0.0, 3400.0}, options), (AxisRange{0.0, 3710.0}));
  EXPECT_EQ(range.update(ValueExtent{0.0, 3500.0}, options), (AxisRange{0.0, 3710.0}));
  EXPECT_EQ(range.update(ValueExtent{0.0, 900.0}, options), (AxisRange{0.0, 1000.0}));
  EXPECT_EQ(range.update(ValueExtent{0.0, 4000.0}, options), (AxisRange{0.0, 5000.0}))
      << "a value beyond is shown all the same";
}

TEST(AxisRange, NegativeValuesAreShown) {
  RollingRange range;
  const AxisRange both = range.update(ValueExtent{-30.0, 80.0}, {});
  EXPECT_EQ(both, (AxisRange{-50.0, 100.0}));
}

// The noise of a resting sensor, 41.2 .. 41.3, in one unit with 6 % of room: 40.75 - .06 .. 41.75 +
// .06.
TEST(AxisRange, FittedItSpansTheLeastExtent) {
  const AxisRange resting = fittedRange(ValueExtent{41.2, 41.3}, false, 1.0);
  EXPECT_NEAR(resting.from, 40.69, 1e-9);
  EXPECT_NEAR(resting.to, 41.81, 1e-9);
  EXPECT_EQ(fittedRange(ValueExtent{20.0, 120.0}, false, 1.0),
            fittedRange(ValueExtent{20.0, 120.0}, false));
  EXPECT_EQ(fittedRange(ValueExtent{0.0, 0.1}, true, 1.0),
            fittedRange(ValueExtent{0.0, 0.1}, true));
}

// An accelerometer in g is no flat line.
TEST(AxisRange, RollingItFollowsSmallValuesOfOtherSensors) {
  RollingRange range;
  const AxisRangeOptions any{.fromZero = false, .minExtent = 0.0};
  const AxisRange small = range.update(ValueExtent{-0.02, 0.03}, any);
  EXPECT_LE(small.from, -0.02);
  EXPECT_GE(small.to, 0.03);
  EXPECT_LE(small.to - small.from, 0.1);
  range.reset();
  const AxisRange constant = range.update(ValueExtent{0.0, 0.0}, any);
  EXPECT_LT(constant.from, 0.0);
  EXPECT_GT(constant.to, 0.0);
  EXPECT_EQ(range.update(ValueExtent{-0.02, 0.03}, any), small) << "it doesn't stay flat";
}

TEST(AxisRange, AnglesBeginNearTheirLowestValue) {
  RollingRange range;
  const AxisRangeOptions angles{.fromZero = false};
  const AxisRange first = range.update(ValueExtent{-31.0, 42.0}, angles);
  EXPECT_LE(first.from, -31.0);
  EXPECT_GE(first.from, -60.0);
  EXPECT_GE(first.to, 42.0);
  EXPECT_LE(first.to, 80.0);
  EXPECT_EQ(range.update(ValueExtent{-30.0, 41.0}, angles), first);
}

TEST(AxisRange, AConstantHasAnAxisThatHoldsStill) {
  RollingRange range;
  const AxisRangeOptions temperatures{.fromZero = false};
  const AxisRange first = range.update(ValueExtent{41.3, 41.3}, temperatures);
  EXPECT_LT(first.from, 41.3);
  EXPECT_GT(first.to, 41.3);
  EXPECT_LE(first.to - first.from, 4.0);
  EXPECT_EQ(range.update(ValueExtent{41.25, 41.35}, temperatures), first);
}

}  // namespace
}  // namespace palpate::axis_range_test
