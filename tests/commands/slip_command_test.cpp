#include <algorithm>
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_writer.h"

#include "commands/palpate_program.h"

namespace palpate::slip_command_test {
namespace {

using testing::palpate;

constexpr const char* kHeader =
    "frame,time_ms,matrix,active,valid,dx,dy,ref_dx,ref_dy,rotation_valid,rotation_deg,"
    "ref_rotation_deg,orientation_deg,eccentricity,roundness,residual,confidence,p_moved,state,"
    "slipping";

// Matrix 1: nothing until frame 5, then a contact that rests and slips down by 2 taxels between
// frames 50 and 60. Matrix 3: one taxel.
std::string recordingIn(const testing::TemporaryFolder& folder) {
  ProfileBuilder builder(sdh2().layout);
  SyntheticSensor sensor;
  sensor.layout = sdh2().layout->matrix(1);
  SyntheticSlip slip(sensor, 1);
  std::int64_t nowUs = 1'400'000'000'000'000;
  for (int i = 0; i < 90; ++i) {
    TactileFrame frame(sdh2().layout);
    if (i >= 5) slip.read({.y = 4.5 + 0.2 * std::clamp(i - 50, 0, 10)}, frame.matrix(1));
    frame.matrix(3)(4, 4) = 700.0F;
    builder.addFrame(nowUs += 32'000, frame.values);
  }
  const std::string path = (folder / "slips.dsa").string();
  writeDsa(builder.finish({}), path);
  return path;
}

using Row = std::map<std::string, std::string>;
std::vector<Row> rowsOf(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  const auto split = [](const std::string& text) {
    std::vector<std::string> fields(1);
    for (const char c : text) {
      if (c == ',')
        fields.emplace_back();
      else
        fields.back() += c;
    }
    return fields;
  };
  std::getline(lines, line);
  const std::vector<std::string> names = split(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> fields = split(line);
    EXPECT_EQ(fields.size(), names.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(fields.size(), names.size()); ++i)
      row[names[i]] = fields[i];
    rows.push_back(row);
  }
  return rows;
}

double number(const Row& row, const std::string& name) {
  return parseDouble(row.at(name)).value_or(-999.0);
}

TEST(SlipCommand, PrintsThePromisedColumnsByEveryMethod) {
  const testing::TemporaryFolder folder;
  const std::string path = recordingIn(folder);
  for (const std::string method : {"centroid",
                                   "alcazar",
                                   "ncc-paraboloid",
                                   "ncc-gauss3",
                                   "phase",
                                   "phase-normalized",
                                   "register",
                                   "contest"}) {
    const auto result = palpate({"slip", path, "--method", method, "--quiet"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out.substr(0, result.out.find('\n')), kHeader);
    const auto rows = rowsOf(result.out);
    EXPECT_EQ(rows.size(), 90U + 85U) << method;  // rows of matrices with active taxels
    double way = 0.0;
    bool slipping = false;
    for (const Row& row : rows) {
      if (row.at("valid") == "0") {
        for (const char* empty : {"dx", "dy", "ref_dx", "ref_dy"})
          EXPECT_EQ(row.at(empty), "") << method;
      }
      if (row.at("matrix") != "1") {
        EXPECT_EQ(row.at("valid"), "0");
        EXPECT_EQ(row.at("state"), "invalid");
        continue;
      }
      if (row.at("valid") == "1") way += number(row, "dy");
      slipping |= row.at("slipping") == "1";
    }
    EXPECT_NEAR(way, 2.0, 0.5) << method;
    EXPECT_TRUE(slipping) << method;
    EXPECT_NEAR(
        number(rows.back().at("matrix") == "1" ? rows.back() : rows[rows.size() - 2], "ref_dy"),
        2.0,
        0.5)
        << method;
  }
}

TEST(SlipCommand, TakesMatrixReferenceAndThresholds) {
  const testing::TemporaryFolder folder;
  const std::string path = recordingIn(folder);
  const auto one = palpate({"slip", path, "--matrix", "1", "--reference", "45", "--quiet"});
  ASSERT_EQ(one.exitCode, 0) << one.err;
  const auto rows = rowsOf(one.out);
  ASSERT_EQ(rows.size(), 85U);
  EXPECT_EQ(rows[30].at("ref_dy"), "");  // frame 35: before it
  EXPECT_NEAR(number(rows.back(), "ref_dy"), 2.0, 0.1);
  const auto rest = palpate({"slip", path, "--matrix", "1", "--reference", "rest", "--quiet"});
  EXPECT_NE(rest.out, one.out);
  const auto deaf =
      palpate({"slip", path, "--segments", "--step", "5", "--limit", "50", "--quiet"});
  EXPECT_EQ(rowsOf(deaf.out).size(), 0U);
}

TEST(SlipCommand, PrintsSegments) {
  const testing::TemporaryFolder folder;
  const auto result = palpate({"slip", recordingIn(folder), "--segments", "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = rowsOf(result.out);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("matrix"), "1");
  EXPECT_NEAR(number(rows[0], "begin"), 52.0, 1.0);
  EXPECT_EQ(number(rows[0], "begin_ms"),
            1'400'000'000'000.0 + 32.0 * (number(rows[0], "begin") + 1));
}

TEST(SlipCommand, SaysWhatIsWrong) {
  const testing::TemporaryFolder folder;
  const std::string path = recordingIn(folder);
  EXPECT_EQ(palpate({"slip"}).exitCode, 2);
  EXPECT_EQ(palpate({"slip", path, "--method", "magic"}).exitCode, 2);
  EXPECT_EQ(palpate({"slip", path, "--reference", "-3"}).exitCode, 2);
  EXPECT_EQ(palpate({"slip", path, "--step", "0"}).exitCode, 2);
  const auto matrix = palpate({"slip", path, "--matrix", "6"});
  EXPECT_EQ(matrix.exitCode, 1);
  EXPECT_NE(matrix.err.find("has no matrix 6"), std::string::npos) << matrix.err;
  const auto frame = palpate({"slip", path, "--reference", "90"});
  EXPECT_EQ(frame.exitCode, 1);
  EXPECT_NE(frame.err.find("has no frame 90"), std::string::npos) << frame.err;
  EXPECT_EQ(palpate({"slip", (folder / "none.dsa").string()}).exitCode, 1);
}

TEST(SlipCommand, ReadsTheStudysRecording) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const auto path = *recordings / "slip-detection" / "slip_and_rotation_teapot_handle.dsa";
  const auto result = palpate({"slip", path.string(), "--segments", "--reference", "rest"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  // The rule of slip_evaluation.h marks slips on matrices 1 and 5.
  std::map<std::string, int> segments;
  for (const Row& row : rowsOf(result.out)) ++segments[row.at("matrix")];
  EXPECT_GE(segments["1"], 1);
  EXPECT_GE(segments["5"], 1);
}

}  // namespace
}  // namespace palpate::slip_command_test
