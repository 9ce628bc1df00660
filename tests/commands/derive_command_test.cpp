#include <algorithm>
#include <cmath>
#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/formula.h"

#include "commands/palpate_program.h"

namespace palpate::derive_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

class DeriveCommandTest : public ::testing::Test {
 protected:
  static Profile saved(const std::string& file) {
    saveRecording(synthesize({.durationS = 6.0, .grasps = 2}), {}, file);
    return openRecording(file);
  }
  testing::TemporaryFolder folder_;
  const std::string file_ = folder_ / "in.dsa";
  const Profile profile_ = saved(file_);
};

TEST_F(DeriveCommandTest, PrintsAColumnForEachFormula) {
  const auto result = palpate({"derive", file_, "double=2*hand_sum", "rate=der(m1_mean)"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::istringstream lines(result.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "frame,time_s,double,rate");
  const Series twice = formulaSeries(profile_, Formula("2*hand_sum"), 0.0, 7.0);
  const Series rate = formulaSeries(profile_, Formula("der(m1_mean)"), 0.0, 7.0);
  std::size_t frame = 0;
  for (; std::getline(lines, line); ++frame) {
    std::vector<double> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');)
      cells.push_back(parseDouble(cell).value_or(std::nan("")));
    ASSERT_EQ(cells.size(), 4u);
    EXPECT_EQ(cells[0], static_cast<double>(frame));
    EXPECT_EQ(cells[2], twice.values[frame]);
    EXPECT_EQ(cells[3], rate.values[frame]);
  }
  EXPECT_EQ(frame, profile_.numFrames());
}

TEST_F(DeriveCommandTest, AFormulaCanBeItsOwnNameAndCompare) {
  const auto result = palpate({"derive", file_, "hand_sum>=100", "--from", "3", "--to", "4"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), "frame,time_s,hand_sum>=100");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
  // An unknown value is an empty cell.
  const auto none = palpate({"derive", file_, "sqrt(0-1-m1_sum)", "--to", "0"});
  ASSERT_EQ(none.exitCode, 0) << none.err;
  EXPECT_TRUE(none.out.ends_with(",\n")) << none.out;
}

TEST_F(DeriveCommandTest, SaysWhatIsWrong) {
  expectOneLineError(palpate({"derive", file_}), 2, {});
  expectOneLineError(palpate({"derive", file_, "a=1+"}), 2, {"formula \"1+\""});
  expectOneLineError(palpate({"derive", file_, "m1_meen"}), 1, {"there is no signal \"m1_meen\""});
  expectOneLineError(palpate({"derive", file_, "m9_mean"}), 1, {"there is no signal \"m9_mean\""});
  expectOneLineError(palpate({"derive", file_, "a=m1_mean", "a=m3_mean"}), 2, {"the name 'a'"});
  expectOneLineError(palpate({"derive", file_, "frame=m1_mean"}), 2, {"the name 'frame'"});
  expectOneLineError(palpate({"derive", file_, "angle99"}), 1, {"has no angle99"});
  expectOneLineError(
      palpate({"derive", file_, "hand_sum", "--from", "9", "--to", "3"}), 2, {"--from"});
}

TEST_F(DeriveCommandTest, ComputedSeriesAreSignals) {
  const auto result = palpate({"derive", file_, "x=m1_centroid_x_mm/m1_centroid_x_mm"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find(",1\n"), std::string::npos) << "where matrix 1 is touched";
  EXPECT_NE(result.out.find(",\n"), std::string::npos) << "where it isn't";
  expectOneLineError(palpate({"derive", file_, "m1_mean - hand_force_n"}),
                     1,
                     {"needs a calibration: --calibration C.json"});
}

}  // namespace
}  // namespace palpate::derive_command_test
