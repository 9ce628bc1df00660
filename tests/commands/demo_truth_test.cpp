// What is said of a slip, of made-up truths and findings.
#include "commands/demo_truth.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpate::commands::demo_truth_test {
namespace {

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;
constexpr std::int64_t kFrameUs = 30'000;
constexpr double kPitchMm = 3.4;

std::int64_t timeUs(std::size_t frame) {
  return kStartUs + static_cast<std::int64_t>(frame) * kFrameUs;
}

// Held by matrices 1 and 5 from frame 20 on; between frames 100 and 140 it moves 0.1 taxel a frame
// over matrix 1, half of that over matrix 5; let go in frame 200.
std::vector<DemoTruthFrame> pulledTruth(double stepTaxels = 0.1) {
  std::vector<DemoTruthFrame> truth;
  for (std::size_t i = 0; i < 220; ++i) {
    DemoTruthFrame frame{timeUs(i), static_cast<double>(i) * 0.03, std::vector<MatrixTruth>(6)};
    const double steps = std::clamp(static_cast<double>(i) - 100.0, 0.0, 40.0);
    if (i >= 20 && i < 200) {
      // It had moved before, while the fingers closed.
      frame.matrices[1] = {
          .contact = true, .forceN = 8.0, .slipXTaxels = 0.7, .slipYTaxels = -steps * stepTaxels};
      frame.matrices[5] = {
          .contact = true, .forceN = 8.0, .slipYTaxels = -steps * stepTaxels / 2.0};
    }
    truth.push_back(frame);
  }
  return truth;
}

SlipSegment alarmOf(std::size_t matrix, std::size_t begin, std::size_t end) {
  return {
      .begin = begin, .end = end, .beginUs = timeUs(begin), .endUs = timeUs(end), .matrix = matrix};
}

// Samples of matrix 1 whose imprint is 0.02 taxel further in each frame behind the 100th.
SlipSeries seriesWith(std::vector<SlipSegment> slips) {
  SlipSeries series;
  series.firstUs = kStartUs;
  series.matrices.resize(6);
  for (std::size_t i = 0; i < 220; ++i) {
    series.timeS.push_back(static_cast<double>(i) * 0.03);
    SlipSample sample;
    sample.frame = static_cast<std::uint32_t>(i);
    sample.refValid = true;
    sample.refDy = static_cast<float>(0.02 * std::max(0.0, static_cast<double>(i) - 100.0));
    sample.indicator = SlipIndicator::kSlipping;
    sample.state = SlipState::kSlip;
    if (i >= 20) series.matrices[1].push_back(sample);
  }
  series.slips = std::move(slips);
  return series;
}

TEST(DemoTruth, TellsWhenAHeldObjectBeganToMoveAndHowFarItWent) {
  const auto motion = demoMotion(pulledTruth(), 2.0, 5.5);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->matrix, 1u);
  EXPECT_NEAR(motion->movedTaxels, 4.0, 1e-9);
  EXPECT_NEAR(static_cast<double>(motion->beganUs), static_cast<double>(timeUs(101)), kFrameUs);
  EXPECT_NEAR(static_cast<double>(motion->endedUs), static_cast<double>(timeUs(139)), kFrameUs);
}

TEST(DemoTruth, KnowsNoMotionOfWhatStayedOrWasNotHeld) {
  EXPECT_FALSE(demoMotion(pulledTruth(0.02), 2.0, 5.5)) << "less than a taxel";
  EXPECT_FALSE(demoMotion(pulledTruth(), 0.1, 5.5)) << "not held at the begin";
  EXPECT_FALSE(demoMotion(pulledTruth(), 2.0, 2.5)) << "before it moved";
  EXPECT_FALSE(demoMotion({}, 2.0, 5.5));
}

TEST(DemoTruth, TheFirstAlarmOfTheMotionCounts) {
  const auto motion = demoMotion(pulledTruth(), 2.0, 5.5);
  ASSERT_TRUE(motion);
  // One while the fingers close, one too early, two of the motion, one when it is let go.
  const DemoSlip slip = demoSlip(seriesWith({alarmOf(5, 22, 30),
                                             alarmOf(1, 80, 82),
                                             alarmOf(1, 105, 150),
                                             alarmOf(5, 108, 140),
                                             alarmOf(1, 200, 205)}),
                                 pulledTruth(),
                                 2.0,
                                 *motion);
  ASSERT_TRUE(slip.alarm);
  EXPECT_EQ(slip.alarm->matrix, 1u);
  EXPECT_EQ(slip.alarm->frame, 105u);
  EXPECT_EQ(slip.alarm->lastFrame, 150u);
  EXPECT_NEAR(slip.alarm->atS, 3.15, 1e-9);
  EXPECT_NEAR(slip.alarm->afterS, static_cast<double>(timeUs(105) - motion->beganUs) * 1e-6, 1e-9);
  EXPECT_NEAR(slip.alarm->movedTaxels, 0.5, 1e-9);
  EXPECT_NEAR(slip.alarm->imprintTaxels, 1.0, 1e-6);
  EXPECT_EQ(slip.alarm->furthestFrame, 150u);
  EXPECT_EQ(slip.matrices, (std::vector<std::size_t>{1, 5}));
  EXPECT_EQ(slip.early, 1u);
  const std::string text = demoSlipText(slip, kPitchMm);
  for (const char* part : {"4.0 taxels (13.6 mm)",
                           "matrix 1",
                           "'slipping'",
                           "frame 105",
                           "it went 1.0",
                           "1 false alarm before"})
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  const Json json = demoSlipJson(slip, kPitchMm);
  EXPECT_TRUE(json.at("seen").asBool());
  EXPECT_EQ(json.at("alarm").at("frame").asInteger(), 105);
  EXPECT_EQ(json.at("alarm").at("lamp").asString(), "slipping");
  EXPECT_EQ(json.at("alarm").at("state").asString(), "slip");
  EXPECT_NEAR(json.at("truth").at("moved_mm").asDouble(), 13.6, 1e-6);
}

TEST(DemoTruth, ASlipThatNothingSawIsSaid) {
  const auto motion = demoMotion(pulledTruth(), 2.0, 5.5);
  ASSERT_TRUE(motion);
  const DemoSlip slip = demoSlip(seriesWith({alarmOf(1, 200, 205)}), pulledTruth(), 2.0, *motion);
  EXPECT_FALSE(slip.alarm);
  EXPECT_NE(demoSlipText(slip, kPitchMm).find("no alarm was raised"), std::string::npos);
  EXPECT_FALSE(demoSlipJson(slip, kPitchMm).at("seen").asBool());
  EXPECT_FALSE(demoSlipJson(slip, kPitchMm).contains("alarm"));
}

}  // namespace
}  // namespace palpate::commands::demo_truth_test
