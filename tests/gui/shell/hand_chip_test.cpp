// The chip of the hand in the window, on an emulated hand.
#include "gui/shell/hand_chip.h"

#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QToolBar>
#include <QToolTip>
#include <utility>

#include <palpate/control/grasp_control.h>

#include "control/emulated_bench.h"
#include "gui/appearance/condition_color.h"
#include "gui/hand/hand_dock.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::hand_chip_test {
namespace {

class HandChipTest : public WindowTest {
 protected:
  HandChipTest() { window().state().appearance.setTheme(ThemeChoice::kDark); }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  void connectHand(const char* scene = "ball") {
    bench_ = std::make_unique<testing::EmulatedBench>(testing::handWith(scene));
    Connection connection;
    connection.kind = Connection::Kind::kPorts;
    connection.dsaPort = QString::fromStdString(bench_->hand->dsaPort());
    connection.sdhPort = QString::fromStdString(bench_->hand->sdhPort());
    window().state().connectTo(connection);
    ASSERT_TRUE(await([&] {
      const LiveSource* source = window().state().live.source();
      return source && source->control->status().cannotReact.empty();
    }));
    ASSERT_TRUE(await([&] { return chip().isVisible(); }));
  }
  GraspControl& control() { return *window().state().live.source()->control; }
  HandChip& chip() { return *find<HandChip>("handChip"); }
  bool says(const char* word) {
    return await([&] { return chip().text() == word; });
  }
  QColor border() {
    const QWidget* views = find<QWidget>("views");
    const QImage image = window().grab().toImage();
    // Left of the views, in the middle of their height.
    const QPoint at = views->mapTo(&window(), QPoint(-1, views->height() / 2));
    return image.pixelColor(at * image.devicePixelRatio());
  }
  bool isLogged(const QString& text) {
    const ActivityLog& log = window().state().log;
    for (int row = 0; row < log.rowCount(); ++row)
      if (log.line(row).text.contains(text)) return true;
    return false;
  }
  // A reactive grasp whose frames cease on the way.
  void loseTheStream() {
    control().grasp(testing::reactiveGrasp(3000, 5.0));
    ASSERT_TRUE(bench_->awaitMotion());
    bench_->hand->unplug(true, false);
    ASSERT_TRUE(await([&] { return !control().status().unprotected.empty(); }));
    ASSERT_TRUE(await([&] { return control().status().phase == GraspPhase::kIdle; }));
    ASSERT_TRUE(says("not protected"));
    ASSERT_TRUE(await([&] { return actions().at("acknowledgeHand")->isEnabled(); }));
    bench_->hand->replug();
    ASSERT_TRUE(await([&] {
      const CaptureSession& session = *window().state().live.source()->session;
      return session.device().status().tactile.state == PortState::kStreaming &&
             control().status().cannotReact.empty();
    }));
  }

