#include "gui/timeline/event_rows.h"

#include <QApplication>
#include <QLineEdit>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gui/testing/make_active.h"

namespace palpate::gui::event_rows_test {
namespace {

EventMark mark(
    EventLane lane, double fromS, double toS, const QString& text, bool editable = true) {
  EventMark made;
  made.lane = lane;
  made.fromS = fromS;
  made.toS = toS;
  made.text = text;
  made.editable = editable;
  return made;
}

// A pixel is 10 ms: 10 s from 100 to 1100.
class EventRowsTest : public ::testing::Test {
 protected:
  EventRowsTest() {
    rows_.resize(1200, 100);
    rows_.setScale(0.0, 10.0, 100, 1100);
    rows_.setMarks({mark(EventLane::kGrasps, 1.0, 2.0, "1"),
                    mark(EventLane::kGrasps, 4.0, 6.0, "2"),
                    mark(EventLane::kGaps, 7.0, 8.0, "1.0 s", false),
                    mark(EventLane::kLabels, 3.0, 3.0, "touch")});
    rows_.show();
    makeActive(rows_);
  }
  QPoint middleOf(std::size_t index) { return rows_.barOf(index).center().toPoint(); }
  void drag(const QPoint& from, const QPoint& to) {
    QTest::mousePress(&rows_, Qt::LeftButton, {}, from);
    for (const QPoint& at : {(from + to) / 2, to}) {
      QMouseEvent move(QEvent::MouseMove,
                       QPointF(at),
                       rows_.mapToGlobal(QPointF(at)),
                       Qt::NoButton,
                       Qt::LeftButton,
                       Qt::NoModifier);
      QApplication::sendEvent(&rows_, &move);
    }
    QTest::mouseRelease(&rows_, Qt::LeftButton, {}, to);
  }
  EventRows rows_;
  QSignalSpy chosen_{&rows_, &EventRows::markChosen};
  QSignalSpy moved_{&rows_, &EventRows::spanChanged};
};

TEST_F(EventRowsTest, BarsLieWhereTheirTimeIs) {
  EXPECT_NEAR(rows_.barOf(0).left(), 200.0, 0.5);
  EXPECT_NEAR(rows_.barOf(0).right(), 300.0, 0.5);
  EXPECT_GT(rows_.barOf(2).top(), rows_.barOf(0).bottom()) << "a row for each sort";
  EXPECT_GE(rows_.barOf(3).width(), 3.0) << "a moment can be seen and clicked";
  rows_.setScale(2.5, 3.5, 100, 1100);
  EXPECT_TRUE(rows_.barOf(0).isEmpty()) << "out of sight";
}

TEST_F(EventRowsTest, TextsOfOneMomentAreNotPaintedOverEachOther) {
  const auto rightOfTheBar = [&](std::vector<EventMark> marks) {
    rows_.setMarks(std::move(marks));
    const QRectF bar = rows_.barOf(rows_.marks().size() - 1);
    return rows_.grab().toImage().copy(
        QRectF(bar.right() + 2, bar.top(), 300, bar.height()).toRect());
  };
  const EventMark later = mark(EventLane::kLabels, 3.0, 3.0, "stopped");
  const QImage alone = rightOfTheBar({later});
  EXPECT_EQ(rightOfTheBar({mark(EventLane::kLabels, 3.0, 3.0, "motion began"), later}), alone);
  EXPECT_NE(rightOfTheBar({mark(EventLane::kLabels, 3.0, 3.0, "motion began")}), alone);
}

// Two labels of one grasp, and a longer and a shorter one that begin with it.
TEST_F(EventRowsTest, LabelsOfOneSpanLieSideBySideAndEachCanBeClicked) {
  rows_.setMarks({mark(EventLane::kLabels, 1.0, 2.0, "g1"),
                  mark(EventLane::kLabels, 1.0, 2.0, "g2"),
                  mark(EventLane::kLabels, 1.0, 4.0, "long"),
                  mark(EventLane::kLabels, 7.0, 7.0, "a"),
                  mark(EventLane::kLabels, 7.0, 7.0, "b")});
  EXPECT_NEAR(rows_.barOf(0).left(), 200.0, 0.5);
  EXPECT_NEAR(rows_.barOf(1).left(), 250.0, 0.5);
  EXPECT_NEAR(rows_.barOf(1).right(), 300.0, 1.5);
  for (std::size_t i = 0; i < 5; ++i) {
    rows_.choose(std::nullopt);
    const QPoint at = i == 2 ? QPoint(450, middleOf(2).y()) : middleOf(i);
    QTest::mouseClick(&rows_, Qt::LeftButton, {}, at);
    EXPECT_EQ(rows_.chosen(), i);
  }
}

TEST_F(EventRowsTest, OfTwoOfOneSpanTheChosenOneStaysChosen) {
  const EventMark first = mark(EventLane::kLabels, 1.0, 2.0, "g1");
  const EventMark second = mark(EventLane::kLabels, 1.0, 2.0, "g2");
  rows_.setMarks({first, second});
  rows_.choose(0);
  rows_.setMarks({first, second});
  EXPECT_EQ(rows_.chosen(), 0u);
  rows_.setMarks({second});
  EXPECT_FALSE(rows_.chosen()) << "it was removed: Del would remove the other one";
}

// Del would otherwise remove the other one.
TEST_F(EventRowsTest, OfTwoOfOneSpanTheRenamedOneStaysChosen) {
  const EventMark first = mark(EventLane::kLabels, 1.0, 2.0, "g1");
  const EventMark second = mark(EventLane::kLabels, 1.0, 2.0, "g2");
  rows_.setMarks({mark(EventLane::kLabels, 1.0, 2.0, "g2"), second});
  rows_.choose(0);
  rows_.setMarks({first, second});
  EXPECT_EQ(rows_.chosen(), 0u) << "its name was that of the other one";
  rows_.setMarks({mark(EventLane::kLabels, 1.0, 2.0, "pinch"), second});
  EXPECT_EQ(rows_.chosen(), 0u);
  rows_.setMarks({first, second});
  EXPECT_EQ(rows_.chosen(), 0u) << "undone";
}

TEST_F(EventRowsTest, OfTwoOfOneSpanBothAreSeenInAnyPartOfIt) {
  rows_.setMarks(
      {mark(EventLane::kLabels, 1.0, 2.0, "g1"), mark(EventLane::kLabels, 1.0, 2.0, "g2")});
  rows_.setScale(1.5, 2.5, 100, 1100);
  EXPECT_NEAR(rows_.barOf(0).left(), 100.0, 0.5);
  EXPECT_NEAR(rows_.barOf(1).left(), 350.0, 0.5);
  EXPECT_NEAR(rows_.barOf(1).right(), 600.0, 1.5);
  rows_.setScale(0.5, 1.5, 100, 1100);
  EXPECT_NEAR(rows_.barOf(0).left(), 600.0, 0.5);
  EXPECT_NEAR(rows_.barOf(1).right(), 1100.0, 1.5);
  rows_.setScale(2.5, 3.5, 100, 1100);
  EXPECT_TRUE(rows_.barOf(0).isEmpty() && rows_.barOf(1).isEmpty());
}

// The end of the span lies in the bar of the other one.
TEST_F(EventRowsTest, OfTwoOfOneSpanTheEndOfTheChosenOneIsDragged) {
  rows_.setMarks(
      {mark(EventLane::kLabels, 1.0, 2.0, "g1"), mark(EventLane::kLabels, 1.0, 2.0, "g2")});
  rows_.choose(0);
  const QPoint end(298, middleOf(0).y());
  drag(end, end + QPoint(50, 0));
  EXPECT_EQ(rows_.chosen(), 0u);
  ASSERT_EQ(moved_.size(), 1);
  EXPECT_EQ(moved_[0][0].toULongLong(), 0u);
  EXPECT_NEAR(moved_[0][1].toDouble(), 1.0, 1e-9);
  EXPECT_NEAR(moved_[0][2].toDouble(), 2.5, 0.011);
  QTest::mouseClick(&rows_, Qt::LeftButton, {}, middleOf(1));
  EXPECT_EQ(rows_.chosen(), 1u) << "its middle is its own";
}

TEST_F(EventRowsTest, AClickChooses) {
  QTest::mouseClick(&rows_, Qt::LeftButton, {}, middleOf(1));
  EXPECT_EQ(rows_.chosen(), 1u);
  ASSERT_EQ(chosen_.size(), 1);
  EXPECT_EQ(chosen_[0][0].toULongLong(), 1u);
  QTest::mouseClick(&rows_, Qt::LeftButton, {}, QPoint(1000, middleOf(0).y()));
  EXPECT_FALSE(rows_.chosen()) << "beside them";
  EXPECT_EQ(moved_.size(), 0);
}

TEST_F(EventRowsTest, EndsAndBodyAreDragged) {
  rows_.choose(1);
  const QPoint from(500, middleOf(1).y());
  drag(from, from - QPoint(50, 0));
  ASSERT_EQ(moved_.size(), 1);
  EXPECT_NEAR(moved_[0][1].toDouble(), 3.5, 0.011);
  EXPECT_NEAR(moved_[0][2].toDouble(), 6.0, 1e-9) << "the other end stays";
  drag(middleOf(1), middleOf(1) + QPoint(100, 0));
  ASSERT_EQ(moved_.size(), 2);
  EXPECT_NEAR(moved_[1][1].toDouble(), 5.0, 0.011);
  EXPECT_NEAR(moved_[1][2].toDouble(), 7.0, 0.011);
  drag(middleOf(2), middleOf(2) + QPoint(100, 0));
  EXPECT_EQ(moved_.size(), 2) << "a gap stays where it is";
}

TEST_F(EventRowsTest, ArrowsGoFromOneToTheNextAndFromRowToRow) {
  rows_.setFocus();
  QTest::keyClick(&rows_, Qt::Key_Right);
  EXPECT_EQ(rows_.chosen(), 0u);
  QTest::keyClick(&rows_, Qt::Key_Right);
  QTest::keyClick(&rows_, Qt::Key_Right);
  EXPECT_EQ(rows_.chosen(), 1u) << "the last one of the row";
  QTest::keyClick(&rows_, Qt::Key_Down);
  EXPECT_EQ(rows_.chosen(), 2u);
  QTest::keyClick(&rows_, Qt::Key_Down);
  EXPECT_EQ(rows_.chosen(), 3u);
  QTest::keyClick(&rows_, Qt::Key_Up);
  QTest::keyClick(&rows_, Qt::Key_Up);
  QTest::keyClick(&rows_, Qt::Key_Left);
  EXPECT_EQ(rows_.chosen(), 0u);
}

TEST_F(EventRowsTest, ADoubleClickNamesEnterTakesEscapeLeaves) {
  QSignalSpy named(&rows_, &EventRows::textChanged);
  QTest::mouseDClick(&rows_, Qt::LeftButton, {}, middleOf(3));
  auto* field = rows_.findChild<QLineEdit*>("eventText");
  ASSERT_TRUE(field && field->isVisible());
  EXPECT_EQ(field->text(), "touch");
  field->setText("first  touch");
  QTest::keyClick(field, Qt::Key_Return);
  ASSERT_EQ(named.size(), 1);
  EXPECT_EQ(named[0][0].toULongLong(), 3u);
  EXPECT_EQ(named[0][1].toString(), "first touch");
  EXPECT_FALSE(field->isVisible());
  rows_.editText(2);
  EXPECT_FALSE(field->isVisible()) << "a gap has no name of a person's";
}

// Marks that are found meanwhile change the numbers of the others.
TEST_F(EventRowsTest, TheTextThatIsTypedIsForTheMarkThatWasClicked) {
  QSignalSpy named(&rows_, &EventRows::textChanged);
  rows_.editText(3);
  auto* field = rows_.findChild<QLineEdit*>("eventText");
  rows_.setMarks(
      {mark(EventLane::kLabels, 2.0, 2.0, "found"), mark(EventLane::kLabels, 3.0, 3.0, "touch")});
  ASSERT_TRUE(field->isVisible());
  field->setText("first touch");
  QTest::keyClick(field, Qt::Key_Return);
  ASSERT_EQ(named.size(), 1);
  EXPECT_EQ(named[0][0].toULongLong(), 1u);
  rows_.editText(1);
  rows_.setMarks({mark(EventLane::kLabels, 2.0, 2.0, "found")});
  EXPECT_FALSE(field->isVisible()) << "it is gone";
}

// The press of a double click has chosen the mark, whose input Return begins.
TEST_F(EventRowsTest, ReturnEndsTheInputOfAChosenMark) {
  QSignalSpy named(&rows_, &EventRows::textChanged);
  QTest::mouseClick(&rows_, Qt::LeftButton, {}, middleOf(3));
  QTest::mouseDClick(&rows_, Qt::LeftButton, {}, middleOf(3));
  ASSERT_EQ(rows_.chosen(), 3u);
  auto* field = rows_.findChild<QLineEdit*>("eventText");
  ASSERT_TRUE(field && field->isVisible());
  field->setText("first touch");
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(named.size(), 1);
  EXPECT_FALSE(field->isVisible());
}

TEST_F(EventRowsTest, DeleteAsksForWhatCanBeDeleted) {
  QSignalSpy removed(&rows_, &EventRows::removeRequested);
  rows_.setFocus();
  rows_.choose(2);
  QTest::keyClick(&rows_, Qt::Key_Delete);
  EXPECT_EQ(removed.size(), 0);
  rows_.choose(0);
  QTest::keyClick(&rows_, Qt::Key_Delete);
  ASSERT_EQ(removed.size(), 1);
}

TEST_F(EventRowsTest, TheChosenOneStaysChosenWhenOthersCome) {
  rows_.choose(1);
  auto marks = rows_.marks();
  marks.insert(marks.begin(), mark(EventLane::kGrasps, 0.1, 0.5, "0"));
  rows_.setMarks(marks);
  EXPECT_EQ(rows_.chosen(), 2u);
  rows_.setMarks({});
  EXPECT_FALSE(rows_.chosen());
  EXPECT_FALSE(rows_.isVisible()) << "no rows, no room";
  rows_.chooseNext(1);
}

}  // namespace
}  // namespace palpate::gui::event_rows_test
