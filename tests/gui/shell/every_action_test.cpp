// Whatever is pressed, whatever the window shows, it lives and answers, and the hand can be
// stopped: the states without waiting. All of them: every_action_slow_test.
#include "gui/shell/every_action.h"

namespace palpate::gui::every_action_test {
namespace {
using State = PressedWindow::State;

TEST(EveryAction, OfARecordingLivesAndAnswers) {
  PressedWindow pressed;
  std::vector<Answered> slow;
  ASSERT_TRUE(pressed.bring(State::kRecording));
  EXPECT_GT(pressEverything(pressed, State::kRecording, pressed.pressables(), slow), 40u);
  judgeSlow(slow);
}

TEST(EveryAction, OfAHandThatMovesLeavesItStoppable) {
  PressedWindow pressed;
  std::vector<Answered> slow;
  ASSERT_TRUE(pressed.bring(State::kMoving));
  const auto* dock = pressed.window().findChild<QWidget*>("Hand");
  ASSERT_NE(dock, nullptr);
  EXPECT_GT(pressEverything(pressed, State::kMoving, PressedWindow::buttonsIn(*dock), slow), 5u);
  pressed.expectThatStopsWork("all buttons of the dock Hand");
  judgeSlow(slow);
}

}  // namespace
}  // namespace palpate::gui::every_action_test
