// Commands that take filters give what they give for a filtered copy of the recording.
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::filtered_commands_test {
namespace {
namespace fs = std::filesystem;

using testing::expectOneLineError;
using testing::palpate;
using testing::TemporaryFolder;

class FilteredCommandsTest : public ::testing::Test {
 protected:
  FilteredCommandsTest() {
    fs::create_directories(folder_ / "raw");
    fs::create_directories(folder_ / "filtered");
    saveRecording(synthesize({.durationS = 12.0, .grasps = 2, .noiseCounts = 20.0}),
                  {},
                  folder_ / "raw/a.palpate");
    const auto made = palpate(
        {"filter", folder_ / "raw/a.palpate", folder_ / "filtered/a.palpate", "--filter", kFilter});
    EXPECT_EQ(made.exitCode, 0) << made.err;
  }
  static constexpr const char* kFilter = "median:size=3";
  // Of the raw recording with the filter, and of the filtered one.
  void expectTheSame(std::vector<std::string> command, const std::vector<std::string>& more = {}) {
    std::vector<std::string> raw = command, filtered = command, unfiltered = command;
    raw.push_back(folder_ / "raw/a.palpate");
    raw.insert(raw.end(), {"--filter", kFilter});
    filtered.push_back(folder_ / "filtered/a.palpate");
    unfiltered.push_back(folder_ / "raw/a.palpate");
    for (auto* words : {&raw, &filtered, &unfiltered})
      words->insert(words->end(), more.begin(), more.end());
    const auto with = palpate(raw), of = palpate(filtered), without = palpate(unfiltered);
    EXPECT_EQ(with.exitCode, of.exitCode) << with.err;
    EXPECT_FALSE(with.out.empty());
    EXPECT_EQ(withoutNames(with.out), withoutNames(of.out)) << command[0];
    EXPECT_NE(withoutNames(with.out), withoutNames(without.out)) << command[0];
  }
  std::string withoutNames(std::string text) {
    for (const char* name : {"raw/a.palpate", "filtered/a.palpate"})
      for (std::size_t at; (at = text.find((folder_ / name).string())) != std::string::npos;)
        text.erase(at, (folder_ / name).string().size());
    return text;
  }
  TemporaryFolder folder_;
};

TEST_F(FilteredCommandsTest, Contact) { expectTheSame({"contact"}, {"--angles", "0,0,0,0,0,0,0"}); }
TEST_F(FilteredCommandsTest, Slip) { expectTheSame({"slip", "--method", "centroid"}); }
TEST_F(FilteredCommandsTest, Features) { expectTheSame({"features", "--set", "statistics"}); }
TEST_F(FilteredCommandsTest, Grasps) { expectTheSame({"grasps"}); }

TEST_F(FilteredCommandsTest, Render) {
  for (const std::string name : {"raw", "filtered"}) {
    std::vector<std::string> words = {"render",
                                      folder_ / name / "a.palpate",
                                      "--frame",
                                      "100",
                                      "--range",
                                      "0,2000",
                                      "-o",
                                      (folder_ / (name + ".png")).string()};
    if (name == "raw") words.insert(words.end(), {"--filter", kFilter});
    const auto made = palpate(words);
    ASSERT_EQ(made.exitCode, 0) << made.err;
  }
  EXPECT_TRUE(testing::readFile(folder_ / "raw.png") ==
              testing::readFile(folder_ / "filtered.png"));
}

TEST_F(FilteredCommandsTest, AlsoInABatchAndOverAFolder) {
  const auto slip = palpate({"slip",
                             "--method",
                             "centroid",
                             folder_ / "raw",
                             "-o",
                             folder_ / "out/{name}.csv",
                             "--filter",
                             kFilter});
  EXPECT_EQ(slip.exitCode, 0) << slip.err;
  EXPECT_EQ(testing::readFile(folder_ / "out/a.csv"),
            palpate({"slip", "--method", "centroid", folder_ / "filtered/a.palpate"}).out);
  const auto grasps = palpate({"grasps", folder_ / "raw", "--filter", kFilter});
  EXPECT_EQ(withoutNames(grasps.out), withoutNames(palpate({"grasps", folder_ / "filtered"}).out));
}

TEST_F(FilteredCommandsTest, AWrongFilterIsRefused) {
  for (const char* command : {"grasps", "slip", "features", "contact"})
    expectOneLineError(palpate({command, folder_ / "raw/a.palpate", "--filter", "nonsense"}),
                       2,
                       {"--filter", "nonsense"});
}

}  // namespace
}  // namespace palpate::filtered_commands_test
