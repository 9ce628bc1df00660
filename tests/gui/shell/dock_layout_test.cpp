#include "gui/shell/dock_layout.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QToolBar>
#include <random>

#include <gtest/gtest.h>

namespace palpate::gui::dock_layout_test {
namespace {

// Docks at all sides: tabs, nested, floating and hidden ones.
class DockLayoutTest : public ::testing::Test {
 protected:
  DockLayoutTest() {
    window_.resize(900, 700);
    window_.setCentralWidget(new QWidget);
    for (int i = 0; i < 8; ++i) {
      docks_.append(new QDockWidget("dock", &window_));
      docks_.back()->setObjectName(QString("dock%1").arg(i));
      docks_.back()->setWidget(new QWidget);
    }
    window_.addDockWidget(Qt::LeftDockWidgetArea, docks_[0]);
    window_.addDockWidget(Qt::RightDockWidgetArea, docks_[1]);
    window_.tabifyDockWidget(docks_[1], docks_[2]);
    window_.splitDockWidget(docks_[1], docks_[3], Qt::Vertical);
    window_.splitDockWidget(docks_[3], docks_[4], Qt::Horizontal);
    window_.addDockWidget(Qt::BottomDockWidgetArea, docks_[5]);
    window_.addDockWidget(Qt::TopDockWidgetArea, docks_[6]);
    window_.addDockWidget(Qt::TopDockWidgetArea, docks_[7]);
    for (const char* name : {"tools", "moreTools"}) {
      window_.addToolBar(name)->setObjectName(name);
      window_.addToolBarBreak();
    }
    docks_[6]->hide();
    docks_[7]->setFloating(true);
    window_.show();
  }

  QMainWindow window_;
  QList<QDockWidget*> docks_;
};

TEST_F(DockLayoutTest, WhatQtWritesPasses) {
  EXPECT_TRUE(isDockLayout(window_.saveState()));
  EXPECT_TRUE(isDockLayout(QMainWindow().saveState()));
}

TEST_F(DockLayoutTest, CutAndLengthenedLayoutsDoNot) {
  const QByteArray layout = window_.saveState();
  for (qsizetype length = 0; length < layout.size(); ++length)
    EXPECT_FALSE(isDockLayout(layout.left(length))) << length;
  EXPECT_FALSE(isDockLayout(layout + '\0'));
  EXPECT_FALSE(isDockLayout(QByteArray(1 << 20, '\xff')));
}

TEST_F(DockLayoutTest, ASideThatDoesNotExistIsRefused) {
  QByteArray layout = window_.saveState();
  // Behind two numbers, a mark, and the number of sides.
  layout[16] = 4;
  EXPECT_FALSE(isDockLayout(layout));
  layout[16] = 3;
  EXPECT_TRUE(isDockLayout(layout));
}

// Run with ASan, this shows that Qt survives what passes.
TEST_F(DockLayoutTest, QtRestoresWhateverPassesAndTheWindowKeepsItsSize) {
  const QByteArray layout = window_.saveState();
  std::mt19937 random(5);
  int passed = 0;
  for (int i = 0; i < 3000; ++i) {
    QByteArray changed = layout;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int c = 0; c < changes; ++c)
      changed[static_cast<qsizetype>(random() % static_cast<std::size_t>(changed.size()))] =
          static_cast<char>(random());
    if (!isDockLayout(changed)) continue;
    if (++passed > 60) break;
    window_.restoreState(changed);
    EXPECT_LE(window_.width(), 2000);
  }
  EXPECT_GT(passed, 10);
}

}  // namespace
}  // namespace palpate::gui::dock_layout_test
