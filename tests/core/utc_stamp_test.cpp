#include "palpate/core/utc_stamp.h"

#include "testing/testing.h"

namespace palpate::utc_stamp_test {
namespace {

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
}  // namespace palpate::utc_stamp_test
