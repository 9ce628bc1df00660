#include "gui/desktop/greyed_keys.h"

#include <QApplication>
#include <QDialog>
#include <QHelpEvent>
#include <QLineEdit>
#include <QMenu>
#include <QSignalSpy>
#include <QTest>
#include <QToolTip>

#include <gtest/gtest.h>

#include "gui/testing/make_active.h"

namespace palpate::gui::greyed_keys_test {
namespace {

class GreyedKeysTest : public ::testing::Test {
 protected:
  GreyedKeysTest() {
    open_.setShortcut(QKeySequence("Ctrl+Alt+O"));
    open_.setToolTip("The hand moves: stop it first (Esc)");
    open_.setProperty(kRefusalProperty, "Can't open the hand");
    window_.addAction(&open_);
    window_.show();
    field_.setFocus();
  }
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers) {
    QTest::keyClick(&field_, key, modifiers);
  }

  QWidget window_;
  QLineEdit field_{&window_};
  QAction open_{"&Open the hand"};
  GreyedKeys keys_{{&open_}, [](const QAction& action) { return action.toolTip(); }, &window_};
  QSignalSpy refused_{&keys_, &GreyedKeys::refused};
};

TEST_F(GreyedKeysTest, AKeyThatCannotBeTakenSaysWhyOnce) {
  open_.setEnabled(false);
  press(Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  ASSERT_EQ(refused_.size(), 1);
  EXPECT_EQ(refused_[0][0].toString(), "Can't open the hand: The hand moves: stop it first (Esc)");
  EXPECT_EQ(field_.text(), "");
}

TEST_F(GreyedKeysTest, OtherKeysAndOtherWindowsAreLeftAlone) {
  open_.setEnabled(false);
  press(Qt::Key_O, Qt::NoModifier);
  EXPECT_EQ(field_.text(), "o");
  QLineEdit elsewhere;
  elsewhere.show();
  QTest::keyClick(&elsewhere, Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_EQ(refused_.size(), 0);
}

TEST_F(GreyedKeysTest, AFieldKeepsItsOwnUndo) {
  open_.setShortcut(QKeySequence::Undo);
  open_.setEnabled(false);
  QTest::keyClicks(&field_, "word");
  press(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(field_.text(), "");
  EXPECT_EQ(refused_.size(), 0);
  QTest::keyClick(&window_, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(refused_.size(), 1);
}

// A dock that was dragged out of the window.
TEST_F(GreyedKeysTest, AWindowThatFloatsSaysTheSame) {
  open_.setEnabled(false);
  QWidget floating(&window_, Qt::Tool);
  QLineEdit field(&floating);
  floating.show();
  QTest::keyClick(&field, Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  ASSERT_EQ(refused_.size(), 1);
  EXPECT_EQ(refused_[0][0].toString(), "Can't open the hand: The hand moves: stop it first (Esc)");
  QDialog dialog(&window_);
  QLineEdit other(&dialog);
  dialog.show();
  QTest::keyClick(&other, Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_EQ(refused_.size(), 1) << "a dialogue keeps its keys to itself";
}

TEST_F(GreyedKeysTest, AWindowThatFloatsMovesTheHandLikeTheMainWindow) {
  QWidget floating(&window_, Qt::Tool);
  QLineEdit field(&floating);
  floating.show();
  makeActive(floating);
  const QSignalSpy opened(&open_, &QAction::triggered);
  QTest::keyClick(&field, Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_EQ(opened.size(), 1);
  EXPECT_EQ(refused_.size(), 0);
}

TEST_F(GreyedKeysTest, AnEnabledActionIsLeftToQt) {
  press(Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_EQ(refused_.size(), 0);
}

TEST_F(GreyedKeysTest, WithoutAReasonTheKeyIsLeftAlone) {
  open_.setEnabled(false);
  open_.setShortcut(QKeySequence("O"));
  open_.setToolTip(" ");
  GreyedKeys silent(
      {&open_}, [](const QAction&) { return QString(); }, &window_);
  QSignalSpy refused(&silent, &GreyedKeys::refused);
  press(Qt::Key_O, Qt::NoModifier);
  EXPECT_EQ(refused.size(), 0);
}

TEST_F(GreyedKeysTest, TheEntryOfAMenuSaysWhy) {
  QMenu menu(&window_);
  menu.addAction(&open_);
  menu.popup(window_.pos());
  const QPoint at = menu.actionGeometry(&open_).center();
  const auto tip = [&] {
    QToolTip::hideText();
    QHelpEvent event(QEvent::ToolTip, at, menu.mapToGlobal(at));
    QApplication::sendEvent(&menu, &event);
    return QToolTip::text();
  };
  EXPECT_NE(tip(), "The hand moves: stop it first (Esc)") << "it isn't greyed";
  open_.setEnabled(false);
  EXPECT_EQ(tip(), "The hand moves: stop it first (Esc)");
}

}  // namespace
}  // namespace palpate::gui::greyed_keys_test
