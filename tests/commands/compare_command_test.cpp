#include <sstream>

#include "palpate/calibration/calibration.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_writer.h"

#include "calibration/sample_calibrations.h"
#include "commands/palpate_program.h"

namespace palpate::compare_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

// `count` frames 100 ms apart; from `touched` on four taxels of matrix 1 have that many counts, one
// more of them per frame.
class CompareCommandTest : public ::testing::Test {
 protected:
  std::string recording(const char* name, int count, int touched, float counts) {
    ProfileBuilder builder(sdh2().layout);
    for (int i = 0; i < count; ++i) {
      TactileFrame frame(sdh2().layout);
      if (i >= touched)
        frame.matrix(1).block(6, 2, 2, 2).setConstant(counts + static_cast<float>(i - touched));
      builder.addFrame(1'400'000'000'000'000 + i * 100'000, frame.values);
    }
    writeDsa(builder.finish({}), folder_ / name, Overwrite::kReplace);
    return folder_ / name;
  }
  testing::TemporaryFolder folder_;
};

TEST_F(CompareCommandTest, PrintsWhatEachMatrixHasAtTheSameMoment) {
  const auto a = recording("a.dsa", 10, 2, 500.0F), b = recording("b.dsa", 12, 5, 300.0F);
  const auto result = palpate({"compare", a, b});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = lines(result.out);
  EXPECT_EQ(rows.at(0),
            "time_s,frame_a,frame_b,matrix,mean_a,mean_b,difference_mean,difference_rms");
  // B begins 0.3 s before A and ends 0.8 s after A's first frame: A's frames 0..8.
  ASSERT_EQ(rows.size(), 1u + 9u * 6u);
  EXPECT_EQ(rows.at(1 + 6 * 2 + 1), "0.200000,2,5,1,500,300,200,200");
  EXPECT_EQ(rows.at(1 + 6 * 1 + 1), "0.100000,1,4,1,0,0,0,0");
  EXPECT_EQ(rows.at(1 + 6 * 4 + 1), "0.400000,4,7,1,502,302,200,200");
  EXPECT_EQ(rows.at(1 + 6 * 4 + 2), "0.400000,4,7,2,0,0,0,0");
}

TEST_F(CompareCommandTest, OtherAlignments) {
  const auto a = recording("a.dsa", 10, 2, 500.0F), b = recording("b.dsa", 12, 5, 300.0F);
  const auto start = lines(palpate({"compare", a, b, "--align", "start"}).out);
  EXPECT_EQ(start.at(1 + 6 * 2 + 1), "0.200000,2,2,1,500,0,500,500");
  EXPECT_EQ(lines(palpate({"compare", a, b, "--align", "clock"}).out), start);
  const auto byHand = lines(palpate({"compare", a, b, "--offset", "-0.3"}).out);
  EXPECT_EQ(byHand, lines(palpate({"compare", a, b}).out));
  const auto apart = palpate({"compare", a, b, "--offset", "90"});
  EXPECT_EQ(apart.exitCode, 0);
  EXPECT_EQ(lines(apart.out).size(), 1u);
  EXPECT_NE(apart.err.find("no moment in common"), std::string::npos);
}

TEST_F(CompareCommandTest, SaysWhatIsWrong) {
  const auto a = recording("a.dsa", 10, 2, 500.0F), rest = recording("rest.dsa", 5, 5, 0.0F);
  expectOneLineError(
      palpate({"compare", a, rest}), 1, {"rest.dsa", "no lasting contact", "--align start"});
  EXPECT_EQ(palpate({"compare", a, rest, "--align", "start"}).exitCode, 0);
  expectOneLineError(palpate({"compare", a, folder_ / "none.dsa"}), 1, {"none.dsa"});
  EXPECT_EQ(palpate({"compare", a}).exitCode, 2);
  EXPECT_EQ(palpate({"compare", a, a, "--align", "thumb"}).exitCode, 2);
  EXPECT_EQ(palpate({"compare", a, a, "--align", "start", "--offset", "1"}).exitCode, 2);
}

