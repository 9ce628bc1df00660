#include <cmath>
#include <map>
#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/core/output_file.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::contact_command_test {
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

// Three frames: nothing, one taxel of finger 0, one each of fingers 0 and 2. Angles are added where
// given.
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

TEST(ContactCommand, ARowPerMatrixWithCentroidNormalAndAxes) {
  const testing::TemporaryFolder folder;
  saveTouches(folder / "a.palpate", {{90, -6, 5, -90, 0, -5, 5}});
  const auto result = palpate({"contact", folder / "a.palpate", "--matrices"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = csvRows(result.out);
  ASSERT_EQ(rows.size(), 1u + 3u * 6u);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')),
            "frame,time_ms,matrix,active,sum,area_mm2,centroid_x_mm,centroid_y_mm,centroid_z_mm,nx,"
            "ny,nz,major_x,major_y,major_z,major_sd_mm,minor_x,minor_y,minor_z,minor_sd_mm,"
            "surface_x_mm,surface_y_mm");
  for (const auto& row : rows) EXPECT_EQ(row.size(), 22u);
  const auto& empty = rows[1 + 6];
  EXPECT_EQ(empty[2] + empty[3] + empty[4] + empty[5] + empty[6] + empty[21], "0000");
  const auto& touched = rows[1 + 6 + 1];
  EXPECT_EQ(touched[3], "1");
  EXPECT_EQ(touched[4], "500");
  EXPECT_NEAR(number(touched[5]), 3.4 * 3.4, 1e-12);
  // Where `palpate kinematics` has that point, with its normal.
  const auto point =
      csvRows(palpate({"kinematics", "--angles", kAngles, "--point", "1,6.8,34"}).out)[1];
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(number(touched[6 + i]), number(point[3 + i]), 1e-9) << i;
  EXPECT_NEAR(number(touched[20]), 6.8, 1e-9);
  EXPECT_NEAR(number(touched[21]), 34.0, 1e-9);
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) along += number(touched[12 + i]) * number(touched[9 + i]);
  EXPECT_NEAR(along, 0.0, 1e-9) << "an axis touches the surface";
}

TEST(ContactCommand, WithoutJointAnglesItNeedsSome) {
  const testing::TemporaryFolder folder;
  saveTouches(folder / "a.dsa");
  const auto without = palpate({"contact", folder / "a.dsa"});
  expectOneLineError(without, 1, {"a.dsa", "no joint angles", "--angles"});
  EXPECT_EQ(without.out, "");
  const auto with = palpate({"contact", folder / "a.dsa", "--angles", kAngles});
  ASSERT_EQ(with.exitCode, 0) << with.err;
  EXPECT_EQ(csvRows(with.out).size(), 4u);
  // The same pose, recorded: the same rows. And an assumed pose replaces a recorded one.
  saveTouches(folder / "b.dsa", {{90, -6, 5, -90, 0, -5, 5}});
  EXPECT_EQ(palpate({"contact", folder / "b.dsa"}).out, with.out);
  const auto other = palpate({"contact", folder / "b.dsa", "--angles=0,0,0,0,0,0,0"});
  EXPECT_NE(other.out, with.out);
  EXPECT_EQ(other.out, palpate({"contact", folder / "a.dsa", "--angles=0,0,0,0,0,0,0"}).out);
  // A size needs a hand that moves.
  expectOneLineError(palpate({"contact", folder / "a.dsa", "--size"}), 1, {"no joint angles"});
}

