#include "palpate/signals/bucket_series.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "testing/testing.h"

namespace palpate::bucket_series_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(BucketSeries, KeepsTheSmallestAndLargestOfEachBucket) {
  BucketSeries series(3.5, 1.0);
  ASSERT_EQ(series.numBuckets(), 4u);
  series.add(0.1, 5.0);
  series.add(0.9, -2.0);
  EXPECT_EQ(series.numReady(), 0u) << "more may come into the first one";
  EXPECT_THROW((void)series.minimum(0), std::out_of_range);
  series.add(2.0, 7.0);
  EXPECT_EQ(series.numReady(), 2u);
  EXPECT_EQ(series.minimum(0), -2.0F);
  EXPECT_EQ(series.maximum(0), 5.0F);
  EXPECT_TRUE(std::isnan(series.minimum(1)));
  series.add(2.5, kNan);
  series.finish();
  EXPECT_TRUE(series.complete());
  EXPECT_EQ(series.minimum(2), 7.0F);
  EXPECT_TRUE(std::isnan(series.maximum(3)));
}

TEST(BucketSeries, PassesOverWhatLiesOutsideOrGoesBack) {
  BucketSeries series(2.0, 1.0);
  series.add(-0.5, 1.0);
  series.add(5.0, 1.0);
  series.add(1.5, 1.0);
  series.add(0.5, 9.0);
  series.finish();
  EXPECT_TRUE(std::isnan(series.minimum(0)));
  EXPECT_EQ(series.maximum(1), 1.0F);
}

TEST(BucketSeries, RefusesBadSizes) {
  EXPECT_THROW(BucketSeries(-1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(BucketSeries(1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(BucketSeries(1e12, 1e-3), std::invalid_argument);
  EXPECT_THROW(BucketSeries(kNan, 1.0), std::invalid_argument);
  EXPECT_EQ(BucketSeries(0.0, 1.0).numBuckets(), 1u);
}

TEST(BucketSeries, PointsCoverTheExtremesWithTwoPointsPerColumn) {
  BucketSeries series(999.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    series.add(i + 0.2, i);
    series.add(i + 0.7, -i);
  }
  series.finish();
  const auto points = series.points({.from = 0.0, .to = 1000.0, .columns = 10});
  EXPECT_LE(points.size(), 24u);
  double low = 0.0;
  double high = 0.0;
  for (const SeriesPoint& point : points) {
    low = std::min(low, point.y);
    high = std::max(high, point.y);
  }
  EXPECT_EQ(low, -999.0);
  EXPECT_EQ(high, 999.0);
}

TEST(BucketSeries, EmptyBucketsBreakTheLineOnce) {
  BucketSeries series(9.0, 1.0);
  series.add(0.5, 1.0);
  series.add(8.5, 2.0);
  series.finish();
  const auto points = series.points({.from = 0.0, .to = 10.0, .columns = 1000});
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[0], (SeriesPoint{0.5, 1.0}));
  EXPECT_TRUE(std::isnan(points[1].y));
  EXPECT_EQ(points[2], (SeriesPoint{8.5, 2.0}));
  EXPECT_TRUE(std::isnan(points[3].y));
}

TEST(BucketSeries, CanBeLookedAtWhileItGrows) {
  BucketSeries series(100'000.0, 1.0);
  std::jthread writer([&] {
    for (int i = 0; i < 100'000; ++i) series.add(i + 0.5, 3.0);
    series.finish();
  });
  bool complete = false;
  while (!complete) {
    complete = series.complete();
    for (const SeriesPoint& point : series.points({.from = 0.0, .to = 100'000.0, .columns = 100})) {
      if (!std::isnan(point.y)) {
        ASSERT_EQ(point.y, 3.0);
      }
    }
  }
}

}  // namespace
}  // namespace palpate::bucket_series_test
