#include "gui/record/recording_countdown.h"

#include <QSignalSpy>

#include <gtest/gtest.h>

namespace palpate::gui::recording_countdown_test {
namespace {

TEST(RecordingCountdown, BeginsAfterItsSeconds) {
  RecordingCountdown countdown;
  int begun = 0;
  QSignalSpy changed(&countdown, &RecordingCountdown::changed);
  countdown.start(2, [&] {
    EXPECT_FALSE(countdown.running());
    ++begun;
  });
  EXPECT_EQ(countdown.leftS(), 2);
  countdown.tick();
  EXPECT_EQ(countdown.leftS(), 1);
  EXPECT_EQ(begun, 0);
  countdown.tick();
  EXPECT_EQ(begun, 1);
  EXPECT_FALSE(countdown.running());
  EXPECT_EQ(changed.size(), 3);
  countdown.tick();
  EXPECT_EQ(begun, 1);
}

TEST(RecordingCountdown, CancelledItNeverBegins) {
  RecordingCountdown countdown;
  int begun = 0;
  EXPECT_FALSE(countdown.cancel());
  countdown.start(1, [&] { ++begun; });
  EXPECT_TRUE(countdown.cancel());
  EXPECT_EQ(countdown.leftS(), 0);
  countdown.tick();
  EXPECT_EQ(begun, 0);
}

TEST(RecordingCountdown, AnotherStartReplacesTheFirst) {
  RecordingCountdown countdown;
  QString begun;
  countdown.start(5, [&] { begun += "a"; });
  countdown.start(1, [&] { begun += "b"; });
  countdown.tick();
  EXPECT_EQ(begun, "b");
}

}  // namespace
}  // namespace palpate::gui::recording_countdown_test
