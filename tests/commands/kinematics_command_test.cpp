#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/kinematics/hand_geometry.h"

#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing {
namespace {

ProgramResult run(const std::vector<std::string>& words) {
  std::vector<std::string> all = {"kinematics"};
  all.insert(all.end(), words.begin(), words.end());
  return runProgram(PALPATE_PROGRAM, all);
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Zero pose: the golden file's first row, digits that were printed there.
TEST(KinematicsCommand, PrintsPositionsAndNormals) {
  const auto result = run({"--angles", "0,0,0,0,0,0,0"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), 487u);
  EXPECT_EQ(lines[0], "matrix,x,y,x_mm,y_mm,z_mm,nx,ny,nz,exists");
  EXPECT_EQ(lines[1].substr(0, 17), "0,0,0,3.652558883");
  EXPECT_NE(lines[1].find(",-24.5,82.5"), std::string::npos) << lines[1];
  EXPECT_EQ(lines[1].back(), '1');
  EXPECT_EQ(lines[1 + 84].back(), '0') << "the cut corner of a fingertip";
}

TEST(KinematicsCommand, OneMatrixOrOnePoint) {
  const std::string angles = "-0,-10.5,2e1,-30,40,5,-6";  // a leading minus is no option
  const auto matrix = run({"--angles", angles, "--matrix", "3"});
  ASSERT_EQ(matrix.exitCode, 0) << matrix.err;
  EXPECT_EQ(linesOf(matrix.out).size(), 79u);
  const auto point = run({"--angles=" + angles, "--point", "3,6.8,13.6"});
  ASSERT_EQ(point.exitCode, 0) << point.err;
  const auto lines = linesOf(point.out);
  ASSERT_EQ(lines.size(), 2u);
  const Eigen::Vector3d expected =
      HandGeometry().pose({0, -10.5, 20, -30, 40, 5, -6}).positionMm(3, 4, 2);
  EXPECT_EQ(lines[1].substr(0, 6), "3,2,4,") << lines[1];
  std::istringstream fields(lines[1].substr(6));
  for (int i = 0; i < 3; ++i) {
    std::string field;
    std::getline(fields, field, ',');
    EXPECT_NEAR(parseDouble(field).value(), expected[i], 1e-9);
  }
  const auto beyond = run({"--angles", angles, "--point", "3,-100,3"});
  EXPECT_EQ(linesOf(beyond.out)[1].back(), '0');
}

TEST(KinematicsCommand, TheEffectiveFingertipBendsMore) {
  const auto study = run({"--angles", "0,0,0,0,0,0,0", "--matrix", "1"});
  const auto effective =
      run({"--angles", "0,0,0,0,0,0,0", "--matrix", "1", "--fingertip", "effective"});
  EXPECT_EQ(effective.exitCode, 0);
  EXPECT_NE(linesOf(study.out)[1], linesOf(effective.out)[1]);
  EXPECT_EQ(linesOf(study.out)[78], linesOf(effective.out)[78]);
}

TEST(KinematicsCommand, WrongUsageIsSaidInOneLine) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {},
           {"--angles", "0,0,0"},
           {"--angles", "0,0,0,0,0,0,0,0"},
           {"--angles", "0,0,zero,0,0,0,0"},
           {"--angles", "0,0,nan,0,0,0,0"},
           {"--angles", "0,0,,0,0,0,0"},
           {"--angles", "0,0,0,0,0,0,0", "--matrix", "6"},
           {"--angles", "0,0,0,0,0,0,0", "--matrix", "-1"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "1,2"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "1.5,2,3"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "7,2,3"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "-1,2,3"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "0,2,inf"},
           {"--angles", "0,0,0,0,0,0,0", "--fingertip", "round"},
           {"--angles", "0,0,0,0,0,0,0", "--matrix", "1", "--point", "1,2,3"}}) {
    const auto result = run(words);
    EXPECT_EQ(result.exitCode, 2) << ::testing::PrintToString(words);
    EXPECT_EQ(linesOf(result.err).size(), 1u) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

}  // namespace
}  // namespace palpate::testing
