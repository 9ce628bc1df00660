// `palpate ghosts`.
#include <map>
#include <sstream>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/filter/recipe.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::ghosts_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

using Row = std::map<std::string, std::string>;

// Of a CSV without commas in cells, but for quoted ones, which are taken as they are.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::vector<Row> rowsOf(const std::string& csv) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = cellsOf(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cellsOf(line);
    EXPECT_EQ(cells.size(), header.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(cells.size(), header.size()); ++i)
      row[header[i]] = cells[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

double number(const Row& row, const std::string& column) {
  const auto value = parseDouble(row.at(column));
  EXPECT_TRUE(value) << column << " is '" << row.at(column) << "'";
  return value.value_or(-1.0);
}

// Ten frames: a lone ghost flickers in matrix 1 (frames 2 and 6), and stays in matrix 3 (4 to 9).
std::string writeGhosts(const testing::TemporaryFolder& folder) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 10; ++i) {
    TactileFrame frame(sdh2().layout);
    if (i == 2 || i == 6) frame.matrix(1)(7, 2) = 3.0F;
    if (i >= 4) frame.matrix(3)(9, 1) = 1.0F;
    builder.addFrame(1'400'000'000'000'000 + i * 30'000, frame.values);
  }
  const std::string path = folder / "ghosts.dsa";
  saveRecording(builder.finish({}), {}, path);
  return path;
}

