#include "gui/widgets/status_lines.h"

#include <QAction>
#include <QApplication>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "gui/testing/make_active.h"

namespace palpate::gui::status_lines_test {
namespace {

TEST(StatusLinesTest, ALongTextIsReadWholeInTheSamePlace) {
  StatusLines lines(2, "state");
  lines.resize(150, lines.height());
  lines.show();
  const int height = lines.height();
  lines.setText("short");
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.verticalScrollBar()->maximum(), 0);
  EXPECT_EQ(lines.label().toolTip(), "short");
  lines.setText(QString("a long sentence that needs several lines ").repeated(4), "all of it");
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.height(), height);
  EXPECT_GT(lines.verticalScrollBar()->maximum(), 0);
  EXPECT_GE(lines.label().height(), lines.label().heightForWidth(lines.label().width()));
  EXPECT_EQ(lines.label().toolTip(), "all of it");
  lines.verticalScrollBar()->setValue(5);
  lines.setText(QString("another long sentence that needs several lines ").repeated(4));
  EXPECT_EQ(lines.verticalScrollBar()->value(), 0) << "from its begin";
}

// A time that runs on doesn't take the reader back to the begin.
TEST(StatusLinesTest, ATextWhoseNumbersChangeStaysWhereItWasScrolled) {
  StatusLines lines(2, "state");
  lines.resize(150, lines.height());
  lines.show();
  const QString rest = QString(", a long sentence that needs several lines").repeated(4);
  lines.setText("holding for 9 s" + rest);
  QCoreApplication::processEvents();
  lines.verticalScrollBar()->setValue(5);
  lines.setText("holding for 10 s" + rest);
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.verticalScrollBar()->value(), 5);
  lines.setText("closing" + rest);
  EXPECT_EQ(lines.verticalScrollBar()->value(), 0);
}

TEST(StatusLinesTest, TheKeyboardReachesItOnlyWhileThereIsSomethingToScroll) {
  QWidget window;
  StatusLines lines(2, "state", &window);
  lines.resize(150, lines.height());
  // Keys that scroll mean something else in the window.
  QAction slower("Slower");
  slower.setShortcut(Qt::Key_Down);
  window.addAction(&slower);
  const QSignalSpy slowed(&slower, &QAction::triggered);
  window.show();
  makeActive(window);
  lines.setText("short");
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.focusPolicy(), Qt::NoFocus);
  lines.setText(QString("a long sentence that needs several lines ").repeated(4));
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.focusPolicy(), Qt::TabFocus);
  const auto* frame = lines.findChild<QFrame*>("FocusFrame");
  ASSERT_NE(frame, nullptr);
  EXPECT_FALSE(frame->isVisible());
  lines.setFocus(Qt::TabFocusReason);
  EXPECT_TRUE(frame->isVisible());
  EXPECT_EQ(frame->geometry(), lines.rect());
  QTest::keyClick(&lines, Qt::Key_Down);
  EXPECT_GT(lines.verticalScrollBar()->value(), 0);
  QTest::keyClick(&lines, Qt::Key_Up);
  EXPECT_EQ(lines.verticalScrollBar()->value(), 0);
  EXPECT_EQ(slowed.size(), 0);
  lines.setText("short again");
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.focusPolicy(), Qt::NoFocus);
  EXPECT_FALSE(lines.hasFocus());
  EXPECT_FALSE(frame->isVisible());
}

}  // namespace
}  // namespace palpate::gui::status_lines_test
