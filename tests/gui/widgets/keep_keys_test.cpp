#include "gui/widgets/keep_keys.h"

#include <QAction>
#include <QKeyEvent>
#include <QTest>
#include <QWidget>

#include <gtest/gtest.h>

namespace palpate::gui::keep_keys_test {
namespace {

// Whether the key is left to the shortcuts of the window.
bool isShortcut(QWidget& widget, int key, Qt::KeyboardModifiers modifiers = {}) {
  QKeyEvent event(QEvent::ShortcutOverride, key, modifiers);
  event.ignore();
  QCoreApplication::sendEvent(&widget, &event);
  return !event.isAccepted();
}

TEST(KeepKeys, ItsKeysArentShortcutsOfTheWindow) {
  QWidget widget;
  keepKeys(widget, {Qt::Key_Up, Qt::CTRL | Qt::Key_Down});
  EXPECT_FALSE(isShortcut(widget, Qt::Key_Up));
  EXPECT_FALSE(isShortcut(widget, Qt::Key_Up, Qt::KeypadModifier));
  EXPECT_FALSE(isShortcut(widget, Qt::Key_Down, Qt::ControlModifier));
  EXPECT_TRUE(isShortcut(widget, Qt::Key_Up, Qt::ShiftModifier));
  EXPECT_TRUE(isShortcut(widget, Qt::Key_Down));
}

TEST(KeepKeys, DoesWhatItsKeysAreFor) {
  QWidget widget;
  int copied = 0;
  keepKeys(widget, QKeySequence::Copy, [&] { ++copied; });
  EXPECT_FALSE(isShortcut(widget, Qt::Key_C, Qt::ControlModifier));
  EXPECT_EQ(copied, 0);
  QTest::keyClick(&widget, Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(copied, 1);
  QTest::keyClick(&widget, Qt::Key_C);
  EXPECT_EQ(copied, 1);
}

}  // namespace
}  // namespace palpate::gui::keep_keys_test