TEST(GhostsCommand, CountsTheGhostsOfARecording) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGhosts(folder);
  const auto result = palpate({"ghosts", in, "--filter", "temporal-min:window=2"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<Row> rows = rowsOf(result.out);
  ASSERT_EQ(rows.size(), 1u);
  const Row& row = rows[0];
  EXPECT_EQ(row.at("recipe"), "temporal-min:window=2");
  EXPECT_EQ(row.at("file"), in);
  EXPECT_EQ(row.at("frames"), "10");
  EXPECT_DOUBLE_EQ(number(row, "false_per_frame"), 0.8);
  EXPECT_DOUBLE_EQ(number(row, "false_per_frame_after"), 0.5);
  EXPECT_DOUBLE_EQ(number(row, "false_removed"), 0.375);
  EXPECT_DOUBLE_EQ(number(row, "frames_false"), 0.7);
  EXPECT_DOUBLE_EQ(number(row, "frames_false_after"), 0.5);
  EXPECT_DOUBLE_EQ(number(row, "whole_matrix"), 0.0);
  EXPECT_EQ(row.at("latency_frames"), "1");
  EXPECT_GT(number(row, "cost_us"), 0.0);
  EXPECT_FALSE(row.contains("touched_removed"));

  const auto json = palpate({"ghosts", in, "--filter", "temporal-min:window=2", "--json"});
  ASSERT_EQ(json.exitCode, 0) << json.err;
  const Json report = Json::parse(json.out).at("reports").at(std::size_t{0});
  EXPECT_EQ(report.at("matrices").at(1).at("false_taxels").at("before").asInteger(), 2);
  EXPECT_EQ(report.at("matrices").at(1).at("frames_with_false").at("after").asInteger(), 0);
  EXPECT_EQ(report.at("matrices").at(3).at("scattered").at("after").asInteger(), 5);
}

TEST(GhostsCommand, OffersPresetsAndCandidates) {
  const testing::TemporaryFolder folder;
  const auto result = palpate({"ghosts", writeGhosts(folder)});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::map<std::string, int> times;
  for (const Row& row : rowsOf(result.out)) ++times[row.at("recipe")];
  for (const Recipe& preset : recipePresets()) EXPECT_EQ(times[recipeText(preset)], 1);
  for (const char* text : {"median:size=5,masked=1", "kalman", "nlm:masked=1", "temporal-min"})
    EXPECT_EQ(times[text], 1) << text;
  EXPECT_GT(times.size(), 25u);
}

TEST(GhostsCommand, EmulatedHandsHaveContactsToLose) {
  const std::vector<std::string> ask = {"ghosts",
                                        "--frames",
                                        "600",
                                        "--deg",
                                        "30",
                                        "--below",
                                        "0",
                                        "--below",
                                        "-40",
                                        "--filter",
                                        "median:masked=1"};
  const auto result = palpate(ask);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<Row> rows = rowsOf(result.out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("below_counts"), "0");
  // 40 counts above the noise there is no ghost, and no share of ghosts.
  EXPECT_EQ(number(rows[1], "false_per_frame"), 0.0);
  EXPECT_EQ(rows[1].at("false_removed"), "");
  // A median of nine takes most of a touch of one taxel, and leaves nearly all of a broad one.
  EXPECT_GT(number(rows[0], "point_removed"), 0.5);
  EXPECT_LT(number(rows[0], "broad_removed"), 0.1);
  EXPECT_GE(number(rows[0], "contacts_hidden"), 1.0);

  const auto differing = [](std::string out) {  // all but the cost, which is measured
    std::string text;
    for (Row& row : rowsOf(out)) {
      row.erase("cost_us");
      for (const auto& [name, cell] : row) text += name + "=" + cell + "\n";
    }
    return text;
  };
  std::vector<std::string> again = ask, other = ask;
  again.insert(again.end(), {"--seed", "1"});
  other.insert(other.end(), {"--seed", "2"});
  EXPECT_EQ(differing(palpate(again).out), differing(result.out));
  EXPECT_NE(differing(palpate(other).out), differing(result.out));

  std::vector<std::string> json = ask;
  json.emplace_back("--json");
  const Json list = Json::parse(palpate(json).out).at("reports");
  ASSERT_EQ(list.size(), 2u);
  const Json contacts = list.at(std::size_t{1}).at("contact_list");
  EXPECT_EQ(static_cast<double>(contacts.size()), number(rows[1], "contacts"));
  EXPECT_TRUE(contacts.at(std::size_t{0}).at("size").isString());
}

// Matrix 0 at 30 deg C: 33.628 + 0.3317 * 30 + 3 * 2.425417 = 50.9, a threshold of 51; two
// less: 49.
TEST(GhostsCommand, LooksAtRecordingsOfTheNoiseOverThresholds) {
  const testing::TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  frame.values[0] = 53.0F;
  frame.values[2] = 51.0F;
  frame.values[4] = 50.0F;
  builder.addTemperatures(1'400'000'000'000'000, std::vector<double>(9, 30.0));
  builder.addFrame(1'400'000'000'000'000, frame.values);
  saveRecording(builder.finish({}), {}, folder / "noise.dsa");
  const auto falseTaxels = [&](const std::vector<std::string>& more) {
    std::vector<std::string> ask = {"ghosts", folder / "noise.dsa", "--filter", "box:masked=1"};
    ask.insert(ask.end(), more.begin(), more.end());
    const auto result = palpate(ask);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    std::vector<double> numbers;
    for (const Row& row : rowsOf(result.out)) numbers.push_back(number(row, "false_per_frame"));
    return numbers;
  };
  EXPECT_EQ(falseTaxels({}), std::vector{3.0});
  EXPECT_EQ(falseTaxels({"--below", "0", "--below", "2"}), (std::vector{1.0, 3.0}));
  // Without temperatures nobody knows where the noise floor is.
  expectOneLineError(palpate({"ghosts", writeGhosts(folder), "--below", "0"}), 1, {"temperatures"});
}

TEST(GhostsCommand, RefusesWhatMakesNoSense) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGhosts(folder);
  expectOneLineError(palpate({"ghosts", in, "--seed", "2"}), 2, {"--seed", "emulated"});
  expectOneLineError(palpate({"ghosts", "--below", "much"}), 2, {"--below", "-100", "much"});
  expectOneLineError(palpate({"ghosts", "--deg", "900"}), 2, {"--deg", "80"});
  expectOneLineError(palpate({"ghosts", "--frames", "0"}), 2, {"--frames"});
  expectOneLineError(palpate({"ghosts", in, "--filter", "medain"}), 2, {"medain", "median, "});
  expectOneLineError(palpate({"ghosts", folder / "none.dsa"}), 1, {"none.dsa"});
  expectOneLineError(palpate({"ghosts", in, "--filter", "median:matrices=9"}), 1, {"no matrix 9"});
}

}  // namespace
}  // namespace palpate::ghosts_command_test
