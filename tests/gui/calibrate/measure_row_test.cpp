// Tare and noise of a connected hand, measured in the dock Calibrate.
#include "gui/calibrate/measure_row.h"

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <filesystem>

#include "palpate/device/sdh2.h"
#include <palpate/calibration/tare.h>
#include <palpate/recording/recording.h>

#include "control/emulated_bench.h"
#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/tare_page.h"
#include "gui/connect/connect_feature.h"
#include "gui/testing/window_fixture.h"
#include "gui/widgets/figures_table.h"

namespace palpate::gui::measure_row_test {
namespace {
namespace fs = std::filesystem;

// Row 7, column 2 of a matrix in the sequence of all places.
std::size_t placeIn(std::size_t matrix) {
  const SensorLayout& layout = *sdh2().layout;
  return layout.offset(matrix) + static_cast<std::size_t>(7 * layout.matrix(matrix).columns + 2);
}
std::size_t ghostPlace() { return placeIn(1); }

class MeasureRowTest : public WindowTest {
 protected:
  MeasureRowTest() {
    fs::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
    QSettings(settingsFile(), QSettings::IniFormat).setValue("calibrate/tare_seconds", 2);
    window().state().prompts.recording = [this](RecordingSettings settings, const QString&) {
      settings.folder = QString::fromStdString((folder_ / "runs").string());
      settings.nameTemplate = "{object}_{run}";
      settings.object = "ball";
      return std::optional(settings);
    };
    auto model = std::make_unique<testing::StillHand>();
    still_ = model.get();
    still_->values[ghostPlace()] = 30;
    bench_ = std::make_unique<testing::EmulatedBench>(std::move(model));
    Connection connection;
    connection.kind = Connection::Kind::kPorts;
    connection.dsaPort = QString::fromStdString(bench_->hand->dsaPort());
    connection.sdhPort = QString::fromStdString(bench_->hand->sdhPort());
    window().state().connectTo(connection);
    EXPECT_TRUE(await([&] { return window().state().displayed.isLive() && !live().stale(); }));
    EXPECT_TRUE(await([&] { return live().source()->control->status().cannotReact.empty(); }));
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  LiveController& live() { return window().state().live; }
  CalibratePanel& panel() { return *find<CalibratePanel>("CalibratePanel"); }
  MeasureRow& tareRow() { return panel().tare().measureRow(); }
  void showPage(const char* page) {
    window().docks().show("Calibrate");
    panel().showPage(page);
    panel().settle();
    for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();
  }
  void touch(std::size_t place, std::uint16_t counts) {
    bench_->hand->withModel([&](HandModel&) { still_->values[place] = counts; });
  }
  void begin(const char* button = "tareMeasure") {
    find<QPushButton>(button)->click();
    QCoreApplication::processEvents();
  }
  QString text(const char* label = "tareMeasureText") { return find<QLabel>(label)->text(); }
  // Begins, and waits for the end of the measurement and of the computation.
  void measureTare() {
    begin();
    ASSERT_TRUE(tareRow().running()) << text().toStdString();
    ASSERT_TRUE(await([&] { return !tareRow().running(); }));
    panel().settle();
  }

  std::unique_ptr<testing::EmulatedBench> bench_;
  testing::StillHand* still_ = nullptr;
};

TEST_F(MeasureRowTest, TheTareOfTheConnectedHandIsShownAsThatOfARecording) {
  showPage("Tare");
  EXPECT_TRUE(panel().tare().emptyText().contains("Measure now"));
  EXPECT_EQ(find<QSpinBox>("tareMeasureSeconds")->value(), 2) << "as stored";
  measureTare();
  ASSERT_TRUE(panel().tare().shown()) << panel().tare().emptyText().toStdString();
  EXPECT_EQ(find<FiguresTable>("tareTable")->item(1, 2)->text(), "30.0");
  EXPECT_EQ(find<FiguresTable>("tareTable")->item(1, 3)->text(), "1");
  EXPECT_TRUE(text().startsWith("Measured: ")) << text().toStdString();
  EXPECT_TRUE(text().contains("456 taxels scanned")) << text().toStdString();
  const OpenedRecordingPtr of = panel().tare().foundIn();
  ASSERT_NE(of, nullptr);
  EXPECT_GE(of->durationS(), 2.0);
  EXPECT_LT(of->durationS(), 2.5);
  EXPECT_FALSE(panel().tare().tables().empty()) << "can be copied and exported";
  EXPECT_FALSE(find<QPushButton>("tareKeep")->isEnabled()) << "nothing is being recorded";
  // The result stays while a recording is looked at.
  open({"good.dsa"});
  EXPECT_FALSE(tareRow().isVisible());
  window().state().displayed.showLive();
  showPage("Tare");
  EXPECT_TRUE(panel().tare().shown());
  EXPECT_EQ(panel().tare().foundIn(), of);
}

TEST_F(MeasureRowTest, AMeasuredTareIsAddedToTheRecordingThatRuns) {
  showPage("Tare");
  measureTare();
  auto* keep = find<QPushButton>("tareKeep");
  EXPECT_FALSE(keep->isEnabled());
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return keep->isEnabled(); }));
  // More than the seconds from before the start: the event lies within the recorded frames.
  const auto onDisk = live().health().recorder.framesOnDisk;
  keep->click();
  EXPECT_TRUE(find<QLabel>("tareState")->text().contains("Added"));
  ASSERT_TRUE(await([&] { return live().health().recorder.framesOnDisk > onDisk + 20; }));
  press(Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(await([&] { return !live().recording(); }));
  EXPECT_TRUE(await([&] { return !keep->isEnabled(); }));
  const fs::path file = folder_ / "runs" / "ball_001.palpate";
  const Profile profile = openRecording(file);
  std::optional<Tare> tare;
  for (const Event& event : readEvents(file).events)
    if (event.kind == "tare") {
      tare = tareFrom(Json::parse(event.json), profile.layout());
      EXPECT_GE(event.tUs, profile.frameTimeUs(0));
      EXPECT_LE(event.tUs, profile.frameTimeUs(profile.numFrames() - 1));
      EXPECT_TRUE(event.text.find("tare of 1 taxel, measured for 2.") == 0) << event.text;
    }
  ASSERT_TRUE(tare);
  EXPECT_EQ(tare->zero[ghostPlace()], 30.0F);
  EXPECT_TRUE(tare->matrices[1].windows.empty()) << "these frames are not in the recording";
}

TEST_F(MeasureRowTest, AHandThatIsTouchedIsRefused) {
  touch(placeIn(4), 500);
  showPage("Tare");
  measureTare();
  EXPECT_FALSE(panel().tare().shown());
  EXPECT_EQ(panel().tare().found(), nullptr);
  const QString why = panel().tare().emptyText();
  EXPECT_TRUE(why.contains("not at rest") &&
              why.contains(QString::fromStdString(sdh2().matrixName(4))))
      << why.toStdString();
}

TEST_F(MeasureRowTest, AMovingHandIsRefused) {
  showPage("Tare");
  begin();
  ASSERT_TRUE(tareRow().running());
  MoveJoints move;
  move.targetDeg = std::vector<double>(7, 10.0);
  const auto answer = live().source()->session->device().submit(move);
  ASSERT_TRUE(await([&] { return !tareRow().running(); }));
  EXPECT_TRUE(text().startsWith("Nothing was measured: the hand ")) << text().toStdString();
  EXPECT_EQ(panel().tare().found(), nullptr);
}

TEST_F(MeasureRowTest, ItCanBeCancelled) {
  find<QSpinBox>("tareMeasureSeconds")->setValue(60);
  showPage("Tare");
  begin();
  ASSERT_TRUE(tareRow().running());
  EXPECT_TRUE(find<QPushButton>("tareMeasureCancel")->isVisible());
  EXPECT_FALSE(find<QPushButton>("tareMeasure")->isEnabled());
  EXPECT_TRUE(await([&] { return text().contains("s left: ") && !text().contains(" 0 frames"); }));
  press(Qt::Key_Escape);
  EXPECT_FALSE(tareRow().running());
  EXPECT_EQ(text(), "Nothing was measured: cancelled.");
  begin();
  ASSERT_TRUE(tareRow().running());
  find<QPushButton>("tareMeasureCancel")->click();
  EXPECT_FALSE(tareRow().running());
  EXPECT_FALSE(find<QPushButton>("tareMeasureCancel")->isVisible());
  EXPECT_EQ(panel().tare().found(), nullptr);
  QSettings settings(settingsFile(), QSettings::IniFormat);
  window().state().settings.sync();
  settings.sync();
  EXPECT_EQ(settings.value("calibrate/tare_seconds").toInt(), 60) << "remembered";
}

// The order of docs/manual/keys.md: a message first.
TEST_F(MeasureRowTest, EscapeClosesAMessageBeforeItCancels) {
  find<QSpinBox>("tareMeasureSeconds")->setValue(60);
  showPage("Tare");
  begin();
  ASSERT_TRUE(tareRow().running());
  EXPECT_EQ(find<QPushButton>("tareMeasureCancel")->toolTip(),
            "Cancel the measurement (Esc; closes an open message first)");
  window().state().messages.fail("something else failed");
  press(Qt::Key_Escape);
  EXPECT_TRUE(tareRow().running());
  press(Qt::Key_Escape);
  EXPECT_FALSE(tareRow().running());
}

TEST_F(MeasureRowTest, DisconnectingEndsItAndNothingIsHalfDone) {
  showPage("Tare");
  begin();
  ASSERT_TRUE(tareRow().running());
  live().end();
  EXPECT_FALSE(tareRow().running());
  EXPECT_EQ(text(), "Nothing was measured: the hand was disconnected.");
  ASSERT_TRUE(await([&] { return live().state() == LiveController::State::kNone; }));
  EXPECT_FALSE(tareRow().isHidden()) << "says it where the page is shown";
  EXPECT_FALSE(find<QPushButton>("tareMeasure")->isEnabled());
  EXPECT_EQ(panel().tare().found(), nullptr);
}

TEST_F(MeasureRowTest, APortThatFallsSilentEndsIt) {
  showPage("Tare");
  begin();
  ASSERT_TRUE(await([&] { return text().contains("frames") && !text().contains(" 0 frames"); }));
  bench_->hand->unplug(true, false);
  ASSERT_TRUE(await([&] { return !tareRow().running(); }));
  EXPECT_TRUE(text().startsWith("Nothing was measured: no frames for ")) << text().toStdString();
}

TEST_F(MeasureRowTest, NoiseNeedsThreshold0) {
  for (std::size_t m = 0; m < sdh2().layout->numMatrices(); ++m) touch(placeIn(m), 40);
  find<QSpinBox>("noiseMeasureSeconds")->setValue(1);
  showPage("Noise");
  EXPECT_TRUE(panel().noise().emptyText().contains("Measure now"));
  begin("noiseMeasure");
  EXPECT_FALSE(panel().noise().measureRow().running());
  EXPECT_TRUE(text("noiseMeasureText").contains("thresholds hide the noise"));
  auto answer = live().source()->session->device().submit(SetThreshold{std::nullopt, 0});
  ASSERT_TRUE(
      await([&] { return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
  answer.get();
  // The stream pauses for some seconds after that.
  ASSERT_TRUE(await([&] {
    if (text("noiseMeasureText").startsWith("Measured: ")) return true;
    if (!panel().noise().measureRow().running()) begin("noiseMeasure");
    return false;
  })) << text("noiseMeasureText").toStdString();
  panel().settle();
  // This hand doesn't warm up.
  EXPECT_TRUE(panel().noise().emptyText().contains("one temperature only"))
      << panel().noise().emptyText().toStdString() << text("noiseMeasureText").toStdString();
}

}  // namespace
}  // namespace palpate::gui::measure_row_test
