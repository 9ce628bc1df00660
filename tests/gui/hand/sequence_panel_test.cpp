// Sequences in the dock Hand on the emulated hand; undo of its tactile settings, and the number of
// scanned taxels.
#include "gui/hand/sequence_panel.h"

#include <QFile>
#include <QListWidget>
#include <QMenu>
#include <QSpinBox>
#include <QTabBar>

#include "palpate/device/sdh2.h"

#include "gui/hand/hand_dock_bench.h"
#include "gui/source/file_reading.h"
#include "gui/testing/held_readings.h"

namespace palpate::gui::sequence_panel_test {
namespace {
using testing::stillHand;

class SequencePanelTest : public HandDockBench {
 protected:
  void connectAndOpen() {
    connectTo(stillHand());
    dock_->resize(520, 900);
    type("velocity", "90");
    type("closeRatio", "0.4");
    find<QTabBar>("handPages")->setCurrentIndex(2);
    panel_ = dock_->findChild<SequencePanel*>();
    ASSERT_TRUE(await([&] { return isEnabled("openHand"); }));
  }
  // Through the menu of the button Add.
  void add(const char* name) {
    QMenu* menu = find<QPushButton>("addStep")->menu();
    emit menu->aboutToShow();
    QAction* action = menu->findChild<QAction*>(name);
    ASSERT_TRUE(action) << name;
    action->trigger();
  }
  // The line of the page; the dock shows what has changed a moment later.
  QString shown() { return find<QLabel>("sequenceState")->text(); }
  SequencePanel* panel_ = nullptr;
};

TEST_F(SequencePanelTest, IsBuiltStartedAndDone) {
  connectAndOpen();
  EXPECT_FALSE(isEnabled("startSequence"));
  EXPECT_EQ(find<QPushButton>("startSequence")->toolTip(), "Add a step first");
  add("addOpen");
  add("addGrasp");
  find<QDoubleSpinBox>("stepSeconds")->setValue(0.2);
  add("addHold");
  EXPECT_EQ(find<QListWidget>("sequenceSteps")->count(), 3);
  find<QSpinBox>("sequenceTimes")->setValue(2);
  EXPECT_TRUE(bench_->log.deeds().empty()) << "building it moves nothing";
  ASSERT_TRUE(await([&] { return isEnabled("startSequence"); }));
  click("startSequence");
  EXPECT_TRUE(await([&] { return state().startsWith("step 2 of 3, 1 of 2 times"); }));
  EXPECT_FALSE(isEnabled("graspHand"));
  EXPECT_FALSE(isEnabled("addStep"));
  EXPECT_TRUE(await([&] { return state().startsWith("step 3 of 3, 2 of 2 times"); }));
  EXPECT_FALSE(isEnabled("graspHand")) << "resting is no free hand";
  EXPECT_TRUE(await([&] { return shown() == "sequence finished: 3 steps, 2 times"; }))
      << shown().toStdString();
  EXPECT_FALSE(panel_->running());
  EXPECT_EQ(bench_->log.named("m").size(), 4u);
  // Kept for the next session.
  dock_->setHand(nullptr, nullptr);
  dock_ = newDock();
  EXPECT_EQ(find<QListWidget>("sequenceSteps")->count(), 3);
  EXPECT_EQ(find<QSpinBox>("sequenceTimes")->value(), 2);
}

TEST_F(SequencePanelTest, EscapeAndStopEndAllOfItInAMotionAndInARest) {
  connectAndOpen();
  type("velocity", "60");
  add("addGrasp");
  find<QDoubleSpinBox>("stepSeconds")->setValue(60.0);
  add("addHold");
  add("addOpen");
  for (const bool rest : {false, true})
    for (const bool key : {false, true}) {
      ASSERT_TRUE(await([&] { return isEnabled("startSequence"); }));
      click("startSequence");
      ASSERT_TRUE(await([&] {
        return rest ? state().startsWith("step 2 of 3") : bench_->handMoves() || rest;
      })) << state().toStdString();
      const std::size_t motions = bench_->log.named("m").size();
      if (key)
        QTest::keyClick(dock_.get(), Qt::Key_Escape);
      else
        click("stopHand");
      EXPECT_TRUE(await([&] { return !panel_->running() && !bench_->handMoves(); }));
      EXPECT_TRUE(await([&] { return shown().contains("stopped"); })) << shown().toStdString();
      QTest::qWait(200);
      EXPECT_EQ(bench_->log.named("m").size(), motions) << "no motion follows";
      // Back to the begin, so that the first step is a motion again.
      ASSERT_TRUE(await([&] { return isEnabled("openHand"); }));
      find<QPushButton>("openHand")->click();
      ASSERT_TRUE(await([&] {
        return bench_->control->status().phase == GraspPhase::kIdle && !bench_->handMoves() &&
               state().startsWith("finished");
      }));
    }
}

TEST_F(SequencePanelTest, AHandThatIsUnpluggedEndsIt) {
  connectAndOpen();
  add("addGrasp");
  find<QDoubleSpinBox>("stepSeconds")->setValue(60.0);
  add("addHold");
  add("addOpen");
  click("startSequence");
  ASSERT_TRUE(await([&] { return state().startsWith("step 2 of 3"); }));
  bench_->hand->unplug(true, true);
  EXPECT_TRUE(await([&] { return shown().startsWith("sequence ended in step 2 of 3"); }))
      << shown().toStdString();
  EXPECT_FALSE(panel_->running());
}

TEST_F(SequencePanelTest, FilesAreReadWholeOrNotAtAll) {
  connectAndOpen();
  add("addOpen");
  const QString path = QString::fromStdString((folder_ / "s.json").string());
  ask_.files = {path};
  ask_.newFiles = {path};
  dock_->findChild<QAction*>("saveSequence")->trigger();
  add("addWait");
  dock_->findChild<QAction*>("openSequence")->trigger();
  FileReading::settleAll(*panel_);
  EXPECT_EQ(find<QListWidget>("sequenceSteps")->count(), 1);
  MotionSequence foreign = panel_->sequence();
  foreign.hand = "another";
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(sequenceText(foreign).c_str());
  file.close();
  QString why;
  QObject::connect(
      panel_, &SequencePanel::refused, panel_, [&](const QString& said) { why = said; });
  dock_->findChild<QAction*>("openSequence")->trigger();
  FileReading::settleAll(*panel_);
  EXPECT_TRUE(why.contains("of another hand: another")) << why.toStdString();
  EXPECT_EQ(panel_->sequence().hand, sdh2().name) << "the table stays";
}

TEST_F(SequencePanelTest, ATableThatIsBeingReadTakesThePlaceOfThisOneOnlyWhileNoneRuns) {
  connectAndOpen();
  add("addOpen");
  const QString path = QString::fromStdString((folder_ / "s.json").string());
  ask_.files = {path};
  ask_.newFiles = {path};
  dock_->findChild<QAction*>("saveSequence")->trigger();
  find<QDoubleSpinBox>("stepSeconds")->setValue(60.0);
  add("addHold");
  ASSERT_TRUE(await([&] { return isEnabled("startSequence"); }));
  QString why;
  QObject::connect(
      panel_, &SequencePanel::refused, panel_, [&](const QString& said) { why = said; });
  {
    HeldReadings held;
    dock_->findChild<QAction*>("openSequence")->trigger();
    for (const char* each : {"startSequence", "addStep", "removeStep", "sequenceFile"})
      EXPECT_FALSE(isEnabled(each)) << each;
    EXPECT_EQ(find<QPushButton>("startSequence")->toolTip(), "A sequence is being read");
  }
  FileReading::settleAll(*panel_);
  EXPECT_EQ(panel_->sequence().steps.size(), 1u);
  EXPECT_TRUE(isEnabled("addStep"));
  add("addHold");
  click("startSequence");
  ASSERT_TRUE(await([&] { return panel_->running(); }));
  dock_->findChild<QAction*>("openSequence")->trigger();
  FileReading::settleAll(*panel_);
  EXPECT_EQ(panel_->sequence().steps.size(), 2u) << "the one that runs";
  EXPECT_EQ(why, "s.json: not opened: a sequence runs");
}

TEST_F(SequencePanelTest, ASlipAwareStepNeedsATimeToHold) {
  connectAndOpen();
  QString why;
  QObject::connect(
      panel_, &SequencePanel::refused, panel_, [&](const QString& said) { why = said; });
  add("addSlipAware");
  EXPECT_TRUE(why.contains("needs a time to hold: set it on the page Grasp, More > Hold"))
      << why.toStdString();
  EXPECT_EQ(find<QListWidget>("sequenceSteps")->count(), 0);
}

TEST_F(SequencePanelTest, SettingsAreUndoneAndRedone) {
  connectTo(stillHand());
  dock_->resize(520, 900);
  ASSERT_TRUE(await([&] { return find<ValueSlider>("threshold1")->value() == 300.0; }));
  EXPECT_FALSE(isEnabled("undoSettings"));
  type("threshold3", "77");
  ASSERT_TRUE(await([&] { return onTheHand()[3].thresholdCounts == 77; }));
  ASSERT_TRUE(await([&] { return isEnabled("undoSettings"); }));
  click("resetSettings");
  ASSERT_TRUE(await([&] { return onTheHand()[3].thresholdCounts == 300; }));
  ASSERT_TRUE(await([&] { return isEnabled("undoSettings"); }));
  click("undoSettings");
  ASSERT_TRUE(await([&] { return onTheHand()[3].thresholdCounts == 77; }));
  ASSERT_TRUE(await([&] { return isEnabled("undoSettings") && isEnabled("redoSettings"); }));
  click("undoSettings");
  ASSERT_TRUE(await([&] { return onTheHand()[3].thresholdCounts == 300; }));
  ASSERT_TRUE(await([&] { return isEnabled("redoSettings"); }));
  EXPECT_FALSE(isEnabled("undoSettings"));
  click("redoSettings");
  ASSERT_TRUE(await([&] { return onTheHand()[3].thresholdCounts == 77; }));
}

TEST_F(SequencePanelTest, TheScannedTaxelsAreCounted) {
  connectTo(stillHand());
  auto* scanned = find<QLabel>("scannedTaxels");
  // 3 x 14 x 6, and 3 x 13 x 6 with 10 places without a taxel.
  ASSERT_TRUE(await([&] { return scanned->text() == "456 of 456 taxels scanned"; }))
      << scanned->text().toStdString();
  Mask none(14 * 6, 0);
  bench_->control->change(SetDynamicMask{2, none});
  EXPECT_TRUE(await([&] {
    return scanned->text().startsWith("372 of 456 taxels scanned; blind: ");
  })) << scanned->text().toStdString();
}

}  // namespace
}  // namespace palpate::gui::sequence_panel_test
