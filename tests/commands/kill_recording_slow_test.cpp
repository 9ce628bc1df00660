// A thousand killed recorders (reliability R1).
#include "commands/kill_recording.h"

namespace palpate::testing::kill_recording_slow_test {
namespace {

// In parts: each stays below the time a test may take.
class KillRecordingSlow : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Part, KillRecordingSlow, ::testing::Range(0, 4));

TEST_P(KillRecordingSlow, TwoHundredAndFiftyKills) {
  const KillFigures figures = killRecordings(PALPATE_PROGRAM, 250, 4);
  EXPECT_EQ(figures.opened, 250);
  EXPECT_LE(figures.mostLostMs, 150.0);
}

TEST(KillRecordingSlow, AHundredKillsOfFourSources) {
  const KillFigures figures = killRecordings(PALPATE_PROGRAM, 100, 2, 3);
  EXPECT_EQ(figures.opened, 100);
  EXPECT_LE(figures.mostLostMs, 150.0);
}

}  // namespace
}  // namespace palpate::testing::kill_recording_slow_test
