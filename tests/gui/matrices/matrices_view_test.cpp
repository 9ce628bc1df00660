#include "gui/matrices/matrices_view.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPaintEvent>
#include <QSet>
#include <QSignalSpy>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"

#include "gui/testing/sample_profiles.h"

namespace palpate::gui::matrices_view_test {
namespace {

class MatricesViewTest : public ::testing::Test {
 protected:
  MatricesViewTest() {
    view_.resize(700, 600);
    view_.setLook({.range = {0.0, 255.0}});
    view_.setHand(sdh2());
    frame_.matrix(1)(7, 2) = 200.0F;
    frame_.matrix(5)(3, 4) = 3600.0F;
    view_.setFrame(frame_);
    view_.show();
    QCoreApplication::processEvents();
  }
  void hover(std::size_t matrix, int y, int x) {
    if (view_.geometryOfMatrices().numMatrices() <= matrix) return;
    const QPointF at = view_.geometryOfMatrices().taxelRect(matrix, y, x).center();
    QMouseEvent event(
        QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&view_, &event);
  }
  QColor middle(std::size_t matrix, int y, int x) {
    const QImage image = view_.grab().toImage();
    const QPointF at = view_.geometryOfMatrices().taxelRect(matrix, y, x).center();
    return image.pixelColor((at * image.devicePixelRatio()).toPoint());
  }

  MatricesView view_;
  TactileFrame frame_ = emptyFrame();
};

TEST_F(MatricesViewTest, ShowsTheFrame) {
  EXPECT_EQ(middle(1, 7, 2), QColor::fromRgb(colorTable(ColorMapName::kInferno)[200]));
  EXPECT_EQ(middle(1, 7, 3), colorsOf(Theme::kDark).taxel);
}

TEST_F(MatricesViewTest, ShowsTheNextFrameAndForgetsTheLast) {
  TactileFrame next = emptyFrame();
  next.matrix(1)(8, 3) = 90.0F;
  view_.setFrame(next);
  EXPECT_EQ(middle(1, 8, 3), QColor::fromRgb(colorTable(ColorMapName::kInferno)[90]));
  EXPECT_EQ(middle(1, 7, 2), colorsOf(Theme::kDark).taxel);
}

TEST_F(MatricesViewTest, AMatrixThatSlipsIsMarkedInItsNameAndNoTaxelIsCovered) {
  const QImage before = view_.grab().toImage();
  view_.setSlipping({1});
  const QImage after = view_.grab().toImage();
  const MatricesGeometry& places = view_.geometryOfMatrices();
  const double ratio = after.devicePixelRatio();
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 6; ++x) {
      const QPoint at = (places.taxelRect(1, y, x).center() * ratio).toPoint();
      EXPECT_EQ(after.pixel(at), before.pixel(at)) << y << ", " << x;
    }
  const QPoint name =
      (QPointF(places.nameRect(1).left() + 2.0, places.nameRect(1).center().y()) * ratio).toPoint();
  EXPECT_EQ(after.pixelColor(name), colorsOf(Theme::kDark).danger);
}

// A view whose window can be moved to a screen with more pixels.
class OnAnotherScreen : public MatricesView {
 public:
  double ratio = 1.0;

 protected:
  int metric(PaintDeviceMetric which) const override {
    if (which == PdmDevicePixelRatio) return static_cast<int>(ratio);
    if (which == PdmDevicePixelRatioScaled)
      return static_cast<int>(ratio * devicePixelRatioFScale());
    return MatricesView::metric(which);
  }
};

TEST_F(MatricesViewTest, IsSharpOnAScreenWithMorePixels) {
  OnAnotherScreen moved, there;
  there.ratio = 2.0;
  for (OnAnotherScreen* view : {&moved, &there}) {
    view->resize(700, 600);
    view->setLook({.range = {0.0, 255.0}});
    view->setHand(sdh2());
    view->setFrame(frame_);
  }
  moved.grab();
  moved.ratio = 2.0;
  ASSERT_EQ(moved.devicePixelRatioF(), 2.0);
  EXPECT_EQ(moved.grab().toImage(), there.grab().toImage());
}

// Counts the pixels that paint events cover, and the events.
class PaintedArea : public QObject {
 public:
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() != QEvent::Paint) return false;
    region += static_cast<QPaintEvent*>(event)->region();
    ++times;
    return false;
  }
  QRegion region;
  int times = 0;
};

TEST_F(MatricesViewTest, IsPaintedOnceOnAScreenWithMorePixels) {
  OnAnotherScreen view;
  view.ratio = 2.0;
  view.resize(700, 600);
  view.setHand(sdh2());
  view.show();
  for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
  PaintedArea painted;
  view.installEventFilter(&painted);
  view.setLook({.range = {0.0, 100.0}});
  for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
  EXPECT_EQ(painted.times, 1);
}

TEST_F(MatricesViewTest, RepaintsOnlyMatricesThatChanged) {
  QCoreApplication::processEvents();
  PaintedArea painted;
  view_.installEventFilter(&painted);
  view_.setFrame(frame_);
  QCoreApplication::processEvents();
  EXPECT_TRUE(painted.region.isEmpty()) << "the same frame again costs nothing";
  frame_.matrix(5)(3, 4) = 100.0F;
  view_.setFrame(frame_);
  QCoreApplication::processEvents();
  const auto& geometry = view_.geometryOfMatrices();
  EXPECT_TRUE(painted.region.intersects(geometry.matrixRect(5).toRect()));
  EXPECT_FALSE(painted.region.intersects(geometry.matrixRect(1).toRect()));
}

