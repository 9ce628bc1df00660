#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_writer.h"

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

TEST_F(CompareCommandTest, ARecordingWithItselfDiffersInNothing) {
  const auto a = recording("a.dsa", 6, 1, 40.0F);
  const auto rows = lines(palpate({"compare", a, a}).out);
  ASSERT_EQ(rows.size(), 1u + 36u);
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_TRUE(rows[i].ends_with(",0,0")) << rows[i];
}

}  // namespace
}  // namespace palpate::compare_command_test
