#include "palpate/signals/resampled_series.h"

#include <cmath>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::resampled_series_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(ResampledSeries, IsLinearBetweenSamplesAndNothingOutside) {
  const Series series{{1.0, 2.0, 4.0}, {10.0, 20.0, 0.0}};
  const auto got = resampled(series, std::vector{0.5, 1.0, 1.25, 2.0, 3.0, 4.0, 4.1});
  const std::vector<double> expected = {kNan, 10.0, 12.5, 20.0, 10.0, 0.0, kNan};
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i)
    if (std::isnan(expected[i]))
      EXPECT_TRUE(std::isnan(got[i])) << i;
    else
      EXPECT_DOUBLE_EQ(got[i], expected[i]) << i;
}

TEST(ResampledSeries, HasNothingInAGap) {
  const Series series{{1.0, 2.0, 4.0}, {10.0, 20.0, 0.0}};
  const auto got = resampled(series, std::vector{1.5, 2.0, 3.0, 4.0}, 1.5);
  EXPECT_EQ(got[0], 15.0);
  EXPECT_EQ(got[1], 20.0);
  EXPECT_TRUE(std::isnan(got[2]));
  EXPECT_EQ(got[3], 0.0);
}

TEST(ResampledSeries, LeavesOutWhatIsNotFinite) {
  const Series series{{1.0, 2.0, 3.0}, {10.0, kNan, 30.0}};
  EXPECT_EQ(resampled(series, std::vector{2.0})[0], 20.0);
  EXPECT_TRUE(std::isnan(resampled({}, std::vector{2.0})[0]));
  EXPECT_THROW(resampled({{1.0}, {}}, std::vector{2.0}), std::invalid_argument);
  EXPECT_THROW(resampled({{1.0, 1.0}, {2.0, 3.0}}, std::vector{2.0}), std::invalid_argument);
}

TEST(HeldAt, IsTheLastSampleAtOrBeforeATime) {
  const Series series{{1.0, 2.0, 4.0}, {10.0, kNan, 0.0}};
  const auto got = heldAt(series, std::vector{0.5, 1.0, 1.9, 2.0, 3.9, 4.0, 99.0});
  EXPECT_TRUE(std::isnan(got[0])) << "before the first sample";
  EXPECT_EQ(got[1], 10.0);
  EXPECT_EQ(got[2], 10.0);
  EXPECT_TRUE(std::isnan(got[3])) << "not known then";
  EXPECT_TRUE(std::isnan(got[4]));
  EXPECT_EQ(got[5], 0.0);
  EXPECT_EQ(got[6], 0.0);
  EXPECT_THROW(heldAt({{1.0, 1.0}, {0.0, 0.0}}, std::vector{1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::resampled_series_test
