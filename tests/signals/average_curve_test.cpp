#include "palpate/signals/average_curve.h"

#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::average_curve_test {
namespace {

std::shared_ptr<const Series> series(std::vector<double> timeS, std::vector<double> values) {
  return std::make_shared<const Series>(Series{std::move(timeS), std::move(values)});
}

void expectNear(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::isnan(expected[i]))
      EXPECT_TRUE(std::isnan(found[i])) << i << ": " << found[i];
    else
      EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
  }
}

const double kNone = std::nan("");

// Three grasps whose contacts are at 1, 2.5 and 0.5 s of their recordings. From the contact on, at
// 0, 1 and 2 s they have 2, 4, 9 · 4, 8, 0 · 9, 9, 3.
std::vector<AlignedCurve> three() {
  return {{.series = series({0, 1, 2, 3}, {0, 2, 4, 9}), .zeroS = 1.0},
          {.series = series({2.5, 3.5, 4.5}, {4, 8, 0}), .zeroS = 2.5},
          {.series = series({0.5, 1.5, 2.5}, {9, 9, 3}), .zeroS = 0.5}};
}

// Python: statistics.fmean and statistics.stdev of (2, 4, 9), (4, 8, 9), (9, 0, 3).
TEST(AverageCurve, IsTheMeanWithItsStandardDeviation) {
  const AverageCurve found = averageCurve(three());
  EXPECT_EQ(found.stepS, 1.0);
  expectNear(found.timeS, {-1, 0, 1, 2});
  EXPECT_EQ(found.count, (std::vector<std::size_t>{1, 3, 3, 3}));
  expectNear(found.middle, {kNone, 5, 7, 4});
  const std::vector<double> deviation = {3.605551275463989, 2.6457513110645907, 4.58257569495584};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.high[i + 1] - found.middle[i + 1], deviation[i], 1e-9);
    EXPECT_NEAR(found.middle[i + 1] - found.low[i + 1], deviation[i], 1e-9);
  }
  // A single curve has a value, but no band.
  const AverageCurve all = averageCurve(three(), {.least = 1});
  EXPECT_EQ(all.middle[0], 0.0);
  EXPECT_TRUE(std::isnan(all.low[0]));
}

// numpy.percentile([2, 4, 9], 10) = 2 + 0.2 * 2 = 2.4, and 90: 4 + 0.8 * 5 = 8; of the others in
// the same way by hand.
TEST(AverageCurve, IsTheMedianWithPercentiles) {
  const AverageCurve found = averageCurve(three(), {.band = AverageBand::kPercentiles});
  expectNear(found.middle, {kNone, 4, 8, 3});
  expectNear(found.low, {kNone, 2.4, 4.8, 0.6});
  expectNear(found.high, {kNone, 8.0, 8.8, 7.8});
  const AverageCurve whole = averageCurve(
      three(), {.band = AverageBand::kPercentiles, .lowPercent = 0.0, .highPercent = 100.0});
  expectNear(whole.low, {kNone, 2, 4, 0});
  expectNear(whole.high, {kNone, 9, 9, 9});
}

TEST(AverageCurve, ResamplesLinearlyOnMultiplesOfTheStep) {
  const std::vector<AlignedCurve> curves = {
      {.series = series({0, 1, 2}, {0, 10, 30}), .zeroS = 0.75},
      {.series = series({0, 1, 2}, {0, 0, 4}), .zeroS = 0.25}};
  const AverageCurve found = averageCurve(curves, {.stepS = 0.5});
  // From -0.75 to 1.75: the multiples of the step within. The first has (0.25 + ..) 2.5, 7.5, 15,
  // 25 until 1.25; the second begins at -0.25 and has 0, 0, 1, 3.
  expectNear(found.timeS, {-0.5, 0.0, 0.5, 1.0, 1.5});
  EXPECT_EQ(found.count, (std::vector<std::size_t>{1, 2, 2, 2, 1}));
  expectNear(found.middle, {kNone, 3.75, 7.5, 13.0, kNone});
}

