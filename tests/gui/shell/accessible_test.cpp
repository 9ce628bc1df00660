// What a screen reader finds in the window: a name for whatever takes the focus, values where
// numbers are painted, and alerts.
#include <QAccessible>
#include <QDockWidget>
#include <QLabel>
#include <QStringList>

#include "gui/testing/window_fixture.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui::accessible_test {
namespace {

class AccessibleTest : public WindowTest {
 protected:
  QString description(const char* name) {
    const QAccessibleInterface* found = QAccessible::queryAccessibleInterface(find<QWidget>(name));
    return found ? found->text(QAccessible::Description) : QString();
  }
  // Adds what can have the focus and has no name, below `at`.
  void nameless(QAccessibleInterface* at, QStringList& found) {
    const auto* widget = qobject_cast<QWidget*>(at->object());
    const bool isTable = at->tableInterface() != nullptr;
    // A label tells its text.
    if (widget && widget->isVisible() && !qobject_cast<const QLabel*>(widget) &&
        widget->focusPolicy() != Qt::NoFocus && at->text(QAccessible::Name).isEmpty() &&
        at->text(QAccessible::Value).isEmpty())
      found << QString(widget->metaObject()->className()) + " " + widget->objectName();
    // The cells of a table tell their own texts.
    for (int i = 0; i < at->childCount() && !isTable; ++i)
      if (QAccessibleInterface* child = at->child(i)) nameless(child, found);
  }
};

TEST_F(AccessibleTest, WhateverTakesTheFocusHasAName) {
  open({"rich.dsa"});
  for (QDockWidget* dock : window().findChildren<QDockWidget*>()) {
    dock->show();
    dock->raise();
    QApplication::processEvents();
    QStringList found;
    nameless(QAccessible::queryAccessibleInterface(dock), found);
    EXPECT_TRUE(found.isEmpty()) << dock->objectName().toStdString() << ": "
                                 << found.join(", ").toStdString();
  }
  QStringList found;
  nameless(QAccessible::queryAccessibleInterface(&window()), found);
  EXPECT_TRUE(found.isEmpty()) << found.join(", ").toStdString();
}

TEST_F(AccessibleTest, PaintedNumbersAreTold) {
  open({"rich.dsa"});
  EXPECT_TRUE(description("statusStrip").contains("frame 0, last 126"))
      << description("statusStrip").toStdString();
  EXPECT_TRUE(description("recordingFacts").contains("frames: "))
      << description("recordingFacts").toStdString();
  const QString before = description("angleFacts");
  EXPECT_TRUE(before.contains("°")) << before.toStdString();
  press(Qt::Key_End);
  EXPECT_NE(description("angleFacts"), before);
}

TEST_F(AccessibleTest, MessagesAreTold) {
  window().state().messages.fail("the disk is full");
  const QAccessibleInterface* banner =
      QAccessible::queryAccessibleInterface(window().findChild<MessageBanner*>());
  EXPECT_TRUE(banner->text(QAccessible::Name).contains("the disk is full"));
}

}  // namespace
}  // namespace palpate::gui::accessible_test
