#include "palpate/signals/range_statistics.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace palpate::range_statistics_test {
namespace {

const std::vector<double> kTimeS = {0, 0.1, 0.25, 0.3, 0.5, 1.7, 1.8};
const std::vector<double> kValues = {3.0, -1.5, 4.25, 1e3, 1002.5, 7, 0.125};

// The expected values are those of NumPy 1.24: mean(), std(ddof=1), polyfit(t, v, 1)[0], trapz(),
// median(); rms: sqrt(fsum(v * v) / n).
TEST(RangeStatistics, AreThoseOfNumPy) {
  const RangeStatistics found = rangeStatistics(kTimeS, kValues);
  EXPECT_EQ(found.count, 7u);
  EXPECT_NEAR(found.mean, 287.9107142857143, 1e-12);
  EXPECT_NEAR(found.sd, 487.31176234546007, 1e-12);
  EXPECT_EQ(found.minimum, -1.5);
  EXPECT_EQ(found.maximum, 1002.5);
  EXPECT_NEAR(found.slope, -151.8709927611169, 1e-10);
  EXPECT_NEAR(found.integral, 831.6937499999999, 1e-11);
  EXPECT_EQ(found.median, 4.25);
  EXPECT_NEAR(found.rms, 535.2015078620922, 1e-11);
}

TEST(RangeStatistics, TheChangeIsThatBetweenTheFirstAndTheLastNumber) {
  const double none = std::nan("");
  const std::vector<double> values = {none, -1.5, 4.25, none, 1002.5, 7, none};
  std::vector<std::size_t> asked;
  const auto timeSAt = [](std::size_t i) { return kTimeS[i]; };
  const auto change = rangeChange(values.size(), timeSAt, [&](std::size_t i) {
    asked.push_back(i);
    return values[i];
  });
  ASSERT_TRUE(change);
  EXPECT_EQ(change->fromS, 0.1);
  EXPECT_EQ(change->toS, 1.7);
  EXPECT_EQ(change->from, -1.5);
  EXPECT_EQ(change->to, 7.0);
  EXPECT_EQ(change->difference(), 8.5);
  EXPECT_DOUBLE_EQ(change->rate().value(), 8.5 / 1.6);
  EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1, 6, 5})) << "none is read that isn't needed";
  const auto one = rangeChange(2, timeSAt, [&](std::size_t i) { return values[i]; });
  ASSERT_TRUE(one);
  EXPECT_EQ(one->to, -1.5);
  EXPECT_FALSE(one->rate()) << "of one sample";
  EXPECT_FALSE(rangeChange(1, timeSAt, [&](std::size_t i) { return values[i]; }));
  EXPECT_FALSE(rangeChange(0, timeSAt, [&](std::size_t i) { return values[i]; }));
}

TEST(RangeStatistics, LeaveGapsOutOfTheIntegral) {
  EXPECT_NEAR(rangeStatistics(kTimeS, kValues, 1.0).integral, 225.99374999999998, 1e-11);
}

TEST(RangeStatistics, PassOverWhatIsNoNumber) {
  std::vector<double> timeS = kTimeS, values = kValues;
  timeS.insert(timeS.begin() + 3, 0.27);
  values.insert(values.begin() + 3, std::nan(""));
  const RangeStatistics found = rangeStatistics(timeS, values);
  EXPECT_EQ(found.count, 7u);
  EXPECT_NEAR(found.mean, 287.9107142857143, 1e-12);
  EXPECT_NEAR(found.integral, 831.6937499999999, 1e-11);
}

// A large offset costs no digits: the slope of a line is exact to 1e-6 of its noise.
TEST(RangeStatistics, KeepTheirDigitsBesideALargeOffset) {
  std::vector<double> timeS, values;
  for (int i = 0; i < 1000; ++i) {
    timeS.push_back(1e6 + 0.01 * i);
    values.push_back(1e6 + 3.0 * 0.01 * i);
  }
  EXPECT_NEAR(rangeStatistics(timeS, values).slope, 3.0, 1e-6);
}

TEST(RangeStatistics, OfTooFewSamplesAreNotNumbers) {
  const RangeStatistics none = rangeStatistics({}, {});
  EXPECT_EQ(none.count, 0u);
  EXPECT_TRUE(std::isnan(none.mean));
  EXPECT_TRUE(std::isnan(none.integral));
  EXPECT_TRUE(std::isnan(none.median));
  EXPECT_TRUE(std::isnan(none.rms));
  const std::vector<double> one = {2.0};
  const RangeStatistics single = rangeStatistics(one, one);
  EXPECT_EQ(single.mean, 2.0);
  EXPECT_TRUE(std::isnan(single.sd));
  EXPECT_TRUE(std::isnan(single.slope));
  EXPECT_EQ(single.integral, 0.0);
  EXPECT_EQ(single.median, 2.0);
  EXPECT_EQ(single.rms, 2.0);
  const std::vector<double> times = {0, 1, 2, 3}, four = {4, 1, 3, std::nan("")},
                            even = {4, 1, 3, 8};
  EXPECT_EQ(rangeStatistics(times, four).median, 3.0);
  EXPECT_EQ(rangeStatistics(times, even).median, 3.5);
  EXPECT_THROW(rangeStatistics(one, {}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::range_statistics_test
