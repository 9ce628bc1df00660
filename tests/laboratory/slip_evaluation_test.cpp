#include "palpate/laboratory/slip_evaluation.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::slip_evaluation_test {
namespace {

// Matrix 1: the contact rests at 4.5 until frame 50, then moves by `step` per frame for 10 frames.
Profile moving(double step) {
  ProfileBuilder builder(sdh2().layout);
  SyntheticSensor sensor;
  sensor.layout = sdh2().layout->matrix(1);
  SyntheticSlip slip(sensor, 1);
  std::int64_t nowUs = 1'400'000'000'000'000;
  for (int i = 0; i < 90; ++i) {
    TactileFrame frame(sdh2().layout);
    slip.read({.y = 4.5 + step * std::clamp(i - 50, 0, 10)}, frame.matrix(1));
    builder.addFrame(nowUs += 40'000, frame.values);
  }
  return builder.finish({});
}

// At 0.2 taxel per frame the contact moves by more than 1 taxel within 10 frames from frame 56 to
// 64. In frame 52 it is 0.2 taxel away from its position in frame 46.
TEST(LabelSlips, GoesByTheRule) {
  const auto labels = labelSlips(moving(0.2));
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].matrix, 1U);
  EXPECT_NEAR(static_cast<double>(labels[0].onset), 52.0, 1.0);
  EXPECT_NEAR(static_cast<double>(labels[0].end), 64.0, 1.0);
  EXPECT_TRUE(labelSlips(moving(0.09)).empty());
}

TEST(SlipEvaluation, CountsHoursAlarmsAndDelays) {
  SlipEvaluation evaluation;
  evaluation.addSlipRecording(moving(0.2));
  evaluation.addNoSlipRecording(moving(0.0));
  // The recording is given as free of slip but contains slip: a false alarm.
  evaluation.addNoSlipRecording(moving(0.2));
  const SlipScore score = evaluation.score({}, false);
  EXPECT_EQ(score.slips, 1U);
  EXPECT_EQ(score.found, 1U);
  ASSERT_EQ(score.delaysFrames.size(), 1U);
  EXPECT_LE(score.delaysFrames[0], 2);
  EXPECT_EQ(score.falseAlarms[kSettledContact], 1U);
  EXPECT_NEAR(score.matrixHours[kAllContact], 2 * 90 * 0.04 / 3600.0, 1e-9);
  EXPECT_NEAR(score.matrixHours[kSettledContact], 2 * 76 * 0.04 / 3600.0, 1e-9);
  EXPECT_NEAR(score.perHour(kSettledContact), 3600.0 / (2 * 76 * 0.04), 1e-6);
  EXPECT_EQ(evaluation.score({}, false, 0).falseAlarms[kAllContact], 0U);
  EXPECT_EQ(evaluation.score({}, false, 1).falseAlarms[kAllContact], 1U);
  EXPECT_EQ(evaluation.report().alarms.size(), 7U);
}

TEST(SlipEvaluation, OfNothingIsEmpty) {
  const SlipEvaluationReport report = SlipEvaluation().report();
  for (const ScoredAlarm& alarm : report.alarms) {
    EXPECT_EQ(alarm.score.perHour(kAllContact), 0.0);
    EXPECT_EQ(alarm.score.detectionRate(), 0.0);
  }
  EXPECT_EQ(SlipEvaluation().fitSlipSequence(0, SlipFolds::kRecordings).sequence.threshold,
            SlipSequenceOptions{}.threshold);
}

}  // namespace
}  // namespace palpate::slip_evaluation_test
