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

}  // namespace
}  // namespace palpate::testing::kill_recording_test
