// The recognition of the tour says honestly when it is wrong.
#include "commands/demo_recognition.h"

#include <gtest/gtest.h>

#include "palpate/emulator/scene.h"
#include "palpate/emulator/simulated_recording.h"
#include "palpate/recording/dsa_writer.h"

#include "testing/testing.h"

namespace palpate::commands::demo_recognition_test {
namespace {
namespace fs = std::filesystem;

class DemoRecognitionTest : public ::testing::Test {
 protected:
  // A grasp of a scene; `sizeMm` of its object, where it is to be another.
  KnownGrasp recorded(const std::string& scene, const std::string& object, double sizeMm = 0.0) {
    Scene played = loadScene(scene, testing::dataFolder() / "scenes");
    if (sizeMm > 0.0) played = parseScene(sphereOf(sizeMm), "sphere.json");
    const fs::path file = folder_ / (scene + std::to_string(++count_) + ".dsa");
    writeDsa(simulateRecording(played), file);
    return {file, object};
  }
  static std::string sphereOf(double sizeMm) {
    return R"({"objects": [{"shape": "sphere", "size_mm": )" + std::to_string(sizeMm) +
           R"(, "stiffness_n_per_mm3": 10, "friction": 0.7, "pose": {"position_mm": [0, 0, 145]}}],
               "hand": {"preshape": "centrical"},
               "script": [{"at_s": 1.5, "grasp": {}}, {"at_s": 9, "release": {}}]})";
  }

  const testing::TemporaryFolder folder_;
  const TrainedModel model_ = loadModel(testing::dataFolder() / "emulated_objects.json");
  int count_ = 0;
};

TEST_F(DemoRecognitionTest, NamesWhatItWasTaughtAndCallsOtherThingsUnknown) {
  const DemoRecognition asked = askModel(
      model_, {recorded("pen", "pen"), recorded("ball", "ball"), recorded("ball", "marble", 45.0)});
  ASSERT_EQ(asked.grasps.size(), 3u);
  EXPECT_EQ(asked.grasps[0].called, "pen");
  EXPECT_EQ(asked.grasps[1].called, "ball");
  EXPECT_EQ(asked.grasps[1].rank, 1u);
  EXPECT_GT(asked.grasps[1].probability, 0.97);
  EXPECT_FALSE(asked.grasps[2].inTraining);
  EXPECT_FALSE(asked.grasps[2].rank);
  EXPECT_EQ(asked.grasps[2].called, "unknown");
  EXPECT_EQ(asked.numInTraining(), 2u);
  EXPECT_EQ(asked.numRight(true), 2u);
  EXPECT_EQ(asked.numRight(false), 1u);
  const std::string text = demoRecognitionText(asked);
  EXPECT_NE(text.find("2 of 2"), std::string::npos) << text;
  EXPECT_NE(text.find("the marble, which was not trained, is called unknown"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("wrong"), std::string::npos) << text;
}

TEST_F(DemoRecognitionTest, SaysWhatIsWrong) {
  // The ball was exchanged, the pen called a bottle by whoever recorded it, and of the box nothing
  // was grasped.
  const DemoRecognition asked = askModel(model_,
                                         {recorded("ball", "ball", 45.0),
                                          recorded("pen", "bottle"),
                                          recorded("empty", "box"),
                                          recorded("pen", "marble")});
  EXPECT_EQ(asked.numInTraining(), 3u);
  EXPECT_EQ(asked.numRight(true), 0u);
  EXPECT_EQ(asked.numRight(false), 0u);
  EXPECT_EQ(asked.grasps[1].called, "pen");
  ASSERT_TRUE(asked.grasps[1].rank);
  EXPECT_GT(*asked.grasps[1].rank, 1u);
  EXPECT_LT(asked.grasps[1].probability, 0.05);
  EXPECT_FALSE(asked.grasps[2].prediction);
  const std::string text = demoRecognitionText(asked);
  for (const char* part : {"0 of 3",
                           "wrong: the ball is called unknown; its own name is at rank",
                           "wrong: the bottle is called pen; its own name is at rank",
                           "wrong: the box could not be asked about: ",
                           "wrong: the marble is called pen"})
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  EXPECT_EQ(text.find("surely"), std::string::npos) << text;

  const Json json = demoRecognitionJson(asked, model_, "model.json");
  EXPECT_EQ(json.at("right").asInteger(), 0);
  EXPECT_EQ(json.at("taught").asInteger(), 3);
  ASSERT_EQ(json.at("grasps").size(), 4u);
  const Json bottle = json.at("grasps").at(1);
  EXPECT_EQ(bottle.at("file").asString(), asked.grasps[1].known.file.filename().string());
  EXPECT_EQ(bottle.at("label").asString(), "pen");
  EXPECT_EQ(bottle.at("object").asString(), "bottle");
  EXPECT_FALSE(bottle.at("right").asBool());
  EXPECT_FALSE(json.at("grasps").at(2).at("trouble").asString().empty());
  EXPECT_TRUE(json.at("grasps").at(2).at("label").isNull());
}

}  // namespace
}  // namespace palpate::commands::demo_recognition_test
