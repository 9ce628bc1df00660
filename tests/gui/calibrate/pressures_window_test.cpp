// Pressures and forces in the real window: beside the counts, of a recording and of a connected
// hand.
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <QToolButton>

#include "palpate/device/sdh2.h"
#include <palpate/calibration/force_series.h>

#include "calibration/sample_calibrations.h"
#include "control/emulated_bench.h"
#include "gui/calibrate/applied_calibration.h"
#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/force_page.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/step_page.h"
#include "gui/connect/connect_feature.h"
#include "gui/filter/filter_feature.h"
#include "gui/filter/filter_panel.h"
#include "gui/hand/hand_dock.h"
#include "gui/hand/hand_feature.h"
#include "gui/hand/sensitivity_modes.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/source/event_editor.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/window_state/recipe_editor.h"

namespace palpate::gui::pressures_window_test {
namespace {

Calibration calibration() { return testing::linearCalibration({0.5, 150.0, false}); }

class PressuresWindowTest : public WindowTest {
 protected:
  PressuresWindowTest() {
    std::filesystem::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
  }
  // Before the window opens.
  void apply(const std::string& file) {
    QSettings settings(settingsFile(), QSettings::IniFormat);
    applyCalibration(settings, sdh2().name, QString::fromStdString((folder_ / file).string()));
  }
  QString cell(int row, int column, int role = Qt::DisplayRole) {
    const MatrixTableModel& table = window().findChild<InspectPanel*>()->table();
    return table.data(table.index(row, column), role).toString();
  }
  QString force(int row) { return cell(row, MatrixTableModel::kForce); }
  QString fact() {
    for (const Fact& fact : window().findChild<FactsView*>("recordingFacts")->facts())
      if (fact.name == "calibration") return fact.value;
    return {};
  }
  void showPage(const char* page) {
    window().docks().show("Calibrate");
    find<CalibratePanel>("CalibratePanel")->showPage(page);
    find<CalibratePanel>("CalibratePanel")->settle();
    for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
};

TEST_F(PressuresWindowTest, WithoutACalibrationThereAreCountsAndTheWindowSaysSo) {
  open({"rich.dsa"});
  EXPECT_EQ(fact(), "none: values are counts");
  for (int row = 0; row <= 6; ++row) EXPECT_EQ(force(row), "–");
  EXPECT_TRUE(cell(1, MatrixTableModel::kForce, Qt::ToolTipRole).contains("no calibration"));
}

TEST_F(PressuresWindowTest, AnAppliedOneTellsForcesOfEveryFrame) {
  saveCalibration(calibration(), folder_ / "hand.json", Overwrite::kReplace);
  apply("hand.json");
  start();
  open({"rich.dsa"});
  EXPECT_EQ(fact(), "hand.json");
  const Profile& profile = window().state().displayed.unfilteredRecording()->profile;
  const ForceSeries series = forceSeries(profile, calibration());
  std::size_t strongest = 0;
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    if (series.forceN(i) > series.forceN(strongest)) strongest = i;
  ASSERT_GT(series.forceN(strongest), 0.1);
  for (const std::size_t frame : {strongest, std::size_t{3}, strongest + 1}) {
    playback().seekFrame(frame);
    // The calibration was made without the area of an indenter.
    EXPECT_EQ(
        force(6),
        (series.forceN(frame) > 0.0 ? "≤ " : "") + QString::number(series.forceN(frame), 'f', 2))
        << frame;
  }
  playback().seekFrame(strongest);
  // Another frame's figures don't stay when the recording goes.
  const QString tip = cell(6, MatrixTableModel::kForce, Qt::ToolTipRole);
  EXPECT_TRUE(tip.contains("N (95 %)")) << tip.toStdString();
  EXPECT_TRUE(tip.contains("upper limit")) << tip.toStdString();
  showPage("Force");
  find<QPushButton>("forceDrop")->click();
  EXPECT_EQ(force(6), "–");
  EXPECT_EQ(fact(), "none: values are counts");
}

TEST_F(PressuresWindowTest, AFileThatIsGoneIsSaid) {
  apply("none.json");
  start();
  open({"rich.dsa"});
  EXPECT_TRUE(fact().startsWith("can't be used: ")) << fact().toStdString();
  EXPECT_EQ(force(6), "–");
}

TEST_F(PressuresWindowTest, StepsThatWereFoundAreARowOfTheTimeline) {
  open({"rich.dsa"});
  const auto steps = [&] {
    std::size_t count = 0;
    for (const EventMark& mark : window().feature<TimelineFeature>().panel().rows().marks())
      count += mark.lane == EventLane::kSteps ? 1 : 0;
    return count;
  };
  EXPECT_EQ(steps(), 0u) << "nobody asked for them";
  showPage("Steps");
  const auto& found = find<CalibratePanel>("CalibratePanel")->steps().found();
  ASSERT_NE(found, nullptr);
  ASSERT_GT(found->report.steps.size(), 0u);
  EXPECT_EQ(steps(), found->report.steps.size());
  open({"good.dsa"});
  EXPECT_EQ(steps(), 0u) << "they are of the other recording";
}

TEST_F(PressuresWindowTest, ALiveHandHasForcesToo) {
  saveCalibration(calibration(), folder_ / "hand.json", Overwrite::kReplace);
  apply("hand.json");
  start();
  window().state().connectTo(emulatedBallConnection());
  ASSERT_TRUE(await([&] { return window().state().displayed.isLive() && force(6) != "–"; }));
  EXPECT_TRUE(await([&] { return force(6).remove("≤ ").toDouble() > 0.5; }))
      << "the ball is grasped";
  EXPECT_TRUE(await([&] { return fact() == "hand.json"; }));
  showPage("Force");
  EXPECT_TRUE(await([&] { return find<CalibratePanel>("CalibratePanel")->force().shown(); }));
  // Not applied any more: at the next frame there are none.
  find<QPushButton>("forceDrop")->click();
  EXPECT_TRUE(await([&] { return force(6) == "–"; }));
}

TEST_F(PressuresWindowTest, NoiseLinesLeadToHighSensitivityAndAFilterAgainstGhosts) {
  start();
  Connection connection;
  connection.kind = Connection::Kind::kEmulated;
  connection.scene = "empty";
  window().state().connectTo(connection);
  ASSERT_TRUE(
      await([&] { return window().state().displayed.isLive() && !window().state().live.stale(); }));
  emit find<CalibratePanel>("CalibratePanel")
      ->noise()
      .applyRequested(testing::evenNoise(0.3, 40.0, 2.0));
  window().feature<FilterFeature>().panel().editor().setRecipe(
      parseRecipe(std::vector<std::string>{"gaussian"}));
  EXPECT_FALSE(window().feature<FilterFeature>().panel().on());
  find<QToolButton>("sensitivityHigh")->click();
  EXPECT_EQ(window().feature<HandFeature>().panel().sensitivity().mode(), SensitivityMode::kHigh);
  EXPECT_TRUE(window().feature<FilterFeature>().panel().on());
  EXPECT_TRUE(window().feature<FilterFeature>().panel().editor().recipe().sameSteps(
      highSensitivityRecipe()));
  find<QToolButton>("sensitivityManual")->click();
  EXPECT_FALSE(window().feature<FilterFeature>().panel().on());
  EXPECT_TRUE(window().feature<FilterFeature>().panel().editor().recipe().sameSteps(
      parseRecipe(std::vector<std::string>{"gaussian"})));
}

}  // namespace
}  // namespace palpate::gui::pressures_window_test
