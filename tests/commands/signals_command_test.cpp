#include <sstream>

#include "palpate/core/number_text.h"

#include "commands/palpate_program.h"

namespace palpate::signals_command_test {
namespace {

namespace fs = std::filesystem;
using testing::expectOneLineError;
using testing::palpate;

std::vector<std::vector<std::string>> csvRows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields(1);
    for (char c : line) {
      if (c == ',')
        fields.emplace_back();
      else
        fields.back() += c;
    }
    rows.push_back(fields);
  }
  return rows;
}

TEST(SignalsCommand, PrintsOneRowPerFrameAndMatrix) {
  const testing::TemporaryFolder folder;
  ASSERT_EQ(palpate({"synthesize",
                     "-o",
                     folder / "a.dsa",
                     "--duration",
                     "4",
                     "--rate",
                     "10",
                     "--grasps",
                     "1"})
                .exitCode,
            0);
  const auto result = palpate({"signals", folder / "a.dsa"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = csvRows(result.out);
  ASSERT_EQ(rows.size(), 1u + 41u * 6u);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')),
            "frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2");
  EXPECT_EQ(
      rows[1],
      (std::vector<std::string>{"0", "1700000000000", "0", "0", "0", "0", "0", "0", "0", "0"}));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 10u);
    const auto number = [&](std::size_t column) { return *parseDouble(rows[i][column]); };
    EXPECT_EQ(number(0), static_cast<double>((i - 1) / 6));
    EXPECT_EQ(number(2), static_cast<double>((i - 1) % 6));
    EXPECT_NEAR(number(3) * number(8), number(7), 1e-6);  // mean * active = sum
    EXPECT_NEAR(number(9), number(8) * 3.4 * 3.4, 1e-9);  // area
    EXPECT_LE(number(5), number(6));
  }
}

TEST(SignalsCommand, ChoosesOneMatrixAndNamesSeveralFiles) {
  const testing::TemporaryFolder folder;
  for (const char* name : {"a.dsa", "b,c.dsa"})
    ASSERT_EQ(
        palpate({"synthesize", "-o", folder / name, "--duration", "1", "--rate", "10"}).exitCode,
        0);
  const auto one = csvRows(palpate({"signals", folder / "a.dsa", "--matrix", "5"}).out);
  ASSERT_EQ(one.size(), 12u);
  EXPECT_EQ(one[1][2], "5");
  const auto both = palpate({"signals", folder / "a.dsa", folder / "b,c.dsa", "--matrix", "1"});
  EXPECT_NE(both.out.find("area_mm2,file\n"), std::string::npos);
  EXPECT_NE(both.out.find("\"" + (folder / "b,c.dsa").string() + "\"\n"), std::string::npos);
}

TEST(SignalsCommand, OfAFolderIsOneTableThatNamesTheFiles) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  const std::string a = folder / "a.dsa", b = folder / "sub/b.dsa";
  ASSERT_EQ(palpate({"synthesize", "-o", a, "--duration", "1", "--rate", "10"}).exitCode, 0);
  ASSERT_EQ(palpate({"synthesize", "-o", b, "--duration", "2", "--rate", "10"}).exitCode, 0);
  const auto whole = palpate({"signals", folder.path(), "--matrix", "1"});
  EXPECT_EQ(whole.exitCode, 0) << whole.err;
  // The tables of the files one behind the other, with their names behind each row.
  std::string expected =
      "frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2,file\n";
  for (const std::string& file : {a, b}) {
    const std::string one = palpate({"signals", file, "--matrix", "1"}).out;
    std::istringstream lines(one.substr(one.find('\n') + 1));
    for (std::string line; std::getline(lines, line);) expected += line + "," + file + "\n";
  }
  EXPECT_EQ(whole.out, expected);
  EXPECT_EQ(csvRows(whole.out).size(), 1u + 11u + 21u);
  // A folder with one recording names it, too: scripts see the same columns whatever lies in it.
  const auto one = palpate({"signals", folder / "sub", "--matrix", "1"});
  EXPECT_EQ(csvRows(one.out).at(1).at(10), b);
}

TEST(SignalsCommand, CoversEveryFrameOfAFolderOfRecordings) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const fs::path folder = testing::exhaustive() ? *recordings : *recordings / "grasps";
  std::int64_t frames = 0;
  for (const auto& row : csvRows(palpate({"info", folder.string()}).out))
    frames += parseInteger(row.at(3)).value_or(0);
  EXPECT_GT(frames, 5'000);
  const auto result = palpate({"signals", folder.string(), "--matrix", "5"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), frames + 1);
}

TEST(SignalsCommand, RefusesAMatrixThatIsNotThere) {
  const testing::TemporaryFolder folder;
  ASSERT_EQ(palpate({"synthesize", "-o", folder / "a.dsa", "--duration", "1"}).exitCode, 0);
  const auto result = palpate({"signals", folder / "a.dsa", "--matrix", "6"});
  expectOneLineError(result, 1, {"no matrix 6", "0..5"});
  EXPECT_EQ(result.out, "");
}

// Frame 0 of a shared recording, computed by hand from its XML: independent of our reader.
TEST(SignalsCommand, IsNumericallyTrueOnARealFrame) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  // foam_ball, frame 2411, finger 0 distal: 36 active taxels, mean 500, maximum 1013; finger 2
  // distal: 24, 184, 338 (window sketch of the specification).
  const auto result = palpate({"signals", (*folder / "grasps" / "foam_ball.dsa").string()});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = csvRows(result.out);
  const auto& distal0 = rows.at(1 + 2411 * 6 + 1);
  EXPECT_EQ(distal0[0], "2411");
  EXPECT_EQ(distal0[8], "36");
  EXPECT_EQ(distal0[6], "1013");
  EXPECT_EQ(fixedText(*parseDouble(distal0[3]), 0), "500");
  const auto& distal2 = rows.at(1 + 2411 * 6 + 5);
  EXPECT_EQ(distal2[8], "24");
  EXPECT_EQ(distal2[6], "338");
  EXPECT_EQ(fixedText(*parseDouble(distal2[3]), 0), "184");
}

}  // namespace
}  // namespace palpate::signals_command_test
