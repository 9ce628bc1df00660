// Recorders killed, short form (reliability R1).
#include "commands/kill_recording.h"

#include "testing/time_limit.h"

namespace palpate::testing::kill_recording_test {
namespace {

TEST(KillRecording, FilesOpenAndHoldAllButTheLastMoment) {
  const KillFigures figures = killRecordings(PALPATE_PROGRAM, 8, 2);
  EXPECT_EQ(figures.opened, 8);
  EXPECT_LE(figures.mostLostMs, timeLimit(150.0));
}

// The hand, a load cell at 1 kHz, an IMU at 200 Hz and a wrist at 20 Hz.
TEST(KillRecording, OfFourSourcesEachIsThereUpToTheLastMoment) {
  const KillFigures figures = killRecordings(PALPATE_PROGRAM, 8, 2, 3);
  EXPECT_EQ(figures.opened, 8);
  EXPECT_GT(figures.samples, 0u);
  EXPECT_LE(figures.mostLostMs, timeLimit(150.0));
}

}  // namespace
}  // namespace palpate::testing::kill_recording_test
