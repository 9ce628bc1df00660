#include "palpate/core/time.h"

#include <cstdlib>
#include <ctime>

#include "testing/testing.h"

namespace palpate::time_test {
namespace {

class FakeClock final : public Clock {
 public:
  std::int64_t monotonicUs() const override { return monotonic; }
  std::int64_t wallUs() const override { return wall; }
  std::int64_t monotonic = 5'000;
  std::int64_t wall = 1'400'000'000'000'000;
};

TEST(HostTime, FollowsTheMonotonicClockWhateverTheWallClockDoes) {
  FakeClock clock;
  const HostTime time(clock);
  EXPECT_EQ(time.nowUs(), 1'400'000'000'000'000);
  clock.monotonic += 250;
  clock.wall -= 3'600'000'000;  // somebody sets the clock back an hour
  EXPECT_EQ(time.nowUs(), 1'400'000'000'000'250);
  EXPECT_EQ(time.wallOffsetUs(), -3'600'000'250);
}

TEST(HostTime, SystemClockGoesForward) {
  const std::int64_t first = systemClock().monotonicUs();
  EXPECT_GE(systemClock().monotonicUs(), first);
  EXPECT_GT(systemClock().wallUs(), 1'700'000'000'000'000);  // after 2023
}

TEST(UtcText, WritesDatesLikePeople) {
  EXPECT_EQ(utcText(0), "1970-01-01 00:00:00.000");
  EXPECT_EQ(utcText(1'417'170'971'302'000), "2014-11-28 10:36:11.302");  // date -u -d @1417170971
  EXPECT_EQ(utcText(-1'000), "1969-12-31 23:59:59.999");
}

// Expected: TZ=UTC-3 date -d @1417084265
TEST(LocalText, IsInTheTimeOfTheMachine) {
  ::setenv("TZ", "UTC-3", 1);  // three hours east
  ::tzset();
  EXPECT_EQ(localText(1'417'084'265'999'999, "%Y-%m-%d %H-%M-%S"), "2014-11-27 13-31-05");
  EXPECT_EQ(localText(-1, "%Y-%m-%d %H:%M:%S"), "1970-01-01 02:59:59");
  ::unsetenv("TZ");
  ::tzset();
}

// C-A13: stamps go on while the machine sleeps.
TEST(HostTime, TheSystemClockCountsTheTimeAsleep) {
  const auto bootUs = [] {
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1000;
  };
  const std::int64_t before = bootUs();
  const std::int64_t now = systemClock().monotonicUs();
  EXPECT_LE(before, now);
  EXPECT_LE(now, bootUs());
}

TEST(FloorMs, RoundsDownBefore1970Too) {
  EXPECT_EQ(floorMs(1'999), 1);
  EXPECT_EQ(floorMs(0), 0);
  EXPECT_EQ(floorMs(-1), -1);
  EXPECT_EQ(floorMs(-1'000), -1);
  EXPECT_EQ(floorMs(-1'001), -2);
}

class StoppedClock final : public Clock {
 public:
  explicit StoppedClock(std::int64_t us) : us_(us) {}
  std::int64_t monotonicUs() const override { return 0; }
  std::int64_t wallUs() const override { return us_; }

 private:
  std::int64_t us_;
};

// Expected: date -u -d @1417170971 +%Y-%m-%dT%H:%M:%SZ
TEST(UtcStamp, IsTheWallClockInWholeSeconds) {
  EXPECT_EQ(utcStamp(StoppedClock(1'417'170'971'999'999)), "2014-11-28T10:36:11Z");
  EXPECT_EQ(utcStamp(StoppedClock(0)), "1970-01-01T00:00:00Z");
}

}  // namespace
}  // namespace palpate::time_test
