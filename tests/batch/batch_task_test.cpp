#include "palpate/batch/batch_task.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/signal_rows.h"
#include "palpate/slip/slip_rows.h"

#include "testing/testing.h"

namespace palpate::batch_task_test {
namespace {

std::string csvOf(ResultTable& table) {
  std::string csv;
  writeTableText(table, {}, [&](const std::string& text) { csv += text; });
  return csv;
}

class BatchTasks : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "in/golf_ball/day");
    item_ = {.source = folder_ / "in/golf_ball/day/a.palpate", .root = folder_ / "in"};
    saveRecording(synthesize({.durationS = 4.0, .grasps = 1}), {}, item_.source);
  }
  std::string made(const BatchTask& task, const char* name) {
    item_.target = folder_ / name;
    task.work(item_, Overwrite::kRefuse, {}, 1);
    return testing::readFile(item_.target);
  }
  std::string refusalOf(const BatchTask& task) {
    try {
      made(task, "refused.csv");
    } catch (const Error& error) {
      EXPECT_FALSE(std::filesystem::exists(folder_ / "refused.csv"));
      return error.what();
    }
    return {};
  }
  testing::TemporaryFolder folder_;
  BatchItem item_;
};

TEST_F(BatchTasks, ConvertsToEveryForm) {
  for (const std::string& ending : recordingEndings()) {
    const std::string name = "converted" + ending;
    const std::filesystem::path expected = folder_ / ("expected" + ending);
    const Profile profile = openRecording(item_.source);
    saveRecording(profile,
                  {},
                  expected,
                  Overwrite::kRefuse,
                  {},
                  exportExtras({}, item_.source, expected, profile, {}));
    EXPECT_FALSE(made(convertTask(), name.c_str()).empty()) << ending;
    if (ending == ".palpate") continue;  // it holds the time of writing
    EXPECT_TRUE(testing::readFile(folder_ / name) == testing::readFile(expected)) << ending;
  }
  EXPECT_THROW(made(convertTask(), "converted.txt"), FileError);
}

// A file for each grasp; a second run makes only what is missing or of an earlier state.
TEST_F(BatchTasks, GraspsAreResumed) {
  namespace fs = std::filesystem;
  const fs::path source = folder_ / "in/golf_ball/day/b.palpate";
  saveRecording(synthesize({.durationS = 24.0, .grasps = 3}), {}, source);
  const GraspTemplate names(folder_ / "{out}", "{name}_{n}.csv");
  const auto run = [&](const ConvertOptions& options = {}) {
    const BatchPlan plan = planBatch({source}, names.planned());
    const BatchReport report =
        runBatch(plan, graspsTask(names, options), {.threads = 2, .resume = true});
    return report.results.at(0);
  };
  using State = BatchResult::State;
  const BatchResult first = run();
  EXPECT_EQ(first.state, State::kDone) << first.text;
  EXPECT_EQ(first.text, source.string() + ": 3 grasps");
  const auto file = [&](int number) {
    return folder_ / "{out}" / ("b_0" + std::to_string(number) + ".csv");
  };
  for (int i = 1; i <= 3; ++i) ASSERT_TRUE(fs::exists(file(i))) << file(i);
  EXPECT_EQ(run().state, State::kSkipped);
  // One is gone: all are made again.
  const std::string second = testing::readFile(file(2));
  fs::remove(file(2));
  EXPECT_EQ(run().state, State::kDone);
  EXPECT_EQ(testing::readFile(file(2)), second);
  // Another choice: the files that were made are replaced.
  EXPECT_EQ(run({.choices = {.unitsRow = true}}).state, State::kDone);
  EXPECT_NE(testing::readFile(file(2)), second);
  // What a person has changed since is kept.
  testing::writeFile(file(3), "mine");
  EXPECT_EQ(run().state, State::kFailed);
  EXPECT_EQ(testing::readFile(file(3)), "mine");
  // So is a file that no run has made.
  fs::remove(file(3));
  ASSERT_EQ(run().state, State::kDone);
  saveRecording(synthesize({.durationS = 32.0, .grasps = 4}), {}, source, Overwrite::kReplace);
  testing::writeFile(file(4), "mine");
  const BatchResult refused = run();
  EXPECT_EQ(refused.state, State::kFailed);
  EXPECT_NE(refused.text.find("b_04.csv"), std::string::npos) << refused.text;
  EXPECT_EQ(testing::readFile(file(4)), "mine");
  fs::remove(file(4));
  EXPECT_EQ(run().text, source.string() + ": 4 grasps");
  // Fewer grasps leave a file over.
  saveRecording(synthesize({.durationS = 24.0, .grasps = 3}), {}, source, Overwrite::kReplace);
  EXPECT_EQ(run().text, source.string() + ": 3 grasps; 1 file of an earlier run left over");
  EXPECT_TRUE(fs::exists(file(4)));
}

