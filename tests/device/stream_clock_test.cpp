// The clock of a sender: wraps of its counters, restarts, and a wrong unit.
#include "device/stream_clock.h"

#include <gtest/gtest.h>

namespace palpate::testing::stream_clock_test {
namespace {

constexpr std::int64_t kWrapUs = std::int64_t{1} << 32;

TEST(StreamClock, PassesOnWhatTheDeviceSays) {
  StreamClock clock;
  EXPECT_EQ(clock.next(5'000, 100'000), 5'000);
  EXPECT_EQ(clock.next(15'000, 140'000), 15'000);
  EXPECT_EQ(clock.next(15'000, 140'001), 15'000);
  EXPECT_FALSE(clock.restarted());
}

TEST(StreamClock, UnwrapsCountersOf32Bits) {
  for (const std::int64_t wrapUs : {kWrapUs, 1000 * kWrapUs}) {
    StreamClock clock;
    clock.next(wrapUs - 4'000, 0);
    EXPECT_EQ(clock.next(6'000, 10'000), wrapUs + 6'000);
    EXPECT_FALSE(clock.restarted());
    EXPECT_EQ(clock.next(16'000, 20'000), wrapUs + 16'000);
  }
}

TEST(StreamClock, ARestartContinuesByTheTimeThatPassed) {
  StreamClock clock;
  clock.next(50'000'000, 0);
  EXPECT_EQ(clock.next(1'000, 3'000'000), 53'000'000);
  EXPECT_TRUE(clock.restarted());
  EXPECT_EQ(clock.next(11'000, 3'010'000), 53'010'000);
  EXPECT_FALSE(clock.restarted());
}

TEST(StreamClock, AWrongTimeDoesNotStay) {
  StreamClock clock;
  clock.next(1'000'000, 1'000'000);
  EXPECT_EQ(clock.next(900'000'000'000, 1'010'000), 1'010'000);
  EXPECT_TRUE(clock.restarted());
  EXPECT_EQ(clock.next(1'020'000, 1'020'000), 1'020'000);
  EXPECT_TRUE(clock.restarted());
  EXPECT_EQ(clock.next(1'030'000, 1'030'000), 1'030'000);
  EXPECT_FALSE(clock.restarted());
}

TEST(StreamClock, FramesThatWaitedAndCameTogetherKeepTheirTimes) {
  StreamClock clock;
  for (int i = 0; i < 3000; ++i) ASSERT_EQ(clock.next(1000 * i, 5'000'000 + i), 1000 * i);
}

TEST(StreamClock, KnowsHowFastTheDevicesClockRuns) {
  StreamClock clock;
  for (int i = 0; i <= 150; ++i) {
    clock.next(5 * i, 10'000 * i);
    ASSERT_FALSE(clock.speed());
  }
  clock.next(1250, 2'500'000);
  EXPECT_NEAR(clock.speed().value(), 0.0005, 1e-9);
}

TEST(StreamClock, ExtremeTimesDontOverflow) {
  StreamClock clock;
  clock.next(INT64_MIN, 0);
  clock.next(INT64_MAX, 10);
  EXPECT_TRUE(clock.restarted());
  clock.next(INT64_MIN, 20);
  EXPECT_TRUE(clock.restarted());
}

}  // namespace
}  // namespace palpate::testing::stream_clock_test
