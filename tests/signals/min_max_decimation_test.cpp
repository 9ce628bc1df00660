#include "palpate/signals/min_max_decimation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::min_max_decimation_test {
namespace {

std::vector<double> ramp(std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<double>(i);
  return x;
}

TEST(MinMaxDecimation, KeepsEverySampleWhereColumnsAreNarrow) {
  const auto x = ramp(5);
  const std::vector<double> y = {3, 1, 4, 1, 5};
  const auto points = minMaxDecimated(x, y, {.from = 0, .to = 4, .columns = 100});
  EXPECT_EQ(points, (std::vector<SeriesPoint>{{0, 3}, {1, 1}, {2, 4}, {3, 1}, {4, 5}}));
}

TEST(MinMaxDecimation, KeepsFirstSmallestLargestLastOfAColumnInTheirOrder) {
  const auto x = ramp(8);
  const std::vector<double> y = {5, 5, 9, 5, -2, 5, 5, 6};
  const auto points = minMaxDecimated(x, y, {.from = 0, .to = 7, .columns = 1});
  EXPECT_EQ(points, (std::vector<SeriesPoint>{{0, 5}, {2, 9}, {4, -2}, {7, 6}}));
}

TEST(MinMaxDecimation, APeakOfOneSampleSurvivesAnyThinning) {
  const auto x = ramp(100'000);
  std::vector<double> y(x.size(), 0.0);
  y[54'321] = 1000.0;
  for (const std::size_t columns : {1u, 7u, 640u}) {
    const auto points = minMaxDecimated(x, y, {.from = 0, .to = x.back(), .columns = columns});
    EXPECT_LE(points.size(), 4 * columns);
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [](const SeriesPoint& p) {
      return p == SeriesPoint{54'321, 1000};
    })) << columns;
  }
}

// The promise itself: in every column the covered interval of y is that of all its samples.
TEST(MinMaxDecimation, CoversTheSameIntervalInEveryColumn) {
  constexpr std::size_t kColumns = 37;
  const auto x = ramp(5000);
  std::vector<double> y(x.size());
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = std::sin(static_cast<double>(i) * 0.37) * static_cast<double>((i * 7919) % 101);
  const double to = x.back();
  const auto points = minMaxDecimated(x, y, {.from = 0, .to = to, .columns = kColumns});
  const auto columnOf = [&](double at) {
    return std::min(static_cast<std::size_t>(at / to * kColumns), kColumns - 1);
  };
  struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    void add(double v) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  };
  std::vector<Interval> all(kColumns), kept(kColumns);
  for (std::size_t i = 0; i < x.size(); ++i) all[columnOf(x[i])].add(y[i]);
  for (const SeriesPoint& point : points) kept[columnOf(point.x)].add(point.y);
  for (std::size_t c = 0; c < kColumns; ++c) {
    EXPECT_EQ(kept[c].low, all[c].low) << c;
    EXPECT_EQ(kept[c].high, all[c].high) << c;
  }
}

TEST(MinMaxDecimation, AGapBreaksTheLineEvenInsideAColumn) {
  const std::vector<double> x = {0, 1, 100, 101};
  const std::vector<double> y = {1, 2, 3, 4};
  const std::vector<std::size_t> breaks = {1};
  for (const std::size_t columns : {1u, 1000u}) {
    const auto points =
        minMaxDecimated(x, y, {.from = 0, .to = 101, .columns = columns, .breaks = breaks});
    ASSERT_EQ(points.size(), 5u);
    EXPECT_EQ(points[1], (SeriesPoint{1, 2}));
    EXPECT_EQ(points[2].x, 1);
    EXPECT_TRUE(std::isnan(points[2].y));
    EXPECT_EQ(points[3], (SeriesPoint{100, 3}));
  }
}

TEST(MinMaxDecimation, OfAPartItKeepsOneNeighbourOnEitherSide) {
  const auto x = ramp(100);
  const auto points = minMaxDecimated(x, x, {.from = 40.5, .to = 42.5, .columns = 50});
  EXPECT_EQ(points, (std::vector<SeriesPoint>{{40, 40}, {41, 41}, {42, 42}, {43, 43}}));
  // A part between two samples: the line through it.
  const auto between = minMaxDecimated(x, x, {.from = 10.2, .to = 10.4, .columns = 50});
  EXPECT_EQ(between, (std::vector<SeriesPoint>{{10, 10}, {11, 11}}));
}

TEST(MinMaxDecimation, EmptyAndSingleSamples) {
  EXPECT_TRUE(minMaxDecimated({}, {}, {}).empty());
  const std::vector<double> one = {0.5};
  EXPECT_EQ(minMaxDecimated(one, one, {.from = 0.5, .to = 0.5}).size(), 1u);
}

TEST(MinMaxDecimation, RefusesBadOptions) {
  const auto x = ramp(3);
  EXPECT_THROW(minMaxDecimated(x, ramp(2), {}), std::invalid_argument);
  EXPECT_THROW(minMaxDecimated(x, x, {.from = 2, .to = 1}), std::invalid_argument);
  EXPECT_THROW(minMaxDecimated(x, x, {.columns = 0}), std::invalid_argument);
  EXPECT_THROW(minMaxDecimated(x, x, {.from = std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::min_max_decimation_test