TEST_F(BatchTasks, WithoutAGraspNothingIsMade) {
  const std::filesystem::path source = folder_ / "in/still.palpate";
  saveRecording(synthesize({.durationS = 4.0, .grasps = 0}), {}, source);
  const GraspTemplate names(folder_ / "out", "{name}_{n}.palpate");
  const BatchReport report = runBatch(planBatch({source}, names.planned()), graspsTask(names), {});
  EXPECT_EQ(report.results.at(0).state, BatchResult::State::kFailed);
  EXPECT_NE(report.results.at(0).text.find("has no grasp"), std::string::npos);
}

TEST_F(BatchTasks, SignalsAreTheRowsOfTheRecording) {
  const Profile profile = openRecording(item_.source);
  EXPECT_TRUE(made(signalsTask({.matrix = 1}), "s.csv") ==
              csvOf(*signalTable(profile, {.matrix = 1})));
  const Json json = Json::parse(made(signalsTask({.matrix = 1}), "s.json"));
  EXPECT_EQ(json.at("rows").size(), profile.numFrames());
  EXPECT_NE(refusalOf(signalsTask({.matrix = 6})).find("has no matrix 6, only 0..5"),
            std::string::npos);
  std::filesystem::remove(item_.source);  // vanished since it was found
  EXPECT_NE(refusalOf(signalsTask({})).find("a.palpate"), std::string::npos);
  const std::vector<std::string> median = {"median"};
  EXPECT_THROW(signalsTask({.smooth = parseRecipe(median)}), std::invalid_argument);
}

TEST_F(BatchTasks, UnitsStandInTheSecondRow) {
  const auto secondRow = [](const std::string& text) {
    const std::size_t begin = text.find('\n') + 1;
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  EXPECT_EQ(secondRow(made(signalsTask({.unitsRow = true}), "u.csv")),
            ",ms,,counts,counts,counts,counts,counts,taxels,mm^2");
  EXPECT_EQ(secondRow(made(slipTask({.unitsRow = true}), "v.csv")),
            ",ms,,taxels,,taxels,taxels,taxels,taxels,,deg,deg,deg,,,,,,,");
  EXPECT_EQ(secondRow(made(slipTask({.segments = true, .unitsRow = true}), "w.csv")),
            ",,ms,ms,,taxels,deg,");
  EXPECT_EQ(secondRow(made(convertTask({.choices = {.unitsRow = true}}), "x.csv")),
            ",ms,,,,counts,us");
  EXPECT_NE(signalsTask({.unitsRow = true}).options, signalsTask({}).options);
  EXPECT_NE(slipTask({.unitsRow = true}).options, slipTask({}).options);
  EXPECT_NE(convertTask({.choices = {.unitsRow = true}}).options, convertTask().options);
}

TEST_F(BatchTasks, FiltersAreApplied) {
  const std::vector<std::string> median = {"median"};
  const Recipe recipe = parseRecipe(median);
  EXPECT_FALSE(made(signalsTask({.filters = recipe}), "f.csv") ==
               made(signalsTask({}), "plain.csv"));
  EXPECT_NE(signalsTask({.filters = recipe}).options, signalsTask({}).options);
}

TEST_F(BatchTasks, SlipIsTheRowsOfTheRecording) {
  const Profile profile = openRecording(item_.source);
  EXPECT_TRUE(made(slipTask({}), "slip.csv") == csvOf(*slipTable(profile, {})));
  SlipRowsOptions late;
  late.pass.detector.reference = SlipReference::kGiven;
  late.pass.referenceFrame = profile.numFrames();
  EXPECT_NE(refusalOf(slipTask(late)).find("to be the reference"), std::string::npos);
  EXPECT_NE(slipTask(late).options, slipTask({}).options);
  EXPECT_NE(slipTask({.segments = true}).options, slipTask({}).options);
}

TEST_F(BatchTasks, FeaturesHaveTheClassOfTheFolder) {
  const std::string table = made(featuresTask(FeatureSet::kStatistics), "f.csv");
  EXPECT_EQ(table.rfind("class,file,begin,end,initial_frame,end_frame,", 0), 0U) << table;
  EXPECT_NE(table.find("\ngolf ball," + item_.source.string() + ","), std::string::npos) << table;
  const std::string withUnits = made(featuresTask(FeatureSet::kStatistics, {}, true), "u.csv");
  const std::string head = table.substr(0, table.find('\n'));
  EXPECT_EQ(withUnits.rfind(head + "\n,,,", 0), 0U) << "features have no units";
  EXPECT_NE(featuresTask(FeatureSet::kStatistics, {}, true).options,
            featuresTask(FeatureSet::kStatistics).options);
  item_.source = folder_ / "in/golf_ball/empty.palpate";
  saveRecording(synthesize({.durationS = 2.0, .grasps = 0}), {}, item_.source);
  EXPECT_NE(refusalOf(featuresTask(FeatureSet::kStatistics)).find("empty.palpate"),
            std::string::npos);
}

}  // namespace
}  // namespace palpate::batch_task_test
