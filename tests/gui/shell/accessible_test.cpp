// What a screen reader finds in the window: a name for whatever takes the focus, values where
// numbers are painted, and alerts.
#include <QAccessible>
#include <QDockWidget>
#include <QStringList>

#include "gui/testing/window_fixture.h"

namespace palpate::gui::accessible_test {
namespace {

QStringList alerts;
void hear(QAccessibleEvent* event) {
  if (event->type() == QAccessible::Alert)
    if (const QAccessibleInterface* from = event->accessibleInterface())
      alerts << from->text(QAccessible::Name);
}

class AccessibleTest : public WindowTest {
 protected:
  AccessibleTest() {
    QAccessible::setActive(true);
    QAccessible::installUpdateHandler(hear);
    alerts.clear();
  }
  ~AccessibleTest() override {
    QAccessible::installUpdateHandler(nullptr);
    QAccessible::setActive(false);
  }
  QString description(const char* name) {
    const QAccessibleInterface* found = QAccessible::queryAccessibleInterface(find<QWidget>(name));
    return found ? found->text(QAccessible::Description) : QString();
  }
  // Adds what can have the focus and has no name, below `at`.
  void nameless(QAccessibleInterface* at, QStringList& found) {
    const auto* widget = qobject_cast<QWidget*>(at->object());
    const bool isTable = at->tableInterface() != nullptr;
    if (widget && widget->isVisible() && widget->focusPolicy() != Qt::NoFocus &&
        at->text(QAccessible::Name).isEmpty() && at->text(QAccessible::Value).isEmpty())
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
    EXPECT_EQ(found, QStringList()) << dock->objectName().toStdString();
  }
  QStringList found;
  nameless(QAccessible::queryAccessibleInterface(&window()), found);
  EXPECT_EQ(found, QStringList());
}

TEST_F(AccessibleTest, PaintedNumbersAreTold) {
  open({"rich.dsa"});
  EXPECT_TRUE(description("statusStrip").contains("frame 0 of"))
      << description("statusStrip").toStdString();
  EXPECT_TRUE(description("recordingFacts").contains("frames: "))
      << description("recordingFacts").toStdString();
  const QString before = description("angleFacts");
  EXPECT_TRUE(before.contains("°")) << before.toStdString();
  press(Qt::Key_End);
  EXPECT_NE(description("angleFacts"), before);
}

TEST_F(AccessibleTest, MessagesAreAlerts) {
  window().state().messages.fail("the disk is full");
  ASSERT_EQ(alerts.size(), 1);
  EXPECT_TRUE(alerts.front().contains("the disk is full"));
}

}  // namespace
}  // namespace palpate::gui::accessible_test