// Grasps of 25 frames each with two fingers, at rest between them: `counts` of each grasp, one more
// per frame.
std::string withGrasps(const std::string& file, const std::vector<float>& counts) {
  ProfileBuilder builder(sdh2().layout);
  int frame = 0;
  for (const float of : counts)
    for (int i = 0; i < 35; ++i, ++frame) {
      TactileFrame tactile(sdh2().layout);
      if (i >= 10)
        for (const std::size_t matrix : {1u, 3u, 5u})
          tactile.matrix(matrix).block(6, 2, 2, 2).setConstant(of + static_cast<float>(i - 10));
      builder.addFrame(1'400'000'000'000'000 + frame * 100'000, tactile.values);
    }
  writeDsa(builder.finish({}), file, Overwrite::kReplace);
  return file;
}

TEST_F(CompareCommandTest, AlignsTwoGrasps) {
  const auto a = withGrasps(folder_ / "a.dsa", {500, 600}),
             b = withGrasps(folder_ / "b.dsa", {300});
  const auto result = palpate({"compare", a, b, "--grasp", "2:1"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = lines(result.out);
  // The second grasp of A is frames 45 to 69 from 4.5 s on, the only one of B 10 to 34.
  EXPECT_NE(result.err.find("both grasps last from time_s 4.500000 to 6.900000;"),
            std::string::npos)
      << result.err;
  EXPECT_EQ(palpate({"compare", a, b, "--grasp", "2:1", "--quiet"}).err, "");
  EXPECT_EQ(rows.at(1 + 1), "3.500000,35,0,1,0,0,0,0");
  EXPECT_EQ(rows.at(1 + 6 * 10 + 1), "4.500000,45,10,1,600,300,300,300");
  EXPECT_EQ(lines(palpate({"compare", a, a, "--grasp", "1"}).out).at(1 + 6 * 10 + 1),
            "1.000000,10,10,1,500,500,0,0");
  expectOneLineError(palpate({"compare", a, b, "--grasp", "1:2"}), 1, {"b.dsa", "only 1..1"});
  expectOneLineError(palpate({"compare", a, b, "--grasp", "0:1"}), 2, {"from 1"});
  expectOneLineError(palpate({"compare", a, b, "--grasp", "1:x"}), 2, {"I:J"});
  expectOneLineError(
      palpate({"compare", a, b, "--grasp", "1:1", "--offset", "1"}), 2, {"not both"});
  const auto none = recording("none.dsa", 10, 2, 500.0F);
  expectOneLineError(palpate({"compare", a, none, "--grasp", "1:1"}), 1, {"none.dsa", "no grasp"});
}

// By hand: at the contact 500, 600 and 300, at 1 s 510, 610 and 310: mean 466.67, standard
// deviation sqrt((33.33^2 + 133.33^2 + 166.67^2) / 2) = 152.7525.
TEST_F(CompareCommandTest, PrintsTheAverageOverGrasps) {
  const auto a = withGrasps(folder_ / "a.dsa", {500, 600}),
             b = withGrasps(folder_ / "b.dsa", {300});
  const auto result = palpate({"compare", a, b, "--average", "m1_mean"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto rows = lines(result.out);
  EXPECT_EQ(rows.at(0), "time_s,curves,mean,low,high,a.dsa grasp 1,a.dsa grasp 2,b.dsa grasp 1");
  // analyst m12: with one name in two folders, the paths.
  std::filesystem::create_directory(folder_ / "other");
  const auto other = withGrasps(folder_ / "other" / "a.dsa", {300});
  const auto paths = palpate({"compare", a, other, "--average", "m1_mean"});
  EXPECT_EQ(
      lines(paths.out).at(0),
      "time_s,curves,mean,low,high," + a + " grasp 1," + a + " grasp 2," + other + " grasp 1");
  // From 0.5 s before to the end of the recording or 0.5 s behind the grasp.
  EXPECT_EQ(rows.at(1), "-0.500000,3,0,0,0,0,0,0");
  std::vector<double> cells;
  std::istringstream row(rows.at(1 + 5 + 10));
  for (std::string cell; std::getline(row, cell, ',');) cells.push_back(*parseDouble(cell));
  const std::vector<double> expected = {
      1.0, 3, 476.6666667, 323.9141435, 629.4191898, 510, 610, 310};
  ASSERT_EQ(cells.size(), expected.size());
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_NEAR(cells[i], expected[i], 1e-5) << i;
  const auto median =
      lines(palpate({"compare", a, b, "--average", "1:mean", "--percentiles", "0,100"}).out);
  EXPECT_TRUE(median.at(0).starts_with("time_s,curves,median,p0,p100,")) << median.at(0);
  EXPECT_TRUE(median.at(1 + 5 + 10).starts_with("1.000000,3,510,310,610,")) << median.at(16);
  // Whole recordings, and a formula.
  const auto whole =
      lines(palpate({"compare", a, b, "--average", "2*m1_mean", "--of", "recordings"}).out);
  EXPECT_TRUE(whole.at(1 + 10).starts_with("0.000000,2,800,")) << whole.at(11);
}

// The four taxels are those of columns 2 and 3, 3.4 mm apart.
TEST_F(CompareCommandTest, AveragesComputedSeries) {
  const auto a = recording("a.dsa", 10, 2, 1500.0F), b = recording("b.dsa", 12, 5, 1300.0F);
  const auto averageOf = [&](const std::string& signal, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"compare", a, b, "--of", "recordings", "--average", signal});
    return palpate(more);
  };
  const auto centroid = averageOf("m1_centroid_x_mm");
  ASSERT_EQ(centroid.exitCode, 0) << centroid.err;
  EXPECT_NE(centroid.out.find("\n0.000000,2,8.5,8.5,8.5,8.5,8.5\n"), std::string::npos)
      << centroid.out;
  EXPECT_NE(averageOf("m1_pressure_kpa").err.find("needs a calibration: --calibration"),
            std::string::npos);
  // Of an indenter without area pressures are known, forces not.
  const std::string known = folder_ / "c.json";
  Calibration calibration = testing::linearCalibration({});
  for (std::size_t i = 0; i < calibration.samples.size(); ++i)  // 35 deg C is assumed
    calibration.samples[i].nearestDegC = 28.0 + 8.0 * static_cast<double>(i % 3);
  calibration.pressure = fitPressureModel(calibration.samples, {});
  saveCalibration(calibration, known, Overwrite::kRefuse);
  const auto pressure = averageOf("m1_pressure_kpa", {"--calibration", known});
  EXPECT_EQ(pressure.exitCode, 0) << pressure.err;
  EXPECT_NE(pressure.out.find("\n0.000000,2,"), std::string::npos) << pressure.out;
  const auto force = averageOf("m1_force_n", {"--calibration", known, "--quiet"});
  EXPECT_EQ(force.exitCode, 3) << force.err;
  EXPECT_EQ(lines(force.err).size(), 1u) << force.err;
  expectOneLineError(
      palpate({"compare", a, b, "--calibration", known}), 2, {"--calibration needs --average"});
}

TEST_F(CompareCommandTest, SaysWhatIsWrongWithAnAverage) {
  const auto a = withGrasps(folder_ / "a.dsa", {500});
  const auto none = recording("none.dsa", 10, 2, 500.0F);
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"compare", a, "--average", "m1_mean"};
    words.insert(words.end(), more.begin(), more.end());
    return palpate(words);
  };
  expectOneLineError(with({none}), 1, {"none.dsa", "no grasp"});
  EXPECT_EQ(with({none, "--of", "recordings"}).exitCode, 0);
  expectOneLineError(with({"--percentiles", "90,10"}), 2, {"LOW,HIGH"});
  expectOneLineError(with({"--grasp", "1:1"}), 2, {"leave out --grasp"});
  expectOneLineError(with({"--align", "start"}), 2, {"--of recordings"});
  expectOneLineError(
      palpate({"compare", a, "--average", "m1_meen"}), 2, {"m1_meen", "not a signal"});
  expectOneLineError(palpate({"compare", a, "--average", "m1_mean+"}), 2, {"as a formula"});
  expectOneLineError(palpate({"compare", a, "--average", "m9_mean"}), 1, {"no matrix 9"});
  expectOneLineError(palpate({"compare", a, a, "--band", "sd"}), 2, {"needs --average"});
}

TEST_F(CompareCommandTest, ARecordingWithItselfDiffersInNothing) {
  const auto a = recording("a.dsa", 6, 1, 40.0F);
  const auto rows = lines(palpate({"compare", a, a}).out);
  ASSERT_EQ(rows.size(), 1u + 36u);
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_TRUE(rows[i].ends_with(",0,0")) << rows[i];
}

}  // namespace
}  // namespace palpate::compare_command_test
