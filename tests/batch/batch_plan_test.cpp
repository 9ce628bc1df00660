#include "palpate/batch/batch_plan.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::batch_plan_test {
namespace {

namespace fs = std::filesystem;

std::string refusalOf(const std::string& text) {
  try {
    const BatchTemplate names(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(BatchTemplate, SaysWhatIsWrongWithIt) {
  EXPECT_NE(refusalOf("out/{hand}.csv").find("{hand} isn't known; use {name}"), std::string::npos);
  EXPECT_NE(refusalOf("out/{name.csv").find("brace"), std::string::npos);
  EXPECT_NE(refusalOf("out/name}.csv").find("brace"), std::string::npos);
  EXPECT_NE(refusalOf("out/{{name}}.csv").find("brace"), std::string::npos);
  EXPECT_NE(refusalOf("out/").find("must end in a name"), std::string::npos);
  EXPECT_NE(refusalOf("out/{name}").find("with an ending"), std::string::npos);
  EXPECT_NE(refusalOf("out/{name}.{ending}").find("with an ending"), std::string::npos);
  EXPECT_NE(refusalOf("out/\n{name}.csv").find("control characters"), std::string::npos);
  EXPECT_EQ(refusalOf("out/{name}.csv"), "");
}

TEST(BatchTemplate, FillsItsFields) {
  const BatchNameFields fields{.name = "run 3", .folder = "a/b", .ending = "dsa"};
  EXPECT_EQ(BatchTemplate("out/{name}.csv").pathFor(fields), "out/a/b/run 3.csv");
  EXPECT_EQ(BatchTemplate("out/{folder}/x/{name}_{ending}.csv").pathFor(fields),
            "out/a/b/x/run 3_dsa.csv");
  EXPECT_EQ(BatchTemplate("{folder}_{name}.npz").pathFor(fields), "./a_b_run 3.npz");
  EXPECT_EQ(BatchTemplate("out/{name}.csv").folder(), "out");
  EXPECT_EQ(BatchTemplate("{name}.csv").folder(), ".");
  EXPECT_EQ(BatchTemplate("out/{name}.CSV").ending(), ".CSV");
  // A recording that was given by itself has no folder.
  EXPECT_EQ(BatchTemplate("out/{folder}/{folder}_{name}.csv").pathFor({.name = "x"}), "out/x.csv");
}

TEST(BatchTemplate, AFolderMayHaveBraces) {
  const BatchNameFields fields{.name = "x", .folder = "a"};
  const BatchTemplate names("out/{name}", "sub/{folder}_{name}.csv");
  EXPECT_EQ(names.folder(), "out/{name}/sub");
  EXPECT_EQ(names.pathFor(fields), "out/{name}/sub/a_x.csv");
  EXPECT_EQ(BatchTemplate("/data/{x}", "{name}.csv").pathFor(fields), "/data/{x}/a/x.csv");
  EXPECT_THROW(BatchTemplate("out", "/{name}.csv"), std::invalid_argument);
  EXPECT_THROW(BatchTemplate("out", "../{name}.csv"), std::invalid_argument);
  EXPECT_THROW(BatchTemplate("out", "{hand}.csv"), std::invalid_argument);
}

TEST(BatchTemplate, RefusesNamesThatAreNotAllowed) {
  EXPECT_THROW(BatchTemplate("out/{folder}.csv").pathFor({.name = "x"}), Error);
  EXPECT_THROW(BatchTemplate("out/.{name}.csv").pathFor({.name = "x"}), Error);
  EXPECT_THROW(BatchTemplate("out/{name}.csv").pathFor({.name = std::string(252, 'x')}), Error);
  EXPECT_EQ(BatchTemplate("{name}.csv").pathFor({.name = std::string(251, 'x')}).string().size(),
            257U);
}

class BatchPlanning : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "in/deep");
    testing::writeFile(folder_ / "in/b.dsa", "b");
    testing::writeFile(folder_ / "in/deep/a.dsa", "a");
  }
  BatchTemplate names(const std::string& below) const {
    return BatchTemplate((folder_ / below).string());
  }
  std::string refusalOf(const std::vector<fs::path>& paths, const std::string& below) const {
    try {
      planBatch(paths, names(below));
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  testing::TemporaryFolder folder_;
};

TEST_F(BatchPlanning, KeepsTheFoldersAndTakesEachSourceOnce) {
  const BatchPlan plan = planBatch({folder_ / "in", folder_ / "in/b.dsa"}, names("out/{name}.csv"));
  ASSERT_EQ(plan.items.size(), 2U);
  EXPECT_EQ(plan.items[0].target, folder_ / "out/b.csv");
  EXPECT_EQ(plan.items[1].target, folder_ / "out/deep/a.csv");
  EXPECT_EQ(plan.folder, folder_ / "out");
  EXPECT_TRUE(plan.problems.empty());
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(BatchPlanning, RefusesWhatWouldCollide) {
  testing::writeFile(folder_ / "in/b.palpate", "c");
  const std::string both = refusalOf({folder_ / "in"}, "out/{name}.csv");
  EXPECT_NE(both.find("b.dsa"), std::string::npos) << both;
  EXPECT_NE(both.find("b.palpate"), std::string::npos) << both;
  EXPECT_EQ(refusalOf({folder_ / "in"}, "out/{name}_{ending}.csv"), "");
}

TEST_F(BatchPlanning, OrLetsTheSecondOneFail) {
  testing::writeFile(folder_ / "in/b.palpate", "c");
  const BatchPlan plan =
      planBatch({folder_ / "in"}, names("out/{name}.csv"), {}, SameResults::kSecondFails);
  ASSERT_EQ(plan.items.size(), 3U);
  EXPECT_EQ(plan.items[0].target, folder_ / "out/b.csv");
  EXPECT_EQ(plan.items[0].problem, "");
  EXPECT_EQ(plan.items[1].source, folder_ / "in/b.palpate");
  EXPECT_TRUE(plan.items[1].target.empty());
  EXPECT_NE(plan.items[1].problem.find("b.palpate: "), std::string::npos);
  EXPECT_NE(plan.items[1].problem.find("b.dsa"), std::string::npos);
  EXPECT_EQ(plan.items[2].target, folder_ / "out/deep/a.csv");
}

TEST_F(BatchPlanning, RefusesTargetsThatAreSourcesOrLieAmongThem) {
  EXPECT_NE(refusalOf({folder_ / "in"}, "in/made/{name}.csv").find("is in the folder"),
            std::string::npos);
  fs::create_directory_symlink(folder_ / "in", folder_ / "link");
  EXPECT_NE(refusalOf({folder_ / "in"}, "link/made/{name}.csv").find("is in the folder"),
            std::string::npos);
  EXPECT_NE(refusalOf({folder_ / "in/b.dsa"}, "in/{name}.dsa").find("would overwrite a recording"),
            std::string::npos);
  EXPECT_NE(
      refusalOf({folder_ / "in/b.dsa"}, "link/{name}.dsa").find("would overwrite a recording"),
      std::string::npos);
}

TEST_F(BatchPlanning, ReportsFoldersWithoutRecordings) {
  fs::create_directories(folder_ / "empty");
  const BatchPlan plan = planBatch({folder_ / "empty"}, names("out/{name}.csv"));
  EXPECT_TRUE(plan.items.empty());
  ASSERT_EQ(plan.problems.size(), 1U);
  EXPECT_NE(plan.problems[0].find("no recording"), std::string::npos);
}

TEST_F(BatchPlanning, ReadsWhenARecordingBegins) {
  ::setenv("TZ", "UTC", 1);
  ::tzset();
  // 2023-11-14 22:13:20 UTC is 1,700,000,000 s after 1970.
  saveRecording(synthesize({.durationS = 2.0, .grasps = 1, .startUs = 1'700'000'000'000'000}),
                {},
                folder_ / "good.palpate");
  const BatchPlan plan = planBatch({folder_ / "good.palpate", folder_ / "in/b.dsa"},
                                   names("out/{date}/{time}_{name}.csv"));
  ASSERT_EQ(plan.items.size(), 2U);
  EXPECT_EQ(plan.items[0].target, folder_ / "out/2023-11-14/22-13-20_good.csv");
  EXPECT_TRUE(plan.items[1].target.empty());
  EXPECT_NE(plan.items[1].problem.find("b.dsa"), std::string::npos);
}

}  // namespace
}  // namespace palpate::batch_plan_test
