// The confusion matrix by itself: how many names are read, and what mouse and keys do.
#include "gui/recognise/confusion_view.h"

#include <QAccessible>
#include <QApplication>
#include <QHeaderView>
#include <QImage>
#include <QPainter>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <gtest/gtest.h>

namespace palpate::gui::confusion_view_test {
namespace {

ConfusionMatrix matrixOf(int classes) {
  std::vector<std::string> names;
  for (int i = 0; i < classes; ++i) names.push_back("some object " + std::to_string(i));
  ConfusionMatrix matrix(names);
  for (int i = 0; i < classes; ++i)
    for (int k = 0; k < 12; ++k) matrix.add(i, i);
  matrix.add(3, 1);
  matrix.add(2, 0);
  matrix.add(2, 0);
  return matrix;
}

class ConfusionViewTest : public ::testing::Test {
 protected:
  void showClasses(int classes, int width = 430, int height = 340) {
    applyTheme(*qApp, Theme::kDark);
    view_.resize(width, height);
    view_.show();
    view_.setMatrix(matrixOf(classes));
    QCoreApplication::processEvents();
  }
  QPoint middleOf(const ConfusionView::Cell& cell) const {
    return view_.rectOf(cell).center().toPoint();
  }
  ConfusionView view_;
};

TEST_F(ConfusionViewTest, FewObjectsFitAndNothingScrolls) {
  showClasses(5);
  EXPECT_GE(view_.side(), kReadableConfusionSide);
  EXPECT_EQ(view_.horizontalScrollBar()->maximum(), 0);
  EXPECT_EQ(view_.verticalScrollBar()->maximum(), 0);
  EXPECT_FALSE(view_.rectOf({4, 4}).isEmpty());
}

TEST_F(ConfusionViewTest, ManyObjectsKeepNamesThatCanBeRead) {
  showClasses(36);
  EXPECT_EQ(view_.side(), kReadableConfusionSide) << "each row is as high as a small name";
  EXPECT_GT(view_.verticalScrollBar()->maximum(), 0);
  EXPECT_TRUE(view_.rectOf({35, 35}).isEmpty()) << "scrolled away";
  view_.choose(ConfusionView::Cell(35, 35));
  EXPECT_FALSE(view_.rectOf({35, 35}).isEmpty()) << "what is chosen comes into sight";
  EXPECT_GE(view_.rectOf({35, 35}).height(), kReadableConfusionSide - 2.0);
  QTest::keyClick(&view_, Qt::Key_0);
  EXPECT_LT(view_.side(), kReadableConfusionSide);
  EXPECT_EQ(view_.verticalScrollBar()->maximum(), 0) << "0 shows all of it";
  EXPECT_FALSE(view_.rectOf({0, 0}).isEmpty());
  QTest::keyClick(&view_, Qt::Key_Plus);
  const double larger = view_.side();
  QWheelEvent wheel(QPointF(200, 200),
                    view_.viewport()->mapToGlobal(QPointF(200, 200)),
                    {},
                    QPoint(0, 240),
                    Qt::NoButton,
                    Qt::ControlModifier,
                    Qt::NoScrollPhase,
                    false);
  QCoreApplication::sendEvent(view_.viewport(), &wheel);
  EXPECT_GT(view_.side(), larger);
  // Enough room: all of it, with names.
  view_.setSide(std::nullopt);
  view_.resize(1400, 1000);
  QCoreApplication::processEvents();
  EXPECT_GT(view_.side(), kReadableConfusionSide);
  EXPECT_EQ(view_.verticalScrollBar()->maximum(), 0);
}

TEST_F(ConfusionViewTest, MouseAndKeysChooseAndOpen) {
  showClasses(5);
  QSignalSpy chosen(&view_, &ConfusionView::cellChosen),
      clicked(&view_, &ConfusionView::cellClicked), opened(&view_, &ConfusionView::cellOpened);
  QTest::mouseClick(view_.viewport(), Qt::LeftButton, {}, middleOf({3, 1}));
  EXPECT_EQ(view_.chosen(), ConfusionView::Cell(3, 1));
  ASSERT_EQ(clicked.count(), 1);
  EXPECT_EQ(clicked.at(0), (QVariantList{3, 1}));
  QTest::keyClick(&view_, Qt::Key_Right);
  QTest::keyClick(&view_, Qt::Key_Up);
  EXPECT_EQ(view_.chosen(), ConfusionView::Cell(2, 2));
  EXPECT_EQ(chosen.count(), 3);
  EXPECT_EQ(clicked.count(), 1) << "keys only choose,";
  QTest::keyClick(&view_, Qt::Key_Return);
  ASSERT_EQ(opened.count(), 1) << "Return opens";
  EXPECT_EQ(opened.at(0), (QVariantList{2, 2}));
  QTest::mouseClick(view_.viewport(), Qt::LeftButton, {}, middleOf({2, 0}));
  QTest::mouseDClick(view_.viewport(), Qt::LeftButton, {}, middleOf({2, 0}));
  EXPECT_EQ(opened.count(), 2);
  QTest::mouseClick(view_.horizontalHeader()->viewport(), Qt::LeftButton, {}, QPoint(2, 2));
  EXPECT_EQ(view_.chosen(), ConfusionView::Cell(2, 0)) << "names are no cells";
}

TEST_F(ConfusionViewTest, AScreenReaderIsToldEachCell) {
  showClasses(5);
  QAccessibleTableInterface* table =
      QAccessible::queryAccessibleInterface(&view_)->tableInterface();
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(table->cellAt(2, 0)->text(QAccessible::Name), "some object 2 called some object 0: 2");
  EXPECT_EQ(table->rowDescription(2), "some object 2");
}

TEST_F(ConfusionViewTest, TheRowAndColumnUnderThePointerStandOut) {
  showClasses(5);
  const auto colorAt = [&](const ConfusionView::Cell& cell) {
    // Beside its number.
    return view_.viewport()->grab().toImage().pixelColor(
        (view_.rectOf(cell).topLeft() + QPointF(3, 3)).toPoint());
  };
  const QColor row = colorAt({3, 4}), column = colorAt({0, 1}), other = colorAt({0, 4});
  QTest::mouseMove(view_.viewport(), middleOf({3, 1}));
  EXPECT_NE(colorAt({3, 4}), row);
  EXPECT_NE(colorAt({0, 1}), column);
  EXPECT_EQ(colorAt({0, 4}), other);
  QEvent leave(QEvent::Leave);
  QCoreApplication::sendEvent(view_.viewport(), &leave);
  EXPECT_EQ(colorAt({3, 4}), row);
}

TEST_F(ConfusionViewTest, APictureOfManyObjectsHasNumbers) {
  constexpr double kScale = 4.0;
  const ConfusionMatrix matrix = matrixOf(36);
  const QRectF area(0, 0, 480, 480);
  QImage image((area.size() * kScale).toSize(), QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.scale(kScale, kScale);
  const ConfusionGrid grid = confusionGrid(matrix, area, painter.font());
  ASSERT_LT(grid.side, 13.0);
  paintConfusion(painter, area, matrix, Theme::kLight);
  painter.end();
  const QRectF cell = grid.rectOf({20, 20});
  const QRect pixels =
      QRectF(cell.topLeft() * kScale, cell.size() * kScale).toRect().adjusted(4, 4, -4, -4);
  int written = 0;
  for (int y = pixels.top(); y <= pixels.bottom(); ++y)
    for (int x = pixels.left(); x <= pixels.right(); ++x)
      written += image.pixel(x, y) != image.pixel(pixels.topLeft()) ? 1 : 0;
  EXPECT_GT(written, 20) << "the number 12";
}

TEST_F(ConfusionViewTest, NothingAndUnknownAreShown) {
  view_.show();
  view_.setMatrix(std::nullopt);
  QTest::keyClick(&view_, Qt::Key_Right);
  EXPECT_FALSE(view_.chosen());
  ConfusionMatrix matrix = matrixOf(4);
  matrix.add(1, ConfusionMatrix::kUnknown);
  view_.resize(430, 340);
  view_.setMatrix(matrix);
  QCoreApplication::processEvents();
  const ConfusionView::Cell cell(1, ConfusionMatrix::kUnknown);
  QTest::mouseClick(view_.viewport(), Qt::LeftButton, {}, middleOf(cell));
  EXPECT_EQ(view_.chosen(), cell);
}

}  // namespace
}  // namespace palpate::gui::confusion_view_test
