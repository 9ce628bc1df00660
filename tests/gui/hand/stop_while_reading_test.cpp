// While files that the user named are being read, the hand is stopped as ever.
#include <QPushButton>

#include "palpate/device/sdh2.h"
#include <palpate/recording/recording.h>

#include "calibration/sample_calibrations.h"
#include "gui/calibrate/applied_calibration.h"
#include "gui/calibrate/calibrate_panel.h"
#include "gui/calibrate/force_page.h"
#include "gui/connect/scene_page.h"
#include "gui/connect/stream_page.h"
#include "gui/hand/stop_in_the_window.h"
#include "gui/hand3d/hand_view.h"
#include "gui/recognise/object_photo.h"
#include "gui/record/plan_controller.h"
#include "gui/testing/held_readings.h"
#include "gui/testing/mesh_hand.h"
#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui::stop_while_reading_test {
namespace {
namespace fs = std::filesystem;

// A way by which a file gets into the window.
struct Door {
  const char* name;
  // Begins to read the file.
  void (*open)(StopInTheWindow& bench, const fs::path& file);
};

QString textOf(const fs::path& path) { return QString::fromStdString(path.string()); }

template <class Part>
Part& partOf(StopInTheWindow& bench) {
  return *bench.window().findChild<Part*>();
}

void trigger(StopInTheWindow& bench, const QString& text) {
  for (QAction* action : bench.window().findChildren<QAction*>())
    if (action->text() == text || action->objectName() == text) return action->trigger();
  FAIL() << "no action " << text.toStdString();
}

const Door kDoors[] = {
    {"plan",
     [](StopInTheWindow& bench, const fs::path& file) {
       auto* plan = new PlanController(bench.window().state().settings, &bench.window());
       plan->importCsv(file);
     }},
    {"sequence",
     [](StopInTheWindow& bench, const fs::path& file) {
       bench.ask().files = {textOf(file)};
       trigger(bench, "openSequence");
     }},
    {"poses",
     [](StopInTheWindow& bench, const fs::path& file) {
       bench.ask().files = {textOf(file)};
       trigger(bench, "importPoses");
     }},
    {"recipe",
     [](StopInTheWindow& bench, const fs::path& file) {
       bench.ask().files = {textOf(file)};
       trigger(bench, "Open a recipe…");
     }},
    {"noise_lines",
     [](StopInTheWindow& bench, const fs::path& file) {
       bench.ask().files = {textOf(file)};
       bench.window().findChild<QPushButton*>("noiseOpen")->click();
     }},
    {"calibration",
     [](StopInTheWindow& bench, const fs::path& file) {
       applyCalibration(bench.window().state().settings, sdh2().name, textOf(file));
       emit partOf<CalibratePanel>(bench).force().applied();
     }},
    {"scene",
     [](StopInTheWindow& bench, const fs::path& file) {
       auto* page = new ScenePage(bench.folder() / "none", bench.ask(), &bench.window());
       page->setScene(textOf(file));
     }},
    {"hand_folder",
     [](StopInTheWindow& bench, const fs::path& file) {
       fs::create_directories(bench.folder() / "hand");
       fs::copy_file(
           file, bench.folder() / "hand" / "hand.json", fs::copy_options::overwrite_existing);
       auto* scan = new PortScan(&bench.window());
       auto* page = new StreamPage({}, *scan, bench.ask(), &bench.window());
       page->setStream({.source = "udp:9871", .hand = textOf(bench.folder() / "hand")});
     }},
    {"meshes",
     [](StopInTheWindow& bench, const fs::path& file) {
       fs::create_directories(bench.folder() / "meshed");
       fs::copy_file(
           file, bench.folder() / "meshed" / "body.stl", fs::copy_options::overwrite_existing);
       auto* view = new HandView(&bench.window());
       view->setHand(meshHand(bench.folder() / "meshed"));
     }},
    {"photo",
     [](StopInTheWindow& bench, const fs::path& file) {
       fs::copy_file(file, bench.folder() / "ball.png", fs::copy_options::overwrite_existing);
       auto* photos = new PhotoCache(&bench.window());
       photos->setFolders({bench.folder()});
       photos->photo("ball");
     }},
    // The last one: a recording is shown then, and the hand is still connected.
    {"labels", [](StopInTheWindow& bench, const fs::path& file) {
       bench.ask().files = {textOf(file)};
       bench.window().state().actions.at("importLabels")->trigger();
     }}};

void showRecording(StopInTheWindow& bench) {
  const fs::path path = bench.folder() / "a.palpate";
  saveRecording(twentyFrames(), {}, path);
  WindowState& state = bench.window().state();
  state.open({path});
  EXPECT_TRUE(QTest::qWaitFor([&] { return state.displayed.isRecording(); }, 20'000));
}

int numBusyIn(const QObject& root) {
  int busy = 0;
  for (const FileReading* reading : root.findChildren<FileReading*>()) busy += reading->busy();
  return busy;
}

TEST(StopWhileReading, EscapeIsOnTheWireWhileEachDoorReads16MbOfRubbish) {
  StopInTheWindow bench;
  const fs::path rubbish = bench.folder() / "rubbish.json";
  testing::writeFile(rubbish, std::string(16u << 20, '{'));
  bool close = true;
  for (const Door& door : kDoors) {
    SCOPED_TRACE(door.name);
    if (std::string(door.name) == "labels") showRecording(bench);
    FileReading::settleAll(bench.window());
    GraspRequest request;
    request.velocityDegPerS = 20.0;
    request.closeRatio = close ? 1.0 : 0.0;
    close = !close;
    HeldReadings held;
    bench.pressAfter(200'000, request, [&] {
      door.open(bench, rubbish);
      held.await(1);
      EXPECT_GE(numBusyIn(bench.window()), 1) << "it hasn't answered";
    });
    if (::testing::Test::HasFatalFailure()) return;
    EXPECT_GE(numBusyIn(bench.window()), 1) << "it hasn't answered";
    held.release();
    FileReading::settleAll(bench.window());
    EXPECT_EQ(numBusyIn(bench.window()), 0);
  }
  bench.judge();
  EXPECT_GT(bench.inMotion(), static_cast<int>(std::size(kDoors)) / 2);
}

// A grasp must not begin with the calibration from before.
TEST(StopWhileReading, AnotherCalibrationOfTheSameFileEndsTheOneBeforeAtOnce) {
  StopInTheWindow bench;
  WindowState& state = bench.window().state();
  const auto calibrated = [&] { return state.live.source()->control->status().calibrated; };
  const fs::path file = bench.folder() / "c.json";
  saveCalibration(testing::linearCalibration({0.5, 150.0, false}), file);
  applyCalibration(state.settings, state.displayed.hand()->name, textOf(file));
  ForcePage& page = partOf<CalibratePanel>(bench).force();
  emit page.applied();
  FileReading::settleAll(bench.window());
  EXPECT_TRUE(calibrated());
  HeldReadings held;
  emit page.applied();
  EXPECT_FALSE(calibrated());
  EXPECT_TRUE(state.handCommands.calibrationBeingRead(state.displayed.hand()->name));
  held.release();
  FileReading::settleAll(bench.window());
  EXPECT_TRUE(calibrated());
  EXPECT_FALSE(state.handCommands.calibrationBeingRead(state.displayed.hand()->name));
}

}  // namespace
}  // namespace palpate::gui::stop_while_reading_test
