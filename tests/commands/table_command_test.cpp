// What all commands with tables have in common: -o, --units-row, --json, --time-column, and the
// exit code of the same mistake.
#include <string>
#include <vector>

#include "palpate/core/json.h"

#include "commands/palpate_program.h"

namespace palpate::table_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

struct TableCommand {
  std::vector<std::string> words;  // RECORDING stands for the file
  // Added for a matrix and a frame that the recording doesn't have, and for a wrong value; empty:
  // the command has no such option.
  std::vector<std::string> noMatrix, noFrame, wrongValue;
};

const std::vector<TableCommand> kCommands = {
    {{"signals", "RECORDING"}, {"--matrix", "9"}, {}, {"--matrix", "x"}},
    {{"slip", "RECORDING"}, {"--matrix", "9"}, {"--reference", "99999999"}, {"--method", "magic"}},
    {{"contact", "RECORDING"}, {}, {"--from", "99999999"}, {"--from", "x"}},
    {{"grasps", "RECORDING"}, {}, {}, {"--rule", "x"}},
    {{"features", "RECORDING"}, {}, {}, {"--set", "x"}},
    {{"derive", "RECORDING", "m1_mean"}, {}, {"--from", "99999999"}, {"--from", "x"}},
    {{"spectrum", "RECORDING", "--signal", "mean"},
     {"--matrix", "9"},
     {"--from", "99999999"},
     {"--window", "x"}},
    {{"compare", "RECORDING", "RECORDING"}, {}, {}, {"--align", "x"}},
    {{"ghosts", "RECORDING"}, {"--filter", "median:matrices=9"}, {}, {"--above", "x"}},
    {{"kinematics", "--angles", "0,0,0,0,0,0,0"}, {"--matrix", "9"}, {}, {"--matrix", "x"}},
};

std::vector<std::string> withFile(std::vector<std::string> words,
                                  const std::string& file,
                                  const std::vector<std::string>& more = {}) {
  for (std::string& word : words)
    if (word == "RECORDING") word = file;
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(TableCommands, TheSameMistakeHasTheSameExitCode) {
  const testing::TemporaryFolder folder;
  const std::string file = testing::dataFolder() / "demo_grasps.dsa";
  const std::string readme = testing::dataFolder().parent_path() / "README.md";
  for (const TableCommand& command : kCommands) {
    SCOPED_TRACE(command.words.front());
    if (!command.noMatrix.empty())
      expectOneLineError(palpate(withFile(command.words, file, command.noMatrix)), 1, {"matrix 9"});
    if (!command.noFrame.empty())
      expectOneLineError(palpate(withFile(command.words, file, command.noFrame)), 1, {"99999999"});
    expectOneLineError(
        palpate(withFile(command.words, file, command.wrongValue)), 2, {command.wrongValue.back()});
    if (command.words[1] != "RECORDING") continue;
    const auto missing = palpate(withFile(command.words, folder / "none.dsa"));
    EXPECT_EQ(missing.exitCode, 1) << missing.err;
    EXPECT_NE(missing.err.find("none.dsa"), std::string::npos) << missing.err;
    const auto other = palpate(withFile(command.words, readme));
    EXPECT_EQ(other.exitCode, 1) << other.err;
    EXPECT_NE(other.err.find("README.md"), std::string::npos) << other.err;
  }
}

TEST(TableCommands, WriteFilesByTheirEnding) {
  const testing::TemporaryFolder folder;
  const std::string file = testing::dataFolder() / "demo_grasps.dsa";
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"signals", "RECORDING", "--centre"},
                                             {"grasps", "RECORDING"},
                                             {"derive", "RECORDING", "m1_mean"},
                                             {"compare", "RECORDING", "RECORDING"},
                                             {"kinematics", "--angles", "0,0,0,0,0,0,0"}}) {
    SCOPED_TRACE(words.front());
    const std::string csv = folder / (words.front() + ".csv");
    const std::string json = folder / (words.front() + ".json");
    const auto printed = palpate(withFile(words, file));
    ASSERT_EQ(printed.exitCode, 0) << printed.err;
    EXPECT_EQ(palpate(withFile(words, file, {"-o", csv})).exitCode, 0);
    EXPECT_EQ(testing::readFile(csv), printed.out);
    EXPECT_EQ(palpate(withFile(words, file, {"-o", json})).exitCode, 0);
    EXPECT_EQ(testing::readFile(json), palpate(withFile(words, file, {"--json"})).out);
    EXPECT_GT(Json::parse(testing::readFile(json)).at("rows").size(), 0u);
    EXPECT_EQ(palpate(withFile(words, file, {"-o", folder / "a.txt"})).exitCode, 2);
  }
}

TEST(TableCommands, RefuseAnOutputBeforeTheWork) {
  const testing::TemporaryFolder folder;
  const std::string out = folder / "out.json";
  testing::writeFile(out, "kept");
  // The recording doesn't exist: the output is looked at first.
  const std::string none = folder / "none.dsa";
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"derive", none, "m1_mean"}, {"evaluate", none}, {"calibrate", "tare", none, "--apply"}})
    expectOneLineError(palpate(withFile(words, none, {"-o", out})), 1, {"out.json", "--force"});
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"derive", none, "m1_mean"}, {"compare", none, none}})
    expectOneLineError(palpate(withFile(words, none, {"-o", "x.txt"})), 2, {".csv, .json"});
  expectOneLineError(
      palpate({"classify", out, none, "-o", out, "--force"}), 1, {"out.json", "the input itself"});
  expectOneLineError(palpate({"evaluate", none, "--model", out, "-o", out, "--force"}),
                     1,
                     {"out.json", "the input itself"});
  EXPECT_EQ(testing::readFile(out), "kept");
}

TEST(TableCommands, AddTimesInSecondsAndAsDates) {
  const std::string file = testing::dataFolder() / "demo_grasps.dsa";
  const auto headOf = [&](const std::vector<std::string>& words) {
    const auto result = palpate(withFile(words, file));
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return result.out.substr(0, result.out.find('\n'));
  };
  EXPECT_TRUE(headOf({"signals", "RECORDING", "--time-column", "s"})
                  .starts_with("frame,time_ms,time_s,matrix,mean"));
  EXPECT_TRUE(headOf({"contact", "RECORDING", "--time-column", "utc"})
                  .starts_with("frame,time_ms,time_utc,active"));
  EXPECT_EQ(headOf({"grasps", "RECORDING", "--time-column", "s"}),
            "begin,end,begin_ms,begin_s,end_ms,end_s,fingers,quality");
  expectOneLineError(
      palpate({"contact", file, "--size", "--time-column", "s"}), 2, {"--time-column", "time_ms"});
}

}  // namespace
}  // namespace palpate::table_command_test
