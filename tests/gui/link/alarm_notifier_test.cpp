#include "gui/link/alarm_notifier.h"

#include <QSignalSpy>

#include "testing/testing.h"

namespace palpate::gui::alarm_notifier_test {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
const Alarm kNoFrames{AlarmKind::kNoData, "no frame for 2 s"};
const Alarm kDisk{AlarmKind::kLowDisk, "the disk is nearly full"};

class AlarmNotifierTest : public ::testing::Test {
 protected:
  AlarmNotifierTest() {
    bell_.playSound = [this] { ++rings_; };
  }
  AlarmNotifier bell_;
  int rings_ = 0;
};

TEST_F(AlarmNotifierTest, RingsOnceForANewAlarmAndAgainEveryTenSeconds) {
  const QSignalSpy raised(&bell_, &AlarmNotifier::raised);
  bell_.updateAlarms({}, 0);
  EXPECT_EQ(rings_, 0);
  bell_.updateAlarms({kNoFrames}, kSecondUs);
  bell_.updateAlarms({kNoFrames}, 2 * kSecondUs);
  EXPECT_EQ(rings_, 1);
  EXPECT_EQ(raised.size(), 1);
  bell_.updateAlarms({kNoFrames}, 11 * kSecondUs);
  EXPECT_EQ(rings_, 2);
  bell_.updateAlarms({kNoFrames, kDisk}, 12 * kSecondUs);
  EXPECT_EQ(rings_, 3) << "another one is new";
  EXPECT_EQ(raised.size(), 2);
}

TEST_F(AlarmNotifierTest, TellsWhatThereIsAndWhenItIsOver) {
  QSignalSpy changed(&bell_, &AlarmNotifier::changed);
  bell_.updateAlarms({kNoFrames, kDisk}, 0);
  ASSERT_EQ(changed.size(), 1);
  EXPECT_EQ(changed.takeFirst()[0].toStringList(),
            QStringList({"no frame for 2 s", "the disk is nearly full"}));
  bell_.updateAlarms({kNoFrames, kDisk}, kSecondUs);
  EXPECT_TRUE(changed.isEmpty());
  bell_.updateAlarms({}, 2 * kSecondUs);
  ASSERT_EQ(changed.size(), 1);
  EXPECT_TRUE(changed.takeFirst()[0].toStringList().isEmpty());
  bell_.updateAlarms({kNoFrames}, 3 * kSecondUs);
  EXPECT_EQ(rings_, 2) << "it was over in between";
}

TEST_F(AlarmNotifierTest, AHandThatIsNotProtectedRingsUntilThatIsAcknowledged) {
  QSignalSpy changed(&bell_, &AlarmNotifier::changed);
  bell_.updateAlarms({kDisk}, 0);
  bell_.updateAlarms({kDisk}, kSecondUs, "not protected: no frames");
  EXPECT_EQ(rings_, 2);
  EXPECT_EQ(changed.back()[0].toStringList(),
            QStringList({"not protected: no frames", "the disk is nearly full"}));
  bell_.updateAlarms({}, 2 * kSecondUs, "not protected: no frames");
  EXPECT_EQ(rings_, 2);
  bell_.updateAlarms({}, 11 * kSecondUs, "not protected: no frames");
  EXPECT_EQ(rings_, 3) << "ten seconds after it was heard last";
  bell_.updateAlarms({}, 30 * kSecondUs);
  EXPECT_EQ(rings_, 3);
  EXPECT_TRUE(changed.back()[0].toStringList().isEmpty());
  bell_.updateAlarms({}, 31 * kSecondUs, "not protected: no frames");
  EXPECT_EQ(rings_, 4);
}

TEST_F(AlarmNotifierTest, MutedItIsSeenOnly) {
  const QSignalSpy raised(&bell_, &AlarmNotifier::raised);
  bell_.setMuted(true);
  bell_.updateAlarms({kNoFrames}, 0);
  bell_.updateAlarms({kNoFrames}, 20 * kSecondUs);
  EXPECT_EQ(rings_, 0);
  EXPECT_EQ(raised.size(), 1);
}

}  // namespace
}  // namespace palpate::gui::alarm_notifier_test