TEST_F(MatricesViewTest, HoverTellsMatrixPlaceAndValue) {
  QSignalSpy hovered(&view_, &MatricesView::hovered);
  hover(1, 7, 2);
  EXPECT_EQ(view_.hoverText(), "finger 0 distal · x 2, y 7 · 200 counts");
  ASSERT_EQ(hovered.size(), 1);
  EXPECT_EQ(hovered[0][0].toString(), view_.hoverText());
  hover(1, 7, 3);
  EXPECT_EQ(view_.hoverText(), "finger 0 distal · x 3, y 7 · 0 counts, at rest");
  hover(5, 3, 4);
  EXPECT_EQ(view_.hoverText(), "finger 2 distal · x 4, y 3 · 3600 counts, saturated");
  hover(1, 0, 0);
  EXPECT_EQ(view_.hoverText(), "") << "no taxel in this corner";
}

TEST_F(MatricesViewTest, HoverFollowsThePlaybackAndEndsWithTheMouse) {
  hover(1, 7, 2);
  QSignalSpy hovered(&view_, &MatricesView::hovered);
  frame_.matrix(1)(7, 2) = 12.5F;
  view_.setFrame(frame_);
  EXPECT_EQ(view_.hoverText(), "finger 0 distal · x 2, y 7 · 12.50 counts");
  EXPECT_EQ(hovered.size(), 1);
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(&view_, &leave);
  EXPECT_EQ(view_.hoverText(), "");
}

TEST_F(MatricesViewTest, HoverNamesMaskedTaxels) {
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[0].dynamicMask[0] = 0;
  const HandDescription hand = describeHand(SensorLayout(matrices), 0, 0);
  view_.setHand(hand);
  view_.setFrame(TactileFrame(hand.layout));
  hover(0, 0, 0);
  EXPECT_EQ(view_.hoverText(), "finger 0 proximal · x 0, y 0 · masked: not scanned");
}

// The SDH-2 has two columns of three matrices; matrix 0 has 14 rows of 6 taxels.
TEST_F(MatricesViewTest, TaxelsAreChosenByKeyboard) {
  const auto press = [&](int key, Qt::KeyboardModifiers with = Qt::NoModifier) {
    QKeyEvent event(QEvent::KeyPress, key, with);
    QApplication::sendEvent(&view_, &event);
  };
  QKeyEvent space(QEvent::ShortcutOverride, Qt::Key_Space, Qt::NoModifier);
  const auto takesSpace = [&] {
    space.ignore();
    QApplication::sendEvent(&view_, &space);
    return space.isAccepted();
  };
  // The focus alone, which Qt passes on when another control is hidden, takes no key.
  QFocusEvent in(QEvent::FocusIn, Qt::TabFocusReason);
  QApplication::sendEvent(&view_, &in);
  press(Qt::Key_Space);
  EXPECT_FALSE(takesSpace());
  EXPECT_EQ(view_.hoverText(), "");
  EXPECT_TRUE(view_.selection().empty());
  press(Qt::Key_Return);
  EXPECT_TRUE(view_.hoverText().contains("x 0, y 0")) << view_.hoverText().toStdString();
  press(Qt::Key_Right);
  press(Qt::Key_Down);
  EXPECT_TRUE(view_.hoverText().contains("x 1, y 1")) << view_.hoverText().toStdString();
  EXPECT_EQ(view_.accessibleDescription(), view_.hoverText());
  press(Qt::Key_Space);
  EXPECT_EQ(view_.selection().count(), 1u);
  press(Qt::Key_Right, Qt::ShiftModifier);
  press(Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_EQ(view_.selection().count(), 3u);
  press(Qt::Key_Space);
  EXPECT_EQ(view_.selection().count(), 2u) << "the last one is deselected";
  // Every taxel can be reached: to the right through all matrices of the row, and back.
  const QString from = view_.hoverText();
  QSet<QString> seen = {from};
  for (int i = 0; i < 60; ++i)
    press(Qt::Key_Right), seen.insert(view_.hoverText().section(" · ", 0, 0));
  EXPECT_GE(seen.size(), 3) << "more than one matrix";
  const QString end = view_.hoverText();
  press(Qt::Key_Right);
  EXPECT_EQ(view_.hoverText(), end) << "nothing is farther to the right";
  EXPECT_TRUE(takesSpace()) << "it doesn't play";
  QKeyEvent other(QEvent::ShortcutOverride, Qt::Key_M, Qt::NoModifier);
  other.ignore();
  QApplication::sendEvent(&view_, &other);
  EXPECT_FALSE(other.isAccepted());
  press(Qt::Key_Return);
  EXPECT_FALSE(takesSpace());
  EXPECT_EQ(view_.hoverText(), "");
  press(Qt::Key_Return);
  QFocusEvent out(QEvent::FocusOut, Qt::TabFocusReason);
  QApplication::sendEvent(&view_, &out);
  EXPECT_FALSE(takesSpace()) << "whoever leaves plays again";
  EXPECT_EQ(view_.hoverText(), "");
}

TEST_F(MatricesViewTest, WithoutAHandItIsEmpty) {
  view_.clear();
  hover(0, 0, 0);
  EXPECT_EQ(view_.hoverText(), "");
  EXPECT_EQ(view_.grab().toImage().pixelColor(300, 300), colorsOf(Theme::kDark).window);
}

}  // namespace
}  // namespace palpate::gui::matrices_view_test