  std::unique_ptr<testing::EmulatedBench> bench_;
};

TEST_F(HandChipTest, IsThereOnlyWithAHandThatCanBeMoved) {
  EXPECT_FALSE(chip().isVisible());
  connectHand();
  EXPECT_TRUE(says("ready"));
  EXPECT_FALSE(find<QWidget>("handChip")->toolTip().isEmpty());
  window().state().live.end();
  EXPECT_TRUE(await([&] { return !chip().isVisible(); }));
}

// Live, and with a recording in sight while the hand is connected.
TEST_F(HandChipTest, FitsIntoTheToolBarOfSmallWindows) {
  connectHand();
  for (const bool recording : {false, true}) {
    if (recording) open({"good.dsa"});
    for (const QSize size :
         {QSize(1024, 768), QSize(1280, 800), QSize(1366, 768), QSize(1440, 900)}) {
      window().resize(size);
      ASSERT_TRUE(await([&] { return window().size() == size; }));
      for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
      const auto* bar = find<QToolBar>("Toolbar");
      EXPECT_TRUE(chip().isVisible()) << size.width() << ", " << recording;
      EXPECT_TRUE(bar->rect().contains(chip().geometry()));
      EXPECT_FALSE(chip().text().isEmpty()) << "no word: " << size.width() << ", " << recording;
      const auto* more = bar->findChild<QWidget*>("qt_toolbar_ext_button");
      EXPECT_FALSE(more->isVisible())
          << size.width() << ", " << recording << ": needs " << bar->sizeHint().width();
    }
  }
}

TEST_F(HandChipTest, FollowsTheHandInWordColourAndLogAndMovesNoButton) {
  connectHand();
  ASSERT_TRUE(says("ready"));
  const int width = chip().width();
  control().grasp(testing::reactiveGrasp(3000, 5.0));
  ASSERT_TRUE(says("moving"));
  EXPECT_EQ(border(), conditionColor(HandCondition::kMoving, Theme::kDark));
  EXPECT_EQ(chip().width(), width);
  control().stop();
  ASSERT_TRUE(says("stopped"));
  EXPECT_EQ(chip().width(), width);
  EXPECT_EQ(border(), conditionColor(HandCondition::kStopped, Theme::kDark));
  EXPECT_TRUE(isLogged("hand: moving: closing: reactive grasp"));
  EXPECT_TRUE(isLogged("hand: stopped: stopped by the user"));
  window().state().appearance.setTheme(ThemeChoice::kLight);
  EXPECT_EQ(border(), conditionColor(HandCondition::kStopped, Theme::kLight));
}

TEST_F(HandChipTest, AProtectionThatEndedStaysUntilAClickOnTheChip) {
  connectHand();
  EXPECT_FALSE(actions().at("acknowledgeHand")->isEnabled());
  ASSERT_NO_FATAL_FAILURE(loseTheStream());
  EXPECT_EQ(chip().text(), "not protected") << "frames that are back take nothing away";
  EXPECT_EQ(border(), conditionColor(HandCondition::kNotProtected, Theme::kDark));
  EXPECT_TRUE(actions().at("acknowledgeHand")->isEnabled());
  EXPECT_TRUE(isLogged("hand: not protected: stopped: the tactile port is gone"));
  EXPECT_TRUE(
      await([&] { return isLogged("alarm: not protected: stopped: the tactile port is gone"); }));
  // The port is back, and how it is acknowledged stands with it.
  const auto* state = find<QLabel>("handState");
  EXPECT_TRUE(await([&] {
    return state->text().startsWith(
        "Not protected: before the port came back: stopped: the tactile port");
  })) << state->text().toStdString();
  EXPECT_TRUE(state->text().contains("Hand > Acknowledge")) << state->text().toStdString();
  // A stop is no acknowledgement.
  control().stop();
  QTest::mouseClick(&chip(), Qt::LeftButton);
  ASSERT_TRUE(says("stopped"));
  EXPECT_FALSE(actions().at("acknowledgeHand")->isEnabled());
  EXPECT_TRUE(
      QToolTip::text().startsWith("The hand is not protected: before the port came back: stopped: "
                                  "the tactile port is gone"))
      << QToolTip::text().toStdString();
}

TEST_F(HandChipTest, TheNextMotionAcknowledgesARefusedOneDoesNot) {
  connectHand();
  ASSERT_NO_FATAL_FAILURE(loseTheStream());
  EXPECT_THROW(control().grasp(testing::reactiveGrasp(1)), std::invalid_argument);
  find<HandDock>("")->refresh();
  EXPECT_EQ(chip().text(), "not protected");
  control().grasp(testing::reactiveGrasp(3000, 5.0));
  EXPECT_TRUE(says("moving"));
}

// The hand looked ready between the steps, and with the dock hidden nothing told of the sequence.
TEST_F(HandChipTest, ASequenceThatRestsIsToldAlsoWithoutTheDock) {
  connectHand();
  ASSERT_TRUE(says("ready"));
  const int width = chip().width();
  find<QDoubleSpinBox>("stepSeconds")->setValue(60.0);
  QMenu* menu = find<QPushButton>("addStep")->menu();
  emit menu->aboutToShow();
  menu->findChild<QAction*>("addWait")->trigger();
  auto* start = find<QPushButton>("startSequence");
  ASSERT_TRUE(await([&] { return start->isEnabled(); }));
  find<QDockWidget>("Hand")->hide();
  start->click();
  ASSERT_TRUE(says("sequence runs")) << chip().text().toStdString();
  EXPECT_TRUE(chip().toolTip().startsWith("A sequence runs: step 1 of 1"))
      << chip().toolTip().toStdString();
  EXPECT_TRUE(chip().toolTip().contains("\nThe hand is ready: ")) << chip().toolTip().toStdString();
  EXPECT_TRUE(
      chip().styleSheet().contains(conditionColor(HandCondition::kMoving, Theme::kDark).name()));
  EXPECT_EQ(chip().width(), width);
  for (const char* word : {"sequence runs", "measuring zero"})
    EXPECT_LT(chip().fontMetrics().horizontalAdvance(word), width) << word;
  actions().at("stopHand")->trigger();
  EXPECT_TRUE(says("ready")) << "it has moved nothing";
}

// Of the empty hand, say.
TEST_F(HandChipTest, TheTaskOfAnotherFeatureIsToldUnlessTheHandIsInDanger) {
  HandTask task{"measuring zero", "The zero is measured"};
  connectHand();
  auto& other = window().state().handCommands.otherTask;
  const auto before = std::exchange(other, [&] { return task; });
  EXPECT_TRUE(says("measuring zero"));
  bench_->hand->unplug();
  EXPECT_TRUE(says("gone"));
  bench_->hand->replug();
  EXPECT_TRUE(says("measuring zero"));
  other = before;
  EXPECT_TRUE(says("ready"));
}

TEST_F(HandChipTest, AHandWhosePortIsGoneIsGone) {
  connectHand();
  bench_->hand->unplug();
  ASSERT_TRUE(says("gone"));
  EXPECT_TRUE(chip().toolTip().startsWith("The hand is gone: the hand can't be moved: "));
  bench_->hand->replug();
  EXPECT_TRUE(says("ready"));
}

}  // namespace
}  // namespace palpate::gui::hand_chip_test
