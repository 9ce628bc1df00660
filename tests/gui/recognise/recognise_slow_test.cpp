// What the emulated hand grasps by itself, named while it is held: the model that comes with the
// program.
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <set>

#include <palpate/recognition/grasp_features.h>

#include "gui/recognise/recognise_fixture.h"
#include "gui/recognise/today_page.h"
#include "gui/widgets/figures_table.h"

namespace palpate::gui::recognise_slow_test {
namespace {

class RecogniseSlowTest : public RecogniseWindowTest {};

TEST_F(RecogniseSlowTest, BallPenAndBottleAreNamed) {
  for (const char* name : {"ball", "pen", "bottle"}) EXPECT_EQ(heldName(name), name);
}

TEST_F(RecogniseSlowTest, AnUnknownShapeIsCalledUnknown) {
  testing::writeFile(
      folder_ / "cone.json",
      R"({"objects": [{"shape": "cone", "size_mm": [60, 120], "stiffness_n_per_mm3": 10, "friction": 0.7,
          "mass_kg": 0.1, "pose": {"position_mm": [19.05, 0, 150]}}],
          "hand": {"preshape": "pinch-parallel"},
          "script": [{"at_s": 1.5, "grasp": {"velocity_deg_per_s": 30}}, {"at_s": 9, "release": {}}]})");
  EXPECT_EQ(heldName((folder_ / "cone.json").string()), "unknown");
}

// The empty hand closes until its pads touch, holds, and would open: not after a stop.
TEST_F(RecogniseSlowTest, NothingMovesAfterAStopWhileTheZeroIsTaken) {
  const auto await = [](const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 40'000);
  };
  Connection connection;
  connection.kind = Connection::Kind::kEmulated;
  connection.scene = "empty";
  window().state().connectTo(connection);
  const auto status = [&] { return window().state().live.source()->control->status(); };
  ASSERT_TRUE(
      await([&] { return window().state().displayed.isLive() && status().cannotReact.empty(); }));
  const auto ask = [&] { emit window().findChild<TodayPage*>()->zeroRequested(); };
  const auto closed = [&] {
    return status().phase == GraspPhase::kIdle && status().last &&
           status().last->outcome == GraspOutcome::kLimitReached;
  };
  ask();
  ASSERT_TRUE(await([&] { return status().phase == GraspPhase::kClosing; }));
  const auto* chip = find<QPushButton>("handChip");
  EXPECT_TRUE(await([&] { return chip->text() == "measuring zero"; }))
      << chip->text().toStdString();
  ASSERT_TRUE(await(closed)) << status().last->text;
  QTest::mouseClick(find<QPushButton>("stopHand"), Qt::LeftButton);
  EXPECT_NE(chip->text(), "measuring zero");
  const std::int64_t endedUs = status().last->endUs;
  QTest::qWait(4000);  // longer than it would have held
  EXPECT_EQ(status().phase, GraspPhase::kIdle);
  EXPECT_EQ(status().last->endUs, endedUs) << "it moved after a stop";
}

// Close until the pads touch, hold, open: then the zero is there, and verdicts of the day rest on
// it.
TEST_F(RecogniseSlowTest, TheZeroOfTheEmptyHandIsTakenAndUsed) {
  const auto await = [](const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 60'000);
  };
  // A model of the emulated hand that is nobody's default, with the zero of its day; as told here,
  // 3 mm off today's.
  TrainedModel model = loadModel(testing::dataFolder() / "emulated_objects.json");
  ASSERT_TRUE(model.trainingZero);
  resetSession(model);
  model.trainingZero->mm -= 3.0;
  saveModel(model, folder_ / "own.json");
  Connection connection;
  connection.kind = Connection::Kind::kEmulated;
  connection.scene = "empty";
  window().state().connectTo(connection);
  window().docks().show("Recognise");
  const auto status = [&] { return window().state().live.source()->control->status(); };
  ASSERT_TRUE(
      await([&] { return window().state().displayed.isLive() && status().cannotReact.empty(); }));
  settle();
  panel().controller().openModel(folder_ / "own.json");
  settle();
  ASSERT_TRUE(panel().controller().session());
  // What the status line said last of it.
  std::string said;
  const auto hear = [&] {
    for (const QLabel* label : window().findChildren<QLabel*>())
      if (label->text().contains("no zero") || label->text().contains("empty hand reads"))
        said = label->text().toStdString();
    return panel().controller().session()->hasZero() || said.find("no zero") != std::string::npos;
  };
  emit window().findChild<TodayPage*>()->zeroRequested();
  EXPECT_TRUE(await(hear)) << (status().last ? status().last->text : "");
  ASSERT_TRUE(panel().controller().session()->hasZero()) << said;
  const SessionOffset& offset = panel().controller().session()->offset();
  EXPECT_EQ(offset.origin, OffsetSource::kEmptyHand);
  EXPECT_TRUE(offset.trusted);
  EXPECT_NEAR(offset.mm, 3.0, 2.0 * offset.sdMm);
  EXPECT_LE(offset.sdMm, 1.0);
  // It opened again: the fingers don't touch any more, and stand.
  ASSERT_TRUE(await([&] { return status().phase == GraspPhase::kIdle; }));
  panel().controller().ask({graspsOf("pen", 1), std::nullopt, "a pen"});
  settle();
  EXPECT_TRUE(answer().offset.contains("empty hand")) << answer().offset.toStdString();
  EXPECT_EQ(panel().controller().session()->adapted().sessionZero->origin, "the connected hand");
}

