#include "palpate/core/json.h"

#include "commands/recognition_folder.h"

namespace palpate::evaluate_command_test {
namespace {

using testing::expectOneLineError;
using testing::kOneDayUs;
using testing::kPinchStartUs;
using testing::palpate;
using testing::saveThings;
using testing::TemporaryFolder;

TEST(EvaluateCommand, PrintsWhatTheInterfacePromises) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 10, 1);
  for (const char* protocol : {"S", "B"}) {
    const auto result = palpate({"evaluate",
                                 folder / "all",
                                 "--set",
                                 "study",
                                 "--lda",
                                 "3",
                                 "--classifier",
                                 "svm",
                                 "--protocol",
                                 protocol,
                                 "--seed",
                                 "3"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_GT(json.at("accuracy_mean").asDouble(), 0.9);
    EXPECT_TRUE(json.at("accuracy_sd").isNumber());
    ASSERT_EQ(json.at("classes").size(), 4u);
    for (const char* key : {"precision", "recall", "f", "support"})
      EXPECT_TRUE(json.at("classes").at(0).at(key).isNumber()) << key;
    EXPECT_EQ(json.at("confusion").size(), 4u);
    EXPECT_EQ(json.at("confusion").at(0).size(), 4u);
  }
}

TEST(EvaluateCommand, TheSeedDecidesAndNothingElse) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 6, 1);
  const auto run = [&](const char* seed) {
    return palpate(
               {"evaluate", folder / "all", "--set", "diameter", "--splits", "4", "--seed", seed})
        .out;
  };
  EXPECT_EQ(run("5"), run("5"));
  EXPECT_NE(run("5"), run("6"));
}

TEST(EvaluateCommand, AddsCurvesAndWeightsWhenAsked) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 8, 1);
  const auto result = palpate({"evaluate",
                               folder / "all",
                               "--splits",
                               "3",
                               "--confidence",
                               "--weights",
                               "--learning-curve",
                               "--eliminate"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("pipeline").at("classifier").asString(), "gauss") << "best, as train";
  EXPECT_GT(json.at("coverage").size(), 0u);
  EXPECT_TRUE(json.at("calibration_error").isNumber());
  EXPECT_GT(json.at("weights").size(), 5u);
  EXPECT_EQ(json.at("learning_curve").at(0).at("per_class").asInteger(), 2);
  EXPECT_EQ(json.at("elimination").size(), json.at("weights").size());
}

TEST(EvaluateCommand, ExaminesAModelOnAnotherDay) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 10, 1);
  saveThings(folder / "later", 6, 50, -2.0, kPinchStartUs + 70 * kOneDayUs);
  ASSERT_EQ(palpate({"train", folder / "all", "-o", folder / "m.json"}).exitCode, 0);
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"evaluate", "--model", folder / "m.json", folder / "later"});
    const auto result = palpate(more);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return Json::parse(result.out);
  };
  const Json fresh = with({});
  for (const char* key : {"accuracy", "interval", "top3", "coverage", "classes", "confusion"})
    EXPECT_TRUE(fresh.contains(key)) << key;
  EXPECT_EQ(fresh.at("coverage").asDouble(), 0.0) << "not sure without an offset";
  EXPECT_TRUE(fresh.at("accuracy_when_sure").isNull());
  const Json batch = with({"--session-offset", "batch"});
  EXPECT_NEAR(batch.at("sessions").at(0).at("mm").asDouble(), -2.0, 0.8);
  EXPECT_GT(batch.at("accuracy").asDouble(), 0.95);
  const Json adapted = with({"--adapt", "1"});
  EXPECT_EQ(adapted.at("grasps").asInteger(), 20);
  EXPECT_EQ(adapted.at("adapted_by").asInteger(), 4);
  EXPECT_EQ(adapted.at("sessions").at(0).at("origin").asString(), "references");
}

TEST(EvaluateCommand, RefusesWhatDoesNotGoTogether) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 4, 1);
  const std::string all = folder / "all";
  expectOneLineError(palpate({"evaluate", all, "--adapt", "1"}), 2, {"--adapt", "--model"});
  expectOneLineError(palpate({"evaluate", all, "--set", "worst"}), 2, {"--set"});
  expectOneLineError(palpate({"evaluate", all, "--protocol", "X"}), 2, {"--protocol"});
  expectOneLineError(palpate({"evaluate", all, "--shrinkage", "2"}), 2, {"--shrinkage"});
  expectOneLineError(palpate({"evaluate", all, "--model", "m.json", "--lda", "3"}), 2, {"--lda"});
  expectOneLineError(
      palpate({"evaluate", all, "--model", "m.json", "--session-offset", "wide"}), 2, {"wide"});
  expectOneLineError(palpate({"evaluate", all, "--model", folder / "no.json"}), 1, {"no.json"});
  expectOneLineError(palpate({"evaluate", folder / "nowhere"}), 1, {"nowhere"});
}

TEST(EvaluateCommand, InterruptedItSaysNothingHalf) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 10, 1);
  testing::BackgroundProgram program(PALPATE_PROGRAM,
                                     {"evaluate", folder / "all", "--splits", "100000"});
  EXPECT_EQ(testing::interruptAtWork(program), 1);
  EXPECT_EQ(program.err(), "palpate: cancelled\n");
  EXPECT_EQ(program.out(), "");
}

// Four things 8 mm apart, each a stranger to the other three in turn; 70 days later all read 3 mm
// too wide.
TEST(EvaluateCommand, TellsHowWellUnknownObjectsAreTold) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 12, 1);
  saveThings(folder / "later", 6, 60, 3.0, testing::kPinchStartUs + 70 * testing::kOneDayUs);
  const auto result =
      palpate({"evaluate", folder / "all", "--unknown", "--later", folder / "later"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json unknown = Json::parse(result.out).at("unknown");
  EXPECT_GT(unknown.at("auroc").asDouble(), 0.95);
  EXPECT_EQ(unknown.at("unknown_grasps").asInteger(), 48);
  EXPECT_EQ(unknown.at("classes").size(), 4u);
  const Json later = unknown.at("another_day");
  EXPECT_EQ(later.at("sessions").asInteger(), 1);
  EXPECT_GT(later.at("offset_known").at("auroc").asDouble(), 0.9);
  EXPECT_EQ(later.at("offset_from_batch").at("known_grasps").asInteger(), 24);
  EXPECT_TRUE(later.at("offset_unknown").at("auroc").isNumber());
  const auto svm =
      palpate({"evaluate", folder / "all", "--unknown", "--classifier", "svm", "--lda", "2", "-q"});
  EXPECT_EQ(svm.exitCode, 0) << svm.err;
  expectOneLineError(
      palpate({"evaluate", folder / "all", "--later", folder / "later"}), 2, {"--unknown"});
  expectOneLineError(palpate({"evaluate",
                              folder / "all",
                              "--unknown",
                              "--later",
                              folder / "later",
                              "--classifier",
                              "svm"}),
                     2,
                     {"gauss"});
}

}  // namespace
}  // namespace palpate::evaluate_command_test
