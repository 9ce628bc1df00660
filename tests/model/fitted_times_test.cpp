#include "palpate/model/fitted_times.h"

#include <memory>

#include <gtest/gtest.h>

#include "palpate/model/profile_builder.h"

namespace palpate::fitted_times_test {
namespace {

constexpr std::int64_t kBeginUs = 1'700'000'000'000'000;
constexpr std::int64_t kPeriodUs = 10'000;
constexpr int kFrames = 3000;

// Five items arrive together, 1 us apart.
std::int64_t arrivalUs(int i) { return kBeginUs + kPeriodUs * (i / 5 * 5 + 4) + i % 5; }

Profile recorded(bool withDevice) {
  const auto layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  ProfileBuilder builder(layout);
  const std::size_t cell = builder.addSeries({"cell", "", {{"fz", "N"}}, ""});
  const std::size_t imu = builder.addSeries({"imu", "", {{"ax", "m/s^2"}}, ""});
  for (int i = 0; i < kFrames; ++i) {
    const auto device = [&](std::int64_t us) {
      return withDevice ? std::optional(us) : std::nullopt;
    };
    builder.addFrame(arrivalUs(i), std::vector{static_cast<float>(i)}, device(kPeriodUs * i));
    // Its clock is an hour ahead.
    builder.addSample(
        cell, arrivalUs(i), std::vector{0.5 * i}, device(3'600'000'000 + kPeriodUs * i));
    builder.addSample(imu, arrivalUs(i), std::vector{1.0});
  }
  return builder.finish({});
}

TEST(FittedTimes, FramesAndSeriesHaveTheIntervalsOfTheirSenders) {
  const Profile profile = recorded(true);
  const FittedTimes fitted = fittedTimes(profile);
  ASSERT_EQ(fitted.clocks.size(), 2u);
  EXPECT_EQ(fitted.clocks[0].name, "frames");
  EXPECT_EQ(fitted.clocks[1].name, "cell");
  const std::size_t cell = kHandSeries, imu = kHandSeries + 1;
  for (std::size_t i = 0; i < kFrames; ++i) {
    // The last item of five is the fastest one.
    const auto expected = kBeginUs + kPeriodUs * static_cast<std::int64_t>(i) + 4;
    ASSERT_EQ(fitted.profile.frameTimeUs(i), expected);
    ASSERT_EQ(fitted.profile.sampleTimeUs(cell, i), expected);
    ASSERT_EQ(fitted.profile.sampleTimeUs(imu, i), profile.sampleTimeUs(imu, i));
  }
  const TactileFrame frame = fitted.profile.frame(7);
  EXPECT_EQ(frame.hostUs, kBeginUs + 7 * kPeriodUs + 4);
  EXPECT_EQ(frame.values, profile.frame(7).values);
  EXPECT_EQ(frame.deviceUs, 7 * kPeriodUs);
  EXPECT_EQ(fitted.profile.sample(cell, 7).values, profile.sample(cell, 7).values);
  EXPECT_EQ(fitted.profile.sample(cell, 7).hostUs, kBeginUs + 7 * kPeriodUs + 4);
  EXPECT_EQ(fitted.profile.frameAt(kBeginUs + 7 * kPeriodUs + 5), 7u);
  EXPECT_EQ(fitted.profile.series(), profile.series());
}

TEST(FittedTimes, WithoutTimesOfTheSenderTheTimesOfArrivalStay) {
  const Profile profile = recorded(false);
  const FittedTimes fitted = fittedTimes(profile);
  ASSERT_EQ(fitted.clocks.size(), 1u);
  EXPECT_FALSE(fitted.clocks[0].base);
  EXPECT_TRUE(fitted.clocks[0].isWithoutTimes);
  EXPECT_EQ(fitted.clocks[0].text(),
            "frames: no times of the sender's clock; the times of arrival are used");
  for (std::size_t i = 0; i < kFrames; ++i)
    ASSERT_EQ(fitted.profile.frameTimeUs(i), profile.frameTimeUs(i));
}

TEST(FittedTimes, ClocksAreToldInOneLineEach) {
  const auto clocks = clocksOf(recorded(true));
  ASSERT_EQ(clocks.size(), 2u);
  EXPECT_EQ(
      clocks[1].text(),
      "cell: drift 0.0 ppm, delays vary by 40.0 ms, 0 restarts, error 0.00 ms (at most 0.00)");
}

TEST(FittedTimes, TheTimesOfFramesCanBeGiven) {
  const Profile profile = recorded(true);
  std::vector<std::optional<std::int64_t>> deviceUs;
  for (std::size_t i = 0; i < kFrames; ++i) deviceUs.push_back(profile.frame(i).deviceUs);
  const auto given = clocksOf(profile, deviceUs), read = clocksOf(profile);
  ASSERT_EQ(given.size(), 2u);
  EXPECT_EQ(given[0].text(), read[0].text());
  EXPECT_TRUE(
      clocksOf(profile, std::span<const std::optional<std::int64_t>>()).front().isWithoutTimes);
}

TEST(FittedTimes, CanBeCancelled) {
  EXPECT_THROW(fittedTimes(recorded(true), [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace palpate::fitted_times_test
