// What the emulated hand grasps by itself, named while it is held: the model that comes with the program.
#include <QPushButton>
#include <QTest>

#include "gui/today_page.h"
#include "recognise_fixture.h"

namespace palpate::gui {
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
  window().connectTo(connection);
  const auto status = [&] { return window().live().source()->control->status(); };
  ASSERT_TRUE(await([&] { return window().liveShown() && status().cannotReact.empty(); }));
  const auto ask = [&] { emit window().findChild<TodayPage*>()->zeroAsked(); };
  const auto closed = [&] {
    return status().phase == GraspPhase::kIdle && status().last &&
           status().last->outcome == GraspOutcome::kLimitReached;
  };
  ask();
  ASSERT_TRUE(await([&] { return status().phase == GraspPhase::kClosing; }));
  ASSERT_TRUE(await(closed)) << status().last->text;
  QTest::mouseClick(find<QPushButton>("stopHand"), Qt::LeftButton);
  const std::int64_t endedUs = status().last->endUs;
  QTest::qWait(4000);  // longer than it would have held
  EXPECT_EQ(status().phase, GraspPhase::kIdle);
  EXPECT_EQ(status().last->endUs, endedUs) << "it moved after a stop";
}

}  // namespace
}  // namespace palpate::gui