TEST(ContactCommand, AnglesThatTheHandCannotTakeAreSaid) {
  const testing::TemporaryFolder folder;
  saveTouches(folder / "a.dsa",
              {{90, -6, 5, -90, 0, -5, 5}, {120, -6, 5, -90, 0, -5, 5}, {90, 0, 0, 0, 0, 0, 170}});
  const auto result = palpate({"contact", folder / "a.dsa"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(csvRows(result.out).size(), 4u);
  EXPECT_NE(csvRows(result.out)[3][6], "");
  EXPECT_NE(result.err.find("2 of 3 frames"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("axis 0 (fingers 0 and 2 base) at 120 degrees"), std::string::npos)
      << result.err;
  EXPECT_EQ(palpate({"contact", folder / "a.dsa", "--quiet"}).err, "");
}

TEST(ContactCommand, ChoosesFramesThresholdAndFingertip) {
  const testing::TemporaryFolder folder;
  saveTouches(folder / "a.dsa", {{90, -6, 5, -90, 0, -5, 5}});
  const std::string file = folder / "a.dsa";
  const auto all = csvRows(palpate({"contact", file}).out);
  const auto last = csvRows(palpate({"contact", file, "--from", "2"}).out);
  ASSERT_EQ(last.size(), 2u);
  EXPECT_EQ(last[1], all[3]);
  const auto middle = csvRows(palpate({"contact", file, "--from", "1", "--to", "1"}).out);
  ASSERT_EQ(middle.size(), 2u);
  EXPECT_EQ(middle[1], all[2]);
  EXPECT_EQ(csvRows(palpate({"contact", file, "--threshold", "450"}).out)[3][2], "1");
  // Row 10 lies on the flat part: the radius of the bend changes nothing.
  EXPECT_EQ(csvRows(palpate({"contact", file, "--fingertip", "effective"}).out), all);
  expectOneLineError(palpate({"contact", file, "--from", "3"}), 1, {"no frame 3", "0..2"});
  expectOneLineError(palpate({"contact", file, "--to", "7"}), 1, {"no frame 7", "0..2"});
}

TEST(ContactCommand, OfAFolderIsOneTableThatNamesTheFiles) {
  const testing::TemporaryFolder folder;
  saveTouches(folder / "a.dsa", {{90, -6, 5, -90, 0, -5, 5}});
  saveTouches(folder / "b,c.dsa", {{90, -6, 5, -90, 0, -5, 5}});
  saveTouches(folder / "c.dsa");
  testing::writeFile(folder / "d.dsa", "no recording");
  const auto result = palpate({"contact", folder.path()});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), kHeader + ",file");
  EXPECT_EQ(csvRows(result.out).size(), 1u + 3u + 3u);
  EXPECT_NE(result.out.find(",\"" + (folder / "b,c.dsa").string() + "\"\n"), std::string::npos);
  EXPECT_NE(result.err.find("c.dsa: has no joint angles"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("d.dsa"), std::string::npos) << result.err;
}

TEST(ContactCommand, WrongUsageIsSaidInOneLine) {
  const testing::TemporaryFolder folder;
  saveTouches(folder / "a.dsa", {{90, -6, 5, -90, 0, -5, 5}});
  const std::string file = folder / "a.dsa";
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {file, "--angles", "0,0,0"},
                                             {file, "--angles", "0,0,0,0,0,0,0,0"},
                                             {file, "--angles", "0,0,0,0,0,0,nan"},
                                             {file, "--angles", "0,0,0,0,0,0,"},
                                             {file, "--angles", "0,0,0,0,0,0,95"},
                                             {file, "--angles", "-5,0,0,0,0,0,0"},
                                             {file, "--threshold", "-1"},
                                             {file, "--from", "2", "--to", "1"},
                                             {file, "--from", "-1"},
                                             {file, "--fingertip", "round"},
                                             {file, "--size", "--matrices"},
                                             {file, "--size", "--angles", kAngles},
                                             {file, "--nonsense"}}) {
    std::vector<std::string> all = {"contact"};
    all.insert(all.end(), words.begin(), words.end());
    const auto result = palpate(all);
    expectOneLineError(result, 2, {});
    EXPECT_EQ(result.out, "");
  }
  expectOneLineError(palpate({"contact", folder / "none.dsa"}), 1, {"none.dsa"});
}

TEST(ContactCommand, ASensorOfAnotherHandIsRefused) {
  const testing::TemporaryFolder folder;
  const auto pad =
      std::make_shared<SensorLayout>(std::vector<MatrixLayout>{MatrixLayout::full(4, 4, 3.4)});
  ProfileBuilder builder(pad);
  builder.addFrame(1'400'000'000'000'000, std::vector<float>(16, 1.0F));
  saveRecording(builder.finish({}), {}, folder / "pad.palpate");
  for (const std::string option : {"--matrices", "--size"})
    expectOneLineError(palpate({"contact", folder / "pad.palpate", option}),
                       1,
                       {"pad.palpate", "contains no geometry", "a surface in hand.json"});
}

// A hockey ball on another day: every grasp that `grasps` finds has a size.
TEST(ContactCommand, SizesOfTheGraspsOfARealRecording) {
  const auto shared = testing::recordingsFolder();
  PALPATE_NEED(shared);
  const std::string file = *shared / "grasps" / "hockey_ball.dsa";
  const auto result = palpate({"contact", file, "--size"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = csvRows(result.out), grasps = csvRows(palpate({"grasps", file}).out);
  ASSERT_EQ(rows.size(), grasps.size());
  ASSERT_GT(rows.size(), 10u);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')),
            "begin,end,matrix_a,matrix_b,start_frame,plateau_frame,start_mm,plateau_mm,shrink_mm,"
            "foam_mm,compression_mm,compression_sd_mm,diameter_mm,diameter_sd_mm,sphere_mm");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][0], grasps[i][0]);
    EXPECT_EQ(rows[i][1], grasps[i][1]);
    EXPECT_EQ(rows[i][2] + rows[i][3], "15") << "the two fingertips of a pinch grip";
    EXPECT_NEAR(number(rows[i][8]), number(rows[i][6]) - number(rows[i][7]), 1e-9);
    EXPECT_NEAR(number(rows[i][10]), number(rows[i][8]) - number(rows[i][9]), 1e-9);
    EXPECT_NEAR(number(rows[i][12]), 66.5, 4.0);
  }
}

}  // namespace
}  // namespace palpate::contact_command_test
