#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/core/output_file.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate {
namespace {

using testing::expectOneLineError;
using testing::palpate;

const std::string kHeader =
    "frame,time_ms,active,sphere_x_mm,sphere_y_mm,sphere_z_mm,sphere_radius_mm,force_n";
const std::string kAngles = "90,-6,5,-90,0,-5,5";

std::vector<std::vector<std::string>> csvRows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',')
        fields.emplace_back();
      else
        fields.back() += c;
    }
    rows.push_back(fields);
  }
  return rows;
}

// Three frames: nothing, one taxel of finger 0, one each of fingers 0 and 2. Angles are added where given.
void saveTouches(const std::filesystem::path& path,
                 const std::vector<std::vector<double>>& anglesDeg = {}) {
  ProfileBuilder builder(sdh2().layout);
  for (int i = 0; i < 3; ++i) {
    TactileFrame frame(sdh2().layout);
    if (i >= 1) frame.matrix(1)(10, 2) = 500.0F;
    if (i >= 2) frame.matrix(5)(10, 3) = 400.0F;
    builder.addFrame(1'400'000'000'000'000 + i * 30'000, frame.values);
    if (static_cast<std::size_t>(i) < anglesDeg.size())
      builder.addAngles(1'400'000'000'000'000 + i * 30'000, anglesDeg[static_cast<std::size_t>(i)]);
  }
  saveRecording(builder.finish({}), {}, path);
}

double number(const std::string& text) { return parseDouble(text).value(); }

// What `palpate kinematics` says of a taxel is where the sphere must be.
TEST(ContactCommand, PrintsOneRowPerFrame) {
  const testing::TemporaryFolder folder;
  const std::vector<double> angles = {90, -6, 5, -90, 0, -5, 5};
  saveTouches(folder / "a.dsa", {angles});
  const auto result = palpate({"contact", folder / "a.dsa"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = csvRows(result.out);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), kHeader);
  EXPECT_EQ(rows[1], (std::vector<std::string>{"0", "1400000000000", "0", "", "", "", "", ""}));
  const auto taxels = csvRows(palpate({"kinematics", "--angles", kAngles}).out);
  std::map<std::string, std::vector<double>> at;
  for (std::size_t i = 1; i < taxels.size(); ++i)
    at[taxels[i][0] + "," + taxels[i][1] + "," + taxels[i][2]] = {
        number(taxels[i][3]), number(taxels[i][4]), number(taxels[i][5])};
  const auto first = at.at("1,2,10"), second = at.at("5,3,10");
  EXPECT_EQ(rows[2][2], "1");
  EXPECT_EQ(number(rows[2][6]), 0.0);
  EXPECT_EQ(rows[3][0], "2");
  EXPECT_EQ(rows[3][2], "2");
  double squared = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(number(rows[2][3 + i]), first[i], 1e-9);
    EXPECT_NEAR(number(rows[3][3 + i]), (first[i] + second[i]) / 2.0, 1e-9);
    squared += (first[i] - second[i]) * (first[i] - second[i]);
  }
  EXPECT_NEAR(number(rows[3][6]), std::sqrt(squared) / 2.0, 1e-9);
  EXPECT_EQ(rows[3][7], "") << "no force without a calibration";
}

}  // namespace
}  // namespace palpate
