// The model that comes with the program, on grasps of the emulated hand that it never saw.
#include <filesystem>

#include "palpate/core/json.h"

#include "commands/palpate_program.h"

namespace palpate::emulated_objects_test {
namespace {
namespace fs = std::filesystem;

using testing::palpate;
using testing::TemporaryFolder;

std::vector<std::string> labelsOf(const TemporaryFolder& folder,
                                  const std::string& scene,
                                  std::vector<bool>* sure = nullptr) {
  const fs::path recording = folder / "grasps.dsa";
  const auto made = palpate({"synthesize",
                             "--force",
                             "--scene",
                             scene,
                             "--grasps",
                             "2",
                             "--seed",
                             "777",
                             "-o",
                             recording});
  EXPECT_EQ(made.exitCode, 0) << made.err;
  const auto result =
      palpate({"classify", testing::dataFolder() / "emulated_objects.json", recording, "--json"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  std::vector<std::string> labels;
  const Json grasps = Json::parse(result.out).at("grasps");
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    labels.push_back(grasps.at(i).at("label").asString());
    if (sure) sure->push_back(grasps.at(i).at("sure").asBool());
  }
  return labels;
}

TEST(EmulatedObjects, AreRecognisedInGraspsThatTheModelNeverSaw) {
  const TemporaryFolder folder;
  for (const char* scene : {"ball", "bottle", "box", "foam_ball", "pen"}) {
    std::string name = scene;
    if (name == "foam_ball") name = "foam ball";
    std::vector<bool> sure;
    EXPECT_EQ(labelsOf(folder, scene, &sure), (std::vector<std::string>{name, name}));
    EXPECT_EQ(sure, (std::vector<bool>{true, true})) << scene;
  }
}

TEST(EmulatedObjects, AnUnknownShapeIsCalledUnknown) {
  const TemporaryFolder folder;
  const auto sceneOf = [&](const char* object, const char* preshape) {
    testing::writeFile(
        folder / "scene.json",
        std::string(
            R"({"objects": [{"stiffness_n_per_mm3": 10, "friction": 0.7, "mass_kg": 0.1, )") +
            object + R"(}], "hand": {"preshape": ")" + preshape +
            R"("}, "script": [{"at_s": 1.5, "grasp": {"velocity_deg_per_s": 30}}, {"at_s": 9, "release": {}}]})");
    return (folder / "scene.json").string();
  };
  const std::vector<std::string> unknown = {"unknown", "unknown"};
  EXPECT_EQ(
      labelsOf(
          folder,
          sceneOf(
              R"("shape": "cone", "size_mm": [60, 120], "pose": {"position_mm": [19.05, 0, 150]})",
              "pinch-parallel")),
      unknown);
  EXPECT_EQ(
      labelsOf(folder,
               sceneOf(R"("shape": "sphere", "size_mm": 45, "pose": {"position_mm": [0, 0, 145]})",
                       "centrical")),
      unknown);
  EXPECT_EQ(
      labelsOf(
          folder,
          sceneOf(
              R"("shape": "box", "size_mm": [30, 30, 30], "pose": {"position_mm": [19.05, 0, 150]})",
              "pinch-parallel")),
      unknown);
}

}  // namespace
}  // namespace palpate::emulated_objects_test
