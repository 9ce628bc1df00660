#include "palpate/live/signals_stage.h"

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::signals_stage_test {
namespace {

TEST(SignalsStage, FillsInTheSignalsOfEveryMatrixAndThePeak) {
  auto frame = std::make_shared<TactileFrame>(sdh2().layout);
  frame->matrix(1)(4, 2) = 100.0F;
  frame->matrix(1)(4, 3) = 300.0F;
  LiveResults results;
  results.frame = frame;
  std::vector<Event> events;
  SignalsStage stage;
  stage.onFrame(results, events);
  ASSERT_EQ(results.matrixSignals.size(), 6u);
  EXPECT_DOUBLE_EQ(results.matrixSignals[1].mean, 200.0);
  EXPECT_DOUBLE_EQ(results.matrixSignals[1].minimum, 100.0);
  EXPECT_DOUBLE_EQ(results.matrixSignals[1].maximum, 300.0);
  EXPECT_DOUBLE_EQ(results.matrixSignals[1].sum, 400.0);
  EXPECT_EQ(results.matrixSignals[1].active, 2);
  EXPECT_DOUBLE_EQ(results.matrixSignals[1].areaMm2, 2 * 3.4 * 3.4);
  EXPECT_EQ(results.matrixSignals[0].active, 0);
  EXPECT_DOUBLE_EQ(results.wholeSignals.mean, 200.0);
  EXPECT_DOUBLE_EQ(results.wholeSignals.sum, 400.0);
  EXPECT_EQ(results.wholeSignals.active, 2);
  EXPECT_EQ(results.peak.matrix, 1u);
  EXPECT_EQ(results.peak.column, 3);
  EXPECT_TRUE(events.empty());
}

}  // namespace
}  // namespace palpate::signals_stage_test
