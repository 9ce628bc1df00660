#include "palpate/emulator/scene.h"

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"

#include "testing/testing.h"

namespace palpate::testing::scene_test {
namespace {

std::string faultOf(const std::string& json) {
  try {
    parseScene(json, "scene.json");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

TEST(Scene, ReadsAllThereIs) {
  const Scene scene = parseScene(R"({
    "objects": [
      {"shape": "cylinder", "size_mm": [50, 120], "stiffness_n_per_mm3": 2.5, "friction": 0.4,
       "mass_kg": 0.3, "pose": {"position_mm": [1, -2, 140.5], "rotation_deg": [90, 0, 0]}},
      {"shape": "sphere", "size_mm": 30, "fixed": true}],
    "hand": {"preshape": "cylindrical", "close": 0.25},
    "script": [
      {"at_s": 3, "load": {"object": 1, "force_n": [0, 0, -4], "torque_nmm": [0, 0, 9], "duration_s": 2}},
      {"at_s": 1, "grasp": {"preshape": "parallel", "close": 0.8, "velocity_deg_per_s": 20}},
      {"at_s": 4, "move": {"object": 1, "by_mm": [1, 2, 3], "duration_s": 0.5}},
      {"at_s": 5, "turn": {"by_deg": [0, 0, 30]}},
      {"at_s": 6, "temperature": {"ambient_c": 45}},
      {"at_s": 7, "threshold": {"matrix": 2, "counts": 60}},
      {"at_s": 8, "sensitivity": {"value": 1}},
      {"at_s": 9, "release": {}}],
    "description": "Two things"})",
                                 "somewhere/mine.json");
  EXPECT_EQ(scene.name, "mine");
  EXPECT_EQ(scene.description, "Two things");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].shape.kind, ShapeKind::kCylinder);
  EXPECT_EQ(scene.objects[0].shape.sizeMm, Eigen::Vector3d(50, 50, 120));
  EXPECT_EQ(scene.objects[0].stiffnessNPerMm3, 2.5);
  EXPECT_EQ(scene.objects[0].friction, 0.4);
  EXPECT_EQ(scene.objects[0].massKg, 0.3);
  EXPECT_EQ(scene.objects[0].positionMm, Eigen::Vector3d(1, -2, 140.5));
  // 90 degrees about x rotate its axis z to -y.
  EXPECT_LT(
      (scene.objects[0].rotation * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitY()).norm(),
      1e-12);
  EXPECT_FALSE(scene.objects[0].fixed);
  EXPECT_TRUE(scene.objects[1].fixed);
  EXPECT_EQ(scene.preshape, "cylindrical");
  EXPECT_EQ(scene.close, 0.25);
  ASSERT_EQ(scene.script.size(), 8u);
  EXPECT_EQ(scene.script[0].atS, 1.0) << "in order of time";
  const auto& grasp = std::get<GraspAction>(scene.script[0].action);
  EXPECT_EQ(*grasp.preshape, "parallel");
  EXPECT_EQ(grasp.velocityDegPerS, 20.0);
  const auto& load = std::get<LoadObject>(scene.script[1].action);
  EXPECT_EQ(load.object, 1u);
  EXPECT_EQ(load.torqueNmm.z(), 9.0);
  EXPECT_EQ(std::get<SetSceneThreshold>(scene.script[5].action).matrix, 2u);
  EXPECT_FALSE(std::get<SetSceneSensitivity>(scene.script[6].action).matrix);
}

TEST(Scene, SaysWhichFieldIsWrong) {
  const auto expectFault = [](const std::string& json, const std::string& place) {
    const std::string fault = faultOf(json);
    EXPECT_NE(fault.find("scene.json"), std::string::npos) << fault;
    EXPECT_NE(fault.find(place), std::string::npos) << fault << " should name " << place;
  };
  expectFault("{", "scene.json");
  expectFault("[]", "isn't a JSON object");
  expectFault(R"({"object": []})", "unknown key 'object'");
  expectFault(R"({"description": 3})", "description isn't a text");
  expectFault(R"({"objects": [{"shape": "banana", "size_mm": 3}]})", "objects[0].shape");
  expectFault(R"({"objects": [{"shape": "sphere"}]})", "size_mm");
  expectFault(R"({"objects": [{"shape": "box", "size_mm": [1, 2]}]})", "three lengths");
  expectFault(R"({"objects": [{"shape": "sphere", "size_mm": -3}]})", "objects[0].size_mm");
  expectFault(R"({"objects": [{"shape": "sphere", "size_mm": 3, "friction": "high"}]})",
              "friction");
  expectFault(
      R"({"objects": [{"shape": "sphere", "size_mm": 3, "pose": {"position_mm": [1, 2]}}]})",
      "position_mm");
  expectFault(R"({"objects": [{"shape": "sphere", "size_mm": 3, "fixed": 1}]})",
              "objects[0].fixed");
  expectFault(R"({"hand": {"preshape": "fist"}})", "hand.preshape");
  expectFault(R"({"hand": {"close": 1.5}})", "hand.close");
  expectFault(R"({"script": [{"grasp": {}}]})", "at_s");
  expectFault(R"({"script": [{"at_s": 1}]})", "script[0]");
  expectFault(R"({"script": [{"at_s": 5, "release": {}}], "repeat_s": 4})", "repeat_s");
  expectFault(R"({"script": [{"at_s": 1, "dance": {}}]})", "dance");
  expectFault(R"({"script": [{"at_s": 1, "move": {}}]})", "needs an object");
  expectFault(R"({"script": [{"at_s": 1, "threshold": {"matrix": 6}}]})", "matrix");
  expectFault(R"({"script": [{"at_s": -1, "release": {}}]})", "at_s");
  expectFault(R"({"objects": )" + std::string(600, '[') + std::string(600, ']') + "}",
              "scene.json");
}

