#include "palpate/model/timing.h"

#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::timing_test {
namespace {

Profile profileAt(const std::vector<std::int64_t>& timesMs) {
  const auto layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  ProfileBuilder builder(layout);
  for (std::int64_t ms : timesMs) builder.addFrame(ms * 1000, std::vector<float>{0.0F});
  return builder.finish({});
}

TEST(Timing, RateComesFromTheMedianInterval) {
  // intervals 32, 32, 31, 64 ms: median (32 + 32) / 2
  const TimingReport report = timingOf(profileAt({0, 32, 64, 95, 159}));
  EXPECT_DOUBLE_EQ(report.rateHz, 1000.0 / 32.0);
  EXPECT_DOUBLE_EQ(report.durationS, 0.159);
  EXPECT_DOUBLE_EQ(report.meanRateHz, 4.0 / 0.159);
  EXPECT_TRUE(report.gaps.empty());
}

TEST(Timing, AGapIsLongerThanASecondAndThanFiveIntervals) {
  // 1000 ms is not longer than 1 s; 1001 ms is.
  const TimingReport report = timingOf(profileAt({0, 30, 60, 90, 1090, 2091}));
  ASSERT_EQ(report.gaps.size(), 1u);
  EXPECT_EQ(report.gaps[0].frame, 4u);
  EXPECT_DOUBLE_EQ(report.gaps[0].seconds, 1.001);
  // One frame every 3 s: 10 s is no gap, 16 s is.
  const TimingReport slow = timingOf(profileAt({0, 3000, 6000, 16000, 19000, 35001}));
  ASSERT_EQ(slow.gaps.size(), 1u);
  EXPECT_EQ(slow.gaps[0].frame, 4u);
}

// 1 kHz, ten frames at once every 10 ms, and a pause of 5 s.
TEST(Timing, OfFramesInBurstsTheRateIsTheMean) {
  std::vector<std::int64_t> stampsUs;
  for (std::int64_t burst = 0; burst < 200; ++burst)
    for (std::int64_t i = 0; i < 10; ++i)
      stampsUs.push_back(10'000 * burst + i + (burst < 100 ? 0 : 5'000'000));
  const TimingReport report = timingOf(stampsUs);
  EXPECT_TRUE(report.inBursts);
  // 1,998 intervals outside of the pause, in twice 990,009 us.
  EXPECT_NEAR(report.rateHz, 1998.0 / 1.980018, 1e-6);
  ASSERT_EQ(report.gaps.size(), 1u);
  EXPECT_FALSE(timingOf(profileAt({0, 32, 64, 95, 159})).inBursts);
}

TEST(Timing, OneFrameHasNoRate) {
  const TimingReport report = timingOf(profileAt({5}));
  EXPECT_EQ(report.rateHz, 0.0);
  EXPECT_EQ(report.meanRateHz, 0.0);
  EXPECT_EQ(report.durationS, 0.0);
}

}  // namespace
}  // namespace palpate::timing_test
