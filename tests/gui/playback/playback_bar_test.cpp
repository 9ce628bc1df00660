#include <QDoubleSpinBox>
#include <QLabel>
#include <QMouseEvent>
#include <QSpinBox>

#include "gui/playback/seek_bar.h"
#include "gui/testing/make_active.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::playback_bar_test {
namespace {

class PlaybackBarTest : public WindowTest {
 protected:
  PlaybackBarTest() { open({"good.dsa"}); }
  SeekBar& bar() { return *find<SeekBar>("seekBar"); }
  QSpinBox& frameField() { return *find<QSpinBox>("frameField"); }
  QDoubleSpinBox& timeField() { return *find<QDoubleSpinBox>("timeField"); }
  // Types a text over what stands in the field, and Enter.
  void type(QAbstractSpinBox& field, const char* text) {
    makeActive(window());
    field.setFocus();
    field.selectAll();
    QTest::keyClick(&field, Qt::Key_Delete);
    QTest::keyClicks(&field, text);
    QTest::keyClick(&field, Qt::Key_Return);
  }
  QPoint at(int frame) {
    return {static_cast<int>(std::lround(bar().pixelOf(frame))), bar().height() / 2};
  }
};

TEST_F(PlaybackBarTest, TellsFrameAndTimeOfHowMany) {
  playback().seekFrame(7);
  EXPECT_EQ(frameField().value(), 7);
  EXPECT_EQ(find<QLabel>("ofFrames")->text(), "last 19");
  EXPECT_EQ(timeField().text(), "0.35");
  EXPECT_EQ(find<QLabel>("ofTime")->text(), "/ 0.95 s");
  EXPECT_EQ(bar().value(), 7);
}

TEST_F(PlaybackBarTest, TheTipTellsTheTimeOfTheFrame) {
  playback().seekSeconds(0.38);
  EXPECT_EQ(timeField().text(), "0.38");
  EXPECT_TRUE(timeField().toolTip().endsWith("Frame 7 itself was recorded at 0.35 s."))
      << timeField().toolTip().toStdString();
  playback().seekFrame(8);
  EXPECT_TRUE(timeField().toolTip().endsWith("Frame 8 itself was recorded at 0.40 s."));
}

TEST_F(PlaybackBarTest, AClickOnTheBarJumpsThereADragScrubs) {
  QTest::mousePress(&bar(), Qt::LeftButton, {}, at(12));
  EXPECT_EQ(playback().frame(), 12u);
  const QPointF to = at(4);
  QMouseEvent move(
      QEvent::MouseMove, to, bar().mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&bar(), &move);
  EXPECT_EQ(playback().frame(), 4u);
  QTest::mouseRelease(&bar(), Qt::LeftButton, {}, at(4));
  QTest::mouseClick(&bar(), Qt::LeftButton, {}, QPoint(0, 10));
  EXPECT_EQ(playback().frame(), 0u);
  QTest::mouseClick(&bar(), Qt::LeftButton, {}, QPoint(bar().width() - 1, 10));
  EXPECT_EQ(playback().frame(), 19u);
}

TEST_F(PlaybackBarTest, EveryFrameHasItsPixelAndBack) {
  for (int frame = 0; frame < 20; ++frame) EXPECT_EQ(bar().frameAt(bar().pixelOf(frame)), frame);
}

TEST_F(PlaybackBarTest, ATypedTimeIsSought) {
  timeField().setFocus();
  timeField().selectAll();
  QTest::keyClicks(&timeField(), "0.51");
  EXPECT_EQ(playback().frame(), 0u) << "not while typing";
  QTest::keyClick(&timeField(), Qt::Key_Return);
  EXPECT_EQ(playback().frame(), 10u);
  EXPECT_FALSE(timeField().hasFocus());
}

// As in every number field: nearest would be a guess.
TEST_F(PlaybackBarTest, ATypedNumberOutOfRangeIsRefused) {
  playback().seekFrame(7);
  for (const char* typed : {"99", "-5"}) {
    type(frameField(), typed);
    EXPECT_EQ(playback().frame(), 7u) << typed;
    EXPECT_EQ(frameField().value(), 7) << typed;
    EXPECT_TRUE(frameField().toolTip().contains("is out of 0 .. 19; 7 stays"))
        << frameField().toolTip().toStdString();
  }
  type(timeField(), "1e6");
  EXPECT_EQ(playback().frame(), 7u);
  EXPECT_EQ(timeField().text(), "0.35");
}

TEST_F(PlaybackBarTest, ADecimalCommaIsAPoint) {
  type(timeField(), "0,51");
  EXPECT_EQ(playback().frame(), 10u);
}

TEST_F(PlaybackBarTest, WhatIsNoNumberChangesNothing) {
  playback().seekFrame(7);
  for (const char* nonsense : {"abc", "1x2", "", "3 4"}) {
    type(frameField(), nonsense);
    EXPECT_EQ(playback().frame(), 7u) << nonsense;
    EXPECT_EQ(frameField().text(), "7") << nonsense;
    type(timeField(), nonsense);
    EXPECT_EQ(playback().frame(), 7u) << nonsense;
  }
}

TEST_F(PlaybackBarTest, EscapeLeavesTheFieldAsItWas) {
  playback().seekFrame(7);
  frameField().setFocus();
  frameField().selectAll();
  QTest::keyClicks(&frameField(), "12");
  QTest::keyClick(&frameField(), Qt::Key_Escape);
  EXPECT_EQ(playback().frame(), 7u);
  EXPECT_EQ(frameField().text(), "7");
  EXPECT_FALSE(frameField().hasFocus());
}

TEST_F(PlaybackBarTest, WhatIsBeingTypedIsNotOverwrittenByThePlayback) {
  makeActive(window());
  playback().play();
  frameField().setFocus();
  frameField().selectAll();
  QTest::keyClicks(&frameField(), "1");
  clock_.advanceMs(300);
  playback().tick();
  EXPECT_EQ(playback().frame(), 6u);
  EXPECT_EQ(frameField().text(), "1");
}

TEST_F(PlaybackBarTest, FollowsThePlayback) {
  playback().play();
  clock_.advanceMs(300);
  playback().tick();
  EXPECT_EQ(bar().value(), 6);
  EXPECT_EQ(frameField().value(), 6);
  EXPECT_EQ(timeField().text(), "0.30");
  EXPECT_EQ(playback().frame(), 6u);
}

}  // namespace
}  // namespace palpate::gui::playback_bar_test