TEST(Scene, AllThatComeWithTheProgramLoad) {
  const auto folder = dataFolder() / "scenes";
  const std::vector<std::string> names = sceneNames(folder);
  for (const char* promised :
       {"empty", "ball", "foam_ball", "bottle", "pen", "box", "slipping_handle"})
    EXPECT_NE(std::find(names.begin(), names.end(), promised), names.end()) << promised;
  for (const std::string& name : names) EXPECT_EQ(loadScene(name, folder).name, name);
}

// A scene is one of a certain hand: its preshapes, matrices and velocities.
TEST(Scene, AnotherHandHasOtherPreshapesAndMatrices) {
  const auto fault = [](const std::string& key, const std::string& json) -> std::string {
    try {
      parseScene(json, "scene.json", builtInHand(key));
    } catch (const FormatError& error) {
      return error.what();
    }
    return "";
  };
  const std::string grasp = R"({"script": [{"at_s": 1, "grasp": {}}]})";
  EXPECT_EQ(fault("parallel_gripper", grasp), "");
  EXPECT_EQ(parseScene("{}", "a.json", builtInHand("parallel_gripper")).preshape, "parallel");
  EXPECT_EQ(parseScene("{}", "a.json", builtInHand("sole")).preshape, "");
  EXPECT_EQ(parseScene("{}", "a.json").preshape, "centrical");
  EXPECT_EQ(fault("parallel_gripper", R"({"hand": {"preshape": "centrical"}})"),
            "scene.json: hand.preshape is wrong: no preshape 'centrical'; there are: parallel");
  EXPECT_EQ(fault("sole", R"({"hand": {"preshape": "parallel"}})"),
            "scene.json: hand.preshape is wrong: the hand 'Sole of a shoe' has no preshapes");
  EXPECT_EQ(fault("sole", grasp),
            "scene.json: script[0].grasp needs preshapes, and the hand 'Sole of a shoe' has none");
  EXPECT_NE(fault("parallel_gripper",
                  R"({"script": [{"at_s": 1, "threshold": {"matrix": 2, "counts": 1}}]})")
                .find("script[0].threshold.matrix"),
            std::string::npos);
  // 4095 counts are the full scale of the gripper, 1023 of the pad.
  const std::string threshold = R"({"script": [{"at_s": 1, "threshold": {"counts": 2000}}]})";
  EXPECT_EQ(fault("parallel_gripper", threshold), "");
  EXPECT_NE(fault("flat_pad_16x16", threshold).find("counts"), std::string::npos);
  // The gripper is faster than any axis of the SDH-2.
  const std::string fast = R"({"script": [{"at_s": 1, "grasp": {"velocity_deg_per_s": 300}}]})";
  EXPECT_EQ(fault("parallel_gripper", fast), "");
  EXPECT_NE(fault("sdh2", fast).find("velocity_deg_per_s"), std::string::npos);
}

// The example on the page docs/notes/emulator.md is a valid scene.
TEST(Scene, TheExampleOfTheDocumentIsOne) {
  const std::string page = readFile(dataFolder().parent_path() / "docs/notes/emulator.md");
  const std::size_t from = page.find("    {\"objects\"");
  ASSERT_NE(from, std::string::npos);
  const Scene scene = parseScene(page.substr(from, page.find("\n\n", from) - from), "emulator.md");
  EXPECT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.script.size(), 2u);
  EXPECT_EQ(scene.repeatS, 16.0);
}

TEST(Scene, AnUnknownNameListsThoseThatExist) {
  try {
    loadScene("moon", dataFolder() / "scenes");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("slipping_handle"), std::string::npos);
  }
  const TemporaryFolder folder;
  EXPECT_THROW(loadScene((folder / "none.json").string(), folder.path()), FileError);
  EXPECT_THROW(loadScene(folder.path().string() + "/", folder.path()), FileError);
  writeFile(folder / "mine.json", "{}");
  EXPECT_TRUE(loadScene((folder / "mine.json").string(), "nowhere").objects.empty());
}

}  // namespace
}  // namespace palpate::testing::scene_test
