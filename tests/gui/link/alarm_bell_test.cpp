#include "gui/link/alarm_bell.h"

#include <QSignalSpy>

#include "testing/testing.h"

namespace palpate::gui::alarm_bell_test {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
const Alarm kNoFrames{AlarmKind::kNoData, "no frame for 2 s"};
const Alarm kDisk{AlarmKind::kLowDisk, "the disk is nearly full"};

class AlarmBellTest : public ::testing::Test {
 protected:
  AlarmBellTest() {
    bell_.ring = [this] { ++rings_; };
  }
  AlarmBell bell_;
  int rings_ = 0;
};

TEST_F(AlarmBellTest, RingsOnceForANewAlarmAndAgainEveryTenSeconds) {
  const QSignalSpy raised(&bell_, &AlarmBell::raised);
  bell_.hear({}, 0);
  EXPECT_EQ(rings_, 0);
  bell_.hear({kNoFrames}, kSecondUs);
  bell_.hear({kNoFrames}, 2 * kSecondUs);
  EXPECT_EQ(rings_, 1);
  EXPECT_EQ(raised.size(), 1);
  bell_.hear({kNoFrames}, 11 * kSecondUs);
  EXPECT_EQ(rings_, 2);
  bell_.hear({kNoFrames, kDisk}, 12 * kSecondUs);
  EXPECT_EQ(rings_, 3) << "another one is new";
  EXPECT_EQ(raised.size(), 2);
}

TEST_F(AlarmBellTest, TellsWhatThereIsAndWhenItIsOver) {
  QSignalSpy changed(&bell_, &AlarmBell::changed);
  bell_.hear({kNoFrames, kDisk}, 0);
  ASSERT_EQ(changed.size(), 1);
  EXPECT_EQ(changed.takeFirst()[0].toStringList(),
            QStringList({"no frame for 2 s", "the disk is nearly full"}));
  bell_.hear({kNoFrames, kDisk}, kSecondUs);
  EXPECT_TRUE(changed.isEmpty());
  bell_.hear({}, 2 * kSecondUs);
  ASSERT_EQ(changed.size(), 1);
  EXPECT_TRUE(changed.takeFirst()[0].toStringList().isEmpty());
  bell_.hear({kNoFrames}, 3 * kSecondUs);
  EXPECT_EQ(rings_, 2) << "it was over in between";
}

TEST_F(AlarmBellTest, MutedItIsSeenOnly) {
  const QSignalSpy raised(&bell_, &AlarmBell::raised);
  bell_.setMuted(true);
  bell_.hear({kNoFrames}, 0);
  bell_.hear({kNoFrames}, 20 * kSecondUs);
  EXPECT_EQ(rings_, 0);
  EXPECT_EQ(raised.size(), 1);
}

}  // namespace
}  // namespace palpate::gui::alarm_bell_test
