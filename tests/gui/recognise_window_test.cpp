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

namespace palpate::gui {
namespace {

class RecogniseWindowTest : public WindowTest {
 protected:
  RecogniseWindowTest() {
    // Recordings are read as they are.
    window_.reset();
    WindowSurroundings surroundings;
    surroundings.dataFolder = testing::dataFolder();
    surroundings.settingsPath = settingsFile();
    window_ = std::make_unique<MainWindow>(surroundings);
    window_->resize(1280, 800);
    window_->show();
  }
  QDockWidget* dock() { return window().findChild<QDockWidget*>("Recognise"); }
  RecognisePanel& panel() { return *find<RecognisePanel>("RecognisePanel"); }
  const RecognitionAnswer& answer() { return panel().desk().answer(); }
  void settle() {
    panel().settle();
    QCoreApplication::processEvents();
  }
  std::string record(const std::string& object) {
    const auto path = folder_ / (object + ".palpate");
    saveRecording(graspsOf(object, 2), {}, path);
    return path.string();
  }
  void openIt(const std::string& path) {
    QSignalSpy shown(&window(), &MainWindow::recordingShown);
    window().openFiles({path});
    ASSERT_TRUE(shown.wait(20'000));
  }
  // Grasps a scene by its script, asks while it is held, until it is named.
  QString heldName(const std::string& scene) {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = QString::fromStdString(scene);
    connection.sceneActs = true;
    window().connectTo(connection);
    if (!dock()->isVisible()) window().showDock("Recognise");
    const bool told = QTest::qWaitFor(
        [&] {
          QTest::qWait(250);
          press(Qt::Key_Q);
          settle();
          return answer().sure || answer().kind == RecognitionAnswer::Kind::kUnknown;
        },
        30'000);
    const QString name = told ? answer().name() : "not told: " + answer().spoken();
    window().live().end();
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return window().live().state() == LiveController::State::kNone; }, 20'000));
    return name;
  }
};

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
}  // namespace palpate::gui
