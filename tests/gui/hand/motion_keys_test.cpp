#include "gui/hand/motion_keys.h"

#include <QApplication>
#include <QDialog>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace palpate::gui::motion_keys_test {
namespace {

class MotionKeysTest : public ::testing::Test {
 protected:
  MotionKeysTest() {
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
  MotionKeys keys_{{&open_}, &window_};
  QSignalSpy refused_{&keys_, &MotionKeys::refused};
};

TEST_F(MotionKeysTest, AKeyThatCannotBeTakenSaysWhyOnce) {
  open_.setEnabled(false);
  press(Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  ASSERT_EQ(refused_.size(), 1);
  EXPECT_EQ(refused_[0][0].toString(), "Can't open the hand: The hand moves: stop it first (Esc)");
  EXPECT_EQ(field_.text(), "");
}

TEST_F(MotionKeysTest, OtherKeysAndOtherWindowsAreLeftAlone) {
  open_.setEnabled(false);
  press(Qt::Key_O, Qt::NoModifier);
  EXPECT_EQ(field_.text(), "o");
  QLineEdit elsewhere;
  elsewhere.show();
  QTest::keyClick(&elsewhere, Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_EQ(refused_.size(), 0);
}

// A dock that was dragged out of the window.
TEST_F(MotionKeysTest, AWindowThatFloatsSaysTheSame) {
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

TEST_F(MotionKeysTest, AWindowThatFloatsMovesTheHandLikeTheMainWindow) {
  QWidget floating(&window_, Qt::Tool);
  QLineEdit field(&floating);
  floating.show();
  QApplication::setActiveWindow(&floating);
  const QSignalSpy opened(&open_, &QAction::triggered);
  QTest::keyClick(&field, Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_EQ(opened.size(), 1);
  EXPECT_EQ(refused_.size(), 0);
}

TEST_F(MotionKeysTest, AnEnabledActionIsLeftToQt) {
  press(Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_EQ(refused_.size(), 0);
}

}  // namespace
}  // namespace palpate::gui::motion_keys_test
