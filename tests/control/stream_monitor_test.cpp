#include "palpate/control/stream_monitor.h"

#include "testing/testing.h"

namespace palpate::stream_monitor_test {
namespace {

// Adds `frames` frames, one every `periodUs`; returns the time of the last one.
std::int64_t queue(StreamMonitor& watch,
                   int frames,
                   std::int64_t periodUs,
                   std::int64_t fromUs = 0) {
  std::int64_t us = fromUs;
  for (int i = 0; i < frames; ++i) {
    us += periodUs;
    watch.frame(1'000'000'000 + us, us);
  }
  return us;
}

TEST(StreamMonitor, IsDeadAfterAHundredMillisecondsOfSilence) {
  StreamMonitor watch;
  const std::int64_t last = queue(watch, 40, 31'546);  // 31.7 frames/s: three periods are 94.6 ms
  EXPECT_EQ(watch.medianPeriodUs(), 31'546);
  EXPECT_EQ(watch.silenceLimitUs(), 100'000);
  EXPECT_EQ(watch.deadAtUs(), last + 100'000);
  EXPECT_TRUE(watch.alive(last + 100'000));
  EXPECT_FALSE(watch.alive(last + 100'001));
  EXPECT_EQ(watch.silenceUs(last + 70'000), 70'000);
}

TEST(StreamMonitor, GivesASlowStreamThreePeriods) {
  StreamMonitor watch;
  const std::int64_t last = queue(watch, 40, 85'000);  // raw
  EXPECT_EQ(watch.silenceLimitUs(), 255'000);
  EXPECT_TRUE(watch.alive(last + 255'000));
  EXPECT_FALSE(watch.alive(last + 255'001));
}

TEST(StreamMonitor, DoesNotKnowAStreamThatHasHardlyBegun) {
  StreamMonitor watch;
  EXPECT_FALSE(watch.alive(0));
  EXPECT_FALSE(watch.silenceUs(0).has_value());
  const std::int64_t last = queue(watch, 3, 30'000);  // two periods
  EXPECT_FALSE(watch.alive(last));
  queue(watch, 1, 30'000, last);
  EXPECT_TRUE(watch.alive(last + 30'000));
}

TEST(StreamMonitor, OnePauseDoesNotMakeItPatient) {
  StreamMonitor watch;
  std::int64_t last = queue(watch, 20, 31'000);
  last += 900'000;  // a setting was changed
  EXPECT_EQ(watch.frame(1'000'000'000 + last, last), 900'000);
  EXPECT_EQ(watch.silenceLimitUs(), 100'000);
  EXPECT_FALSE(watch.frame(1'000'000'000 + last + 31'000, last + 31'000).has_value());
}

// Frames read all at once after this program was suspended: the time of reading counts.
TEST(StreamMonitor, FindsSilenceByTheStampsOfFrames) {
  StreamMonitor watch;
  const std::int64_t last = queue(watch, 20, 31'000);
  const std::int64_t seen = last + 400'000;
  EXPECT_FALSE(watch.frame(1'000'000'000 + last + 31'000, seen).has_value());
  EXPECT_EQ(watch.frame(1'000'000'000 + last + 331'000, seen), 300'000);
}

TEST(StreamMonitor, FollowsANewRate) {
  StreamMonitor watch;
  const std::int64_t last = queue(watch, 100, 13'000);
  queue(watch, 15, 65'000, last);
  EXPECT_EQ(watch.medianPeriodUs(), 65'000);
  watch.reset();
  EXPECT_FALSE(watch.known());
  EXPECT_EQ(watch.medianPeriodUs(), 0);
}

}  // namespace
}  // namespace palpate::stream_monitor_test
