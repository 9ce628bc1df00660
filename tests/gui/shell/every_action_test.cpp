// Whatever is pressed, whatever the window shows, it lives and answers, and the hand can be
// stopped: the states without waiting. All of them: every_action_slow_test.
#include "gui/shell/every_action.h"

#include "gui/hand/hand_dock.h"

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
  std::size_t numPressed = 0;
  for (const char* page : {"Sensors", "Grasp"}) {
    pressed.window().findChild<HandDock*>()->showPage(page);
    QCoreApplication::processEvents();
    numPressed += pressEverything(pressed, State::kMoving, PressedWindow::buttonsIn(*dock), slow);
  }
  EXPECT_GT(numPressed, 5u);
  pressed.expectThatStopsWork("all buttons of the dock Hand");
  judgeSlow(slow);
}

}  // namespace
}  // namespace palpate::gui::every_action_test