TEST(AverageCurve, LeavesOutGapsAndWhatIsOutsideOfTheStretch) {
  std::vector<AlignedCurve> curves = {
      {.series = series({0, 1, 2, 3, 4, 5}, {1, 1, 1, 1, 1, 1}), .fromS = 1.0, .toS = 4.0},
      {.series = series({0, 1, 4, 5}, {3, 3, 3, 3}), .longestS = 2.0}};
  EXPECT_EQ(averageCurve(curves).count, (std::vector<std::size_t>{1, 2, 1, 1, 2, 1}));
  // A value that isn't finite is left out.
  curves[0].series = series({0, 1, 2, 3, 4, 5}, {1, kNone, 1, 1, 1, 1});
  EXPECT_EQ(averageCurve(curves).count, (std::vector<std::size_t>{1, 1, 1, 1, 2, 1}));
  EXPECT_EQ(averageCurve(curves).middle[4], 2.0);
}

TEST(AverageCurve, TimesThatDifferByRoundingOnlyCount) {
  // 0.1 * 3 is not 0.3.
  const std::vector<AlignedCurve> curves = {
      {.series = series({0.0, 0.1, 0.2, 0.3}, {1, 2, 3, 4}), .zeroS = 0.0},
      {.series = series({0.7, 0.8, 0.9, 1.0}, {1, 2, 3, 4}), .zeroS = 0.7}};
  const AverageCurve found = averageCurve(curves, {.stepS = 0.1});
  EXPECT_EQ(found.count, (std::vector<std::size_t>{2, 2, 2, 2}));
  expectNear(found.middle, {1, 2, 3, 4});
}

TEST(AverageCurve, StretchesEndWhereTheNextGraspBegins) {
  const auto whole = series({0, 10}, {0, 10});
  const std::vector<TimeSpan> grasps = {{1.0, 2.0}, {2.3, 4.0}, {8.0, 9.0}};
  const auto found = alignedStretches(whole, grasps, 0.5, 3.0);
  ASSERT_EQ(found.size(), 3u);
  const std::vector<std::vector<double>> expected = {
      {1.0, 0.5, 2.3}, {2.3, 2.0, 4.5}, {8.0, 7.5, 9.5}};
  for (std::size_t i = 0; i < 3; ++i) {
    expectNear({found[i].zeroS, found[i].fromS, found[i].toS}, expected[i]);
    EXPECT_EQ(found[i].series, whole);
    EXPECT_EQ(found[i].longestS, 3.0);
  }
}

TEST(AverageCurve, OfNothingIsEmpty) {
  EXPECT_TRUE(averageCurve({}).timeS.empty());
  const std::vector<AlignedCurve> none = {{.series = series({}, {})},
                                          {.series = series({1.0}, {2.0}), .fromS = 5.0}};
  EXPECT_TRUE(averageCurve(none).timeS.empty());
  const std::vector<AlignedCurve> single = {{.series = series({1.0}, {2.0}), .zeroS = 1.0}};
  expectNear(averageCurve(single, {.least = 1}).middle, {2.0});
}

TEST(AverageCurve, RefusesBadOptions) {
  EXPECT_THROW(averageCurve(three(), {.lowPercent = 90, .highPercent = 10}), std::invalid_argument);
  EXPECT_THROW(averageCurve(three(), {.stepS = -1}), std::invalid_argument);
  EXPECT_THROW(averageCurve(three(), {.stepS = kNone}), std::invalid_argument);
  EXPECT_THROW(averageCurve(three(), {.least = 0}), std::invalid_argument);
  EXPECT_THROW(averageCurve(std::vector<AlignedCurve>(1)), std::invalid_argument);
  EXPECT_THROW(averageCurve(three(), {}, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace palpate::average_curve_test
