// Return, pressed once more, doesn't press the neighbour of a button that moves the hand.
#include "gui/hand/motion_button.h"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include <gtest/gtest.h>

#include "gui/desktop/key_policy.h"

namespace palpate::gui::motion_button_test {
namespace {

class MotionButtonTest : public ::testing::Test {
 protected:
  MotionButtonTest() {
    auto* row = new QHBoxLayout(&window_);
    for (QWidget* each : std::initializer_list<QWidget*>{grasp_, relax_, field_})
      row->addWidget(each);
    QObject::connect(relax_, &QPushButton::clicked, [this] { ++relaxed_; });
    window_.show();
    grasp_->setFocus();
  }
  QWidget window_;
  QPushButton* grasp_ = new QPushButton("Grasp", &window_);
  QPushButton* relax_ = new QPushButton("Relax", &window_);
  QLineEdit* field_ = new QLineEdit(&window_);
  int relaxed_ = 0;
};

TEST_F(MotionButtonTest, ReturnInADialogAndAClickDontGiveItTheFocus) {
  for (const bool moves : {true, false}) {
    const auto* made = motionButton("Move", "moveJoints", "To the targets", moves, &window_);
    EXPECT_FALSE(made->autoDefault());
    EXPECT_EQ(made->focusPolicy(), Qt::TabFocus);
    EXPECT_EQ(made->property(kMovesHand).toBool(), moves);
  }
}

TEST_F(MotionButtonTest, DisabledItGivesTheFocusToNobody) {
  ASSERT_EQ(window_.focusWidget(), grasp_);
  enableMotionButton(*grasp_, false);
  EXPECT_EQ(window_.focusWidget(), nullptr);
  QTest::keyClick(&window_, Qt::Key_Return);
  EXPECT_EQ(relaxed_, 0);
  enableMotionButton(*grasp_, true);
  EXPECT_EQ(window_.focusWidget(), grasp_) << "the motion has ended";
}

// Activated again, a window without a focus gives it to its first button.
TEST_F(MotionButtonTest, WhereThePartAroundItTakesTheFocusItIsKeptThere) {
  window_.setFocusPolicy(Qt::ClickFocus);
  QPushButton first("Show", &window_);
  enableMotionButton(*grasp_, false);
  EXPECT_EQ(window_.focusWidget(), &window_);
  QTest::keyClick(&window_, Qt::Key_Return);
  EXPECT_EQ(relaxed_, 0);
  enableMotionButton(*grasp_, true);
  EXPECT_EQ(window_.focusWidget(), grasp_);
}

TEST_F(MotionButtonTest, AFocusThatWentElsewhereStaysThere) {
  enableMotionButton(*grasp_, false);
  field_->setFocus();
  enableMotionButton(*grasp_, true);
  EXPECT_EQ(window_.focusWidget(), field_);
  enableMotionButton(*grasp_, false);
  EXPECT_EQ(window_.focusWidget(), field_);
  field_->clearFocus();
  enableMotionButton(*grasp_, true);
  EXPECT_EQ(window_.focusWidget(), nullptr) << "it had the focus at no time since";
}

}  // namespace
}  // namespace palpate::gui::motion_button_test
