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

// Both ports were lost in a motion, and the alarms named only the tactile one.
TEST_F(AlarmNotifierTest, AHandThatMovesAndCannotBeStoppedComesFirst) {
  const QString moving =
      "the hand is still moving, and the window can't stop it: use the emergency stop, or switch "
      "its power off; ";
  GraspStatus status;
  EXPECT_EQ(handAlarm(status, 0), "");
  status.cannotMove = "unplugged";
  status.portGone.emplace();
  status.portGone->text = "the motion port is gone";
  status.portGone->endUs = 5 * kSecondUs;
  EXPECT_EQ(handAlarm(status, 5 * kSecondUs), "") << "nothing moved";
  status.portGone->remainingMotionS = 2.5;
  const QString text = moving + "the motion port is gone";
  EXPECT_EQ(handAlarm(status, 5 * kSecondUs), text);
  EXPECT_EQ(handAlarm(status, 7'499'999), text) << "the same words: it doesn't sound each second";
  EXPECT_EQ(handAlarm(status, 7'500'000), "") << "its motion has ended";
  status.unprotected = "stopped: the tactile port is gone";
  EXPECT_EQ(handAlarm(status, 6 * kSecondUs),
            moving + "not protected: stopped: the tactile port is gone");
  EXPECT_EQ(handAlarm(status, 8 * kSecondUs), "not protected: stopped: the tactile port is gone");
  QSignalSpy changed(&bell_, &AlarmNotifier::changed);
  bell_.updateAlarms({kNoFrames}, kSecondUs, text);
  EXPECT_EQ(changed.back()[0].toStringList(), QStringList({text, "no frame for 2 s"}));
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
