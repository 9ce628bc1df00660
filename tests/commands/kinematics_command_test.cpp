#include <map>
#include <sstream>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/kinematics/hand_geometry.h"

#include "testing/program.h"
#include "testing/sdh2.h"
#include "testing/testing.h"

namespace palpate::testing::kinematics_command_test {
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
      HandGeometry(sdh2Geometry()).pose({0, -10.5, 20, -30, 40, 5, -6}).positionMm(3, 4, 2);
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

// Every point of the golden file through the real program, whose joints stand where recordings have
// them: a hair beyond their range.
TEST(KinematicsCommand, AgreesWithTheGoldenNumbers) {
  const auto golden = goldenFolder();
  PALPATE_NEED(golden);
  std::map<std::string, std::map<std::string, std::vector<double>>> expected;  // by angles, place
  for (const std::string& line : linesOf(readFile(*golden / "forward_kinematics.csv"))) {
    if (line.rfind("taxel,", 0) != 0) continue;
    std::istringstream in(line);
    std::vector<std::string> fields;
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    ASSERT_EQ(fields.size(), 15u);
    std::string angles = fields[2];
    for (std::size_t i = 3; i < 9; ++i) angles += "," + fields[i];
    for (std::size_t i = 12; i < 15; ++i)
      expected[angles][fields[9] + "," + fields[10] + "," + fields[11]].push_back(
          parseDouble(fields[i]).value());
  }
  ASSERT_EQ(expected.size(), 8u);
  for (const auto& [angles, places] : expected) {
    const auto result = run({"--angles", angles});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    std::size_t found = 0;
    for (const std::string& line : linesOf(result.out)) {
      std::istringstream in(line);
      std::vector<std::string> fields;
      for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
      const auto place = places.find(fields[0] + "," + fields[1] + "," + fields[2]);
      if (place == places.end()) continue;
      ++found;
      double length = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(parseDouble(fields[3 + i]).value(), place->second[i], 1e-9) << line;
        length += parseDouble(fields[6 + i]).value() * parseDouble(fields[6 + i]).value();
      }
      EXPECT_NEAR(length, 1.0, 1e-12) << line;
    }
    EXPECT_EQ(found, 486u);
  }
}

TEST(KinematicsCommand, SaysWhichMatricesThereAre) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--matrix", "6"}, {"--point", "7,2,3"}, {"--point", "1e30,2,3"}}) {
    const auto result = run({"--angles", "0,0,0,0,0,0,0", words[0], words[1]});
    EXPECT_EQ(result.exitCode, 1) << words[1];
    EXPECT_NE(result.err.find("only 0..5"), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

TEST(KinematicsCommand, WritesAFile) {
  const testing::TemporaryFolder folder;
  const std::vector<std::string> words = {"--angles", "0,0,0,0,0,0,0", "--matrix", "1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run(more);
  };
  const std::string out = folder / "taxels.csv";
  EXPECT_EQ(with({"-o", out}).out, out + "\n");
  EXPECT_EQ(testing::readFile(out), with({}).out);
  EXPECT_EQ(with({"-o", out}).exitCode, 1) << "it exists";
  EXPECT_EQ(with({"-o", out, "--force"}).exitCode, 0);
  EXPECT_EQ(with({"-o", folder / "taxels.txt"}).exitCode, 2);
  EXPECT_EQ(with({"-o", folder / "{name}.csv"}).exitCode, 2);
  const auto units = with({"--units-row"});
  EXPECT_NE(units.out.find("\n,taxels,taxels,mm,mm,mm,,,,\n"), std::string::npos) << units.out;
  const Json table = Json::parse(with({"--json"}).out);
  EXPECT_EQ(table.at("table").asString(), "kinematics");
  EXPECT_EQ(table.at("rows").size(), 13u * 6u);
}

TEST(KinematicsCommand, WrongUsageIsSaidInOneLine) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {},
           {"--angles", "0,0,0"},
           {"--angles", "0,0,0,0,0,0,0,0"},
           {"--angles", "0,0,zero,0,0,0,0"},
           {"--angles", "0,0,nan,0,0,0,0"},
           {"--angles", "0,0,,0,0,0,0"},
           {"--angles", "0,0,0,0,0,0,inf"},
           {"--angles", "0,0,0,0,0,0,92"},
           {"--angles", "-2,0,0,0,0,0,0"},
           {"--angles", "0,0,0,0,0,0,0", "--matrix", "-1"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "1,2"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "1.5,2,3"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "-1,2,3"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "0,2,inf"},
           {"--angles", "0,0,0,0,0,0,0", "--point", "0,1e300,3"},
           {"--angles", "0,0,0,0,0,0,0", "--fingertip", "round"},
           {"--angles", "0,0,0,0,0,0,0", "--matrix", "1", "--point", "1,2,3"}}) {
    const auto result = run(words);
    EXPECT_EQ(result.exitCode, 2) << ::testing::PrintToString(words);
    EXPECT_EQ(linesOf(result.err).size(), 1u) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

}  // namespace
}  // namespace palpate::testing::kinematics_command_test
