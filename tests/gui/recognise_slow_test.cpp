// What the emulated hand grasps by itself, named while it is held: the model that comes with the program.
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

}  // namespace
}  // namespace palpate::gui
