#include <filesystem>

#include "palpate/core/hash.h"
#include "palpate/core/json.h"
#include "palpate/recognition/trained_model.h"

#include "commands/recognition_folder.h"

namespace palpate::train_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;
using testing::saveGrasps;
using testing::saveThings;
using testing::TemporaryFolder;

TEST(TrainCommand, WritesAModelThatKnowsWhatItIsMadeFrom) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 8, 1);
  const auto result = palpate({"train", folder / "all", "-o", folder / "m.json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json report = Json::parse(result.out);
  EXPECT_EQ(report.at("classifier").asString(), "gauss") << "of the set best";
  EXPECT_EQ(report.at("classes").size(), 4u);
  EXPECT_EQ(report.at("classes").at(1).at("name").asString(), "golf ball");
  EXPECT_EQ(report.at("classes").at(1).at("grasps").asInteger(), 8);
  const TrainedModel model = loadModel(folder / "m.json");
  EXPECT_EQ(model.set, FeatureSet::kBest);
  EXPECT_FALSE(model.programVersion.empty());
  ASSERT_EQ(model.inputs.size(), 4u);
  EXPECT_EQ(model.inputs[0].sha256, sha256OfFile(folder / "all/bottle/a.dsa"));
  EXPECT_EQ(model.offset.origin, OffsetSource::kNone);
  EXPECT_EQ(model.offset.mm, 0.0);
  expectOneLineError(palpate({"train", folder / "all", "-o", folder / "m.json"}), 1, {"m.json"});
  EXPECT_EQ(palpate({"train", folder / "all", "-o", folder / "m.json", "--force"}).exitCode, 0);
}

TEST(TrainCommand, ChoosesByCrossValidationWhatIsLeftOpen) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 8, 1);
  const auto open = palpate({"train", folder / "all", "-o", folder / "a.json", "--set", "study"});
  ASSERT_EQ(open.exitCode, 0) << open.err;
  EXPECT_GT(Json::parse(open.out).at("options").at("chosen_from").size(), 5u);
  const auto told = palpate({"train",
                             folder / "all",
                             "-o",
                             folder / "b.json",
                             "--classifier",
                             "svm",
                             "--lda",
                             "3",
                             "--c",
                             "10",
                             "--shrinkage",
                             "auto"});
  ASSERT_EQ(told.exitCode, 0) << told.err;
  const Json options = Json::parse(told.out).at("options");
  EXPECT_EQ(options.at("classifier").asString(), "svm");
  EXPECT_EQ(options.at("lda").asInteger(), 3);
  EXPECT_EQ(options.at("c").asDouble(), 10.0);
  EXPECT_TRUE(loadModel(folder / "b.json").pipeline.discriminant.has_value());
  EXPECT_GT(loadModel(folder / "b.json").pipeline.discriminant->shrinkage, 0.0);
}

TEST(TrainCommand, SaysThatASessionsModelRemembersThePose) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 6, 1);
  const auto result =
      palpate({"train", folder / "all", "-o", folder / "m.json", "--set", "session"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.err.find(sessionSetWarning()), std::string::npos) << result.err;
}

TEST(TrainCommand, RefusesWhatTeachesNothing) {
  const TemporaryFolder folder;
  saveGrasps(folder / "one/pen/a.dsa", 10.0, 5, 1);
  expectOneLineError(
      palpate({"train", folder / "one", "-o", folder / "m.json"}), 1, {"only one class", "pen"});
  saveGrasps(folder / "single/pen/a.dsa", 10.0, 1, 1);
  saveGrasps(folder / "single/box/a.dsa", 20.0, 1, 2);
  expectOneLineError(
      palpate({"train", folder / "single", "-o", folder / "m.json"}), 1, {"no class has more"});
  expectOneLineError(
      palpate({"train", folder / "nowhere", "-o", folder / "m.json"}), 1, {"nowhere"});
  expectOneLineError(palpate({"train", folder / "one"}), 2, {"-o"});
  expectOneLineError(palpate({"train",
                              folder / "one",
                              "-o",
                              folder / "m.json",
                              "--lda",
                              "2",
                              "--classifier",
                              "gauss"}),
                     2,
                     {"--lda"});
  EXPECT_FALSE(std::filesystem::exists(folder / "m.json"));
}

TEST(TrainCommand, ABadFileDoesNotStopTheOthers) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 6, 1);
  testing::writeFile(folder / "all/pen/broken.dsa", "BZh9 nothing");
  const auto result = palpate({"train", folder / "all", "-o", folder / "m.json"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("broken.dsa"), std::string::npos);
  EXPECT_EQ(loadModel(folder / "m.json").inputs.size(), 4u);
}

TEST(TrainCommand, InterruptedItLeavesNoModel) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 60, 1);
  testing::writeFile(folder / "kept.json", "precious");
  for (const char* out : {"m.json", "kept.json"}) {
    testing::BackgroundProgram program(PALPATE_PROGRAM,
                                       {"train",
                                        folder / "all",
                                        "--set",
                                        "study",
                                        "--classifier",
                                        "svm",
                                        "--force",
                                        "-o",
                                        folder / out});
    EXPECT_EQ(testing::interruptAtWork(program), 1) << program.out();
    EXPECT_EQ(program.err(), "palpate: cancelled\n");
    EXPECT_EQ(program.out(), "");
  }
  EXPECT_EQ(testing::readFile(folder / "kept.json"), "precious");
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path()))
    ++entries;
  EXPECT_EQ(entries, 2u) << "half a model, or a temporary file";
}

TEST(TrainCommand, KeepsTheZeroOfTheEmptyHand) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 6, 1);
  testing::saveTouches(folder / "touch.dsa", -1.0, 3);
  const auto result = palpate({"train",
                               folder / "all",
                               "-o",
                               folder / "m.json",
                               "--empty-hand-zero",
                               folder / "touch.dsa"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out).at("empty_hand_zero").at("touches").asInteger(), 3);
  const TrainedModel model = loadModel(folder / "m.json");
  ASSERT_TRUE(model.trainingZero);
  EXPECT_EQ(model.trainingZero->origin, "touch.dsa");
  EXPECT_EQ(model.trainingZero->sha256, sha256OfFile(folder / "touch.dsa"));
  EXPECT_FALSE(model.sessionZero);
}

}  // namespace
}  // namespace palpate::train_command_test