// A series of a thing that the hand grasps again and again: each grasp becomes a clip by itself,
// the last is taken back.
TEST_F(RecogniseSlowTest, ASeriesIsCapturedWhileTheHandGrasps) {
  const auto await = [](const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 60'000);
  };
  const auto folder = folder_ / "objects";
  std::filesystem::create_directories(folder);
  testing::writeFile(
      folder_ / "series.json",
      R"({"objects": [{"shape": "cylinder", "size_mm": [14, 140], "stiffness_n_per_mm3": 20, "friction": 0.6, "mass_kg": 0.02,
          "pose": {"position_mm": [19.05, 0, 150], "rotation_deg": [0, 90, 0]}}],
          "hand": {"preshape": "pinch-parallel"},
          "script": [{"at_s": 1.5, "grasp": {"velocity_deg_per_s": 40}}, {"at_s": 7, "release": {"velocity_deg_per_s": 40}},
                     {"at_s": 11, "grasp": {"velocity_deg_per_s": 40}}, {"at_s": 17, "release": {"velocity_deg_per_s": 40}},
                     {"at_s": 21, "grasp": {"velocity_deg_per_s": 40}}, {"at_s": 27, "release": {"velocity_deg_per_s": 40}}]})");
  window().docks().show("Recognise");
  panel().teaching().setFolder(folder);
  settle();
  Connection connection;
  connection.kind = Connection::Kind::kEmulated;
  connection.scene = QString::fromStdString((folder_ / "series.json").string());
  connection.sceneScriptRuns = true;
  window().state().connectTo(connection);
  ASSERT_TRUE(await([&] { return window().state().displayed.isLive(); }));
  panel().showPage("Teach");
  find<QLineEdit>("teachObject")->setText("thick pen");
  ASSERT_TRUE(await([&] { return find<QPushButton>("teachCapture")->isEnabled(); }));
  find<QPushButton>("teachCapture")->click();
  const auto& clips = panel().teaching().clips();
  ASSERT_TRUE(await([&] { return clips.size() >= 2; })) << clips.size();
  find<QPushButton>("teachCapture")->click();  // Stop
  settle();
  std::set<std::filesystem::path> files;
  for (const TrainingClip& clip : clips) {
    EXPECT_EQ(clip.object, "thick pen");
    EXPECT_GT(clip.seconds, 2.0);
    EXPECT_GT(clip.quality, 0.0);
    EXPECT_LE(clip.quality, 1.0);
    ASSERT_EQ(clip.state, TrainingClip::State::kAccepted) << clip.problem.toStdString();
    EXPECT_EQ(clip.path.parent_path(), folder / "thick_pen");
    files.insert(clip.path);
    // What lies there is one whole grasp.
    EXPECT_EQ(findPinches(openRecording(clip.path), FeatureSet::kBest).size(), 1u);
  }
  EXPECT_EQ(files.size(), 2u) << "one does not replace the other";
  EXPECT_EQ(find<FiguresTable>("teachClips")->rowCount(), 2);
  EXPECT_EQ(find<FiguresTable>("teachObjects")->item(0, 1)->text(), "2");
  const auto newest = clips[1].path;
  find<QPushButton>("teachAct")->click();
  EXPECT_FALSE(std::filesystem::exists(newest)) << "undone,";
  EXPECT_TRUE(std::filesystem::exists(clips[1].path)) << "not deleted";
  EXPECT_TRUE(std::filesystem::exists(clips[0].path));
  window().state().live.end();
  EXPECT_TRUE(await([&] { return window().state().live.state() == LiveController::State::kNone; }));
}

}  // namespace
}  // namespace palpate::gui::recognise_slow_test
