// The dock Recognise in the real window, of recordings and live on the emulated hand.
#include <QDockWidget>
#include <QPushButton>

#include "gui/answer_view.h"
#include "gui/ask_page.h"
#include "gui/check_page.h"
#include "gui/event_rows.h"
#include "gui/show_window.h"
#include "gui/timeline_chart.h"
#include "gui/timeline_panel.h"
#include "recognise_fixture.h"

namespace palpate::gui::recognise_window_test {
namespace {

TEST_F(RecogniseWindowTest, ComesAndGoesByItsKey) {
  openIt(record("pen"));
  EXPECT_FALSE(dock()->isVisible());
  press(Qt::Key_I, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(dock()->isVisible());
  press(Qt::Key_I, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(dock()->isVisible());
}

TEST_F(RecogniseWindowTest, NamesTheSelectedGrasp) {
  openIt(record("pen"));
  press(Qt::Key_Q);
  EXPECT_TRUE(dock()->isVisible());
  settle();
  panel().desk().useEmulatedModel();
  settle();
  press(Qt::Key_Q);
  settle();
  EXPECT_TRUE(answer().text.startsWith("No grasp is chosen")) << answer().text.toStdString();
  press(Qt::Key_N);  // the first grasp
  ASSERT_TRUE(window().timelinePanel().chart().selection());
  press(Qt::Key_Q);
  settle();
  EXPECT_EQ(answer().name(), "pen") << answer().spoken().toStdString();
  EXPECT_TRUE(answer().of.startsWith("pen.palpate, ")) << answer().of.toStdString();
}

TEST_F(RecogniseWindowTest, AnswersOnTheWholeScreen) {
  openIt(record("pen"));
  press(Qt::Key_Q, Qt::ShiftModifier);
  auto* full = window().findChild<ShowWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  EXPECT_TRUE(full->isFullScreen());
  panel().desk().useEmulatedModel();
  settle();
  press(Qt::Key_N);
  QTest::keyClick(full, Qt::Key_Q);
  settle();
  EXPECT_EQ(full->view().answer().name(), "pen");
  QTest::keyClick(full, Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return window().findChild<ShowWindow*>("showWindow") == nullptr; }, 5'000));
}

TEST_F(RecogniseWindowTest, AGraspOfTheCheckIsOpenedAndSelected) {
  const std::string pen = record("pen"), ball = record("ball");
  openIt(pen);
  emit panel().check().graspAsked(ball, 60, 200);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window().current() && window().current()->path == ball; }, 20'000));
  const auto& selection = window().timelinePanel().chart().selection();
  ASSERT_TRUE(selection);
  EXPECT_NEAR(selection->fromS, window().current()->timeAt(60), 1e-6);
  EXPECT_NEAR(selection->toS, window().current()->timeAt(200), 1e-6);
}

TEST_F(RecogniseWindowTest, NamesWhatTheEmulatedHandHolds) { EXPECT_EQ(heldName("pen"), "pen"); }

}  // namespace
}  // namespace palpate::gui::recognise_window_test
