#include "palpate/slip/slip_sequence.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/slip/slip_rule.h"

namespace palpate::slip_sequence_test {
namespace {

TEST(SlipSequence, FeaturesAreThoseOfTheHeader) {
  SlipEvidence evidence{
      .computable = true, .contactAge = 12, .windows = {}, .last = {}, .recent = {}};
  evidence.recent.centroidX = 0.3;
  evidence.recent.centroidY = -0.4;
  evidence.recent.logLoadRatio = -0.2;
  evidence.recent.jointsDeg = 1.0;
  evidence.recent.hypotheses.loadShiftResidual = 7.0;
  evidence.recent.hypotheses.motionResidual = 1.0;
  evidence.last.centroidX = 3.0;
  evidence.last.logLoadRatio = 2.0;
  const SlipFeatures features = slipFeatures(evidence, 2.0, 0.1);
  EXPECT_EQ(features[0], 0.0);
  EXPECT_DOUBLE_EQ(features[1], 0.2);
  EXPECT_DOUBLE_EQ(features[2], std::log(0.05 + 2.0 * 0.5 - 0.1));
  EXPECT_DOUBLE_EQ(features[3], std::log(8.0) - std::log(2.0));
  EXPECT_DOUBLE_EQ(features[4], std::log(2.0));
  EXPECT_EQ(features[5], 1.5);
  EXPECT_EQ(features[6], 0.0);
  EXPECT_EQ(features[7], 2.0);
  EXPECT_DOUBLE_EQ(features[8], std::exp(-3.0));
  EXPECT_DOUBLE_EQ(features[9], std::exp(-1.0));
}

// Without a comparison the residuals say nothing.
TEST(SlipSequence, SmallShiftsHaveNoResiduals) {
  SlipEvidence evidence{
      .computable = true, .contactAge = 50, .windows = {}, .last = {}, .recent = {}};
  evidence.recent.centroidX = kMinComparedShift;
  evidence.recent.hypotheses.loadShiftResidual = 100.0;
  EXPECT_EQ(slipFeatures(evidence, 1.0, 0.0)[3], 0.0);
  evidence.recent.centroidX = 0.051;
  EXPECT_DOUBLE_EQ(slipFeatures(evidence, 1.0, 0.0)[3], std::log(101.0));
}

// One weight of 1 and a memory of 0.5: 3, 3.5 + 4 (limited), then down to 0.
TEST(SlipSequence, AddsUpForgetsAndIsNeverNegative) {
  SlipSequenceOptions options{
      .bias = 0.0, .weights = {1.0}, .memory = 0.5, .mostPerFrame = 4.0, .threshold = 5.0};
  SlipSequence sequence(options);
  EXPECT_DOUBLE_EQ(sequence.add({3.0}), 3.0);
  EXPECT_FALSE(sequence.exceeds());
  EXPECT_DOUBLE_EQ(sequence.add({100.0}), 5.5);
  EXPECT_TRUE(sequence.exceeds());
  EXPECT_DOUBLE_EQ(sequence.add({-100.0}), 0.0);
  EXPECT_DOUBLE_EQ(sequence.add({1.0}), 1.0);
  sequence.reset();
  EXPECT_EQ(sequence.sum(), 0.0);
}

TEST(SlipSequence, RefusesSettingsThatAreNone) {
  EXPECT_THROW(SlipSequence({.bias = std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
  EXPECT_THROW(SlipSequence({.memory = 1.1}), std::invalid_argument);
  EXPECT_THROW(SlipSequence({.mostPerFrame = 0.0}), std::invalid_argument);
  EXPECT_THROW(SlipSequence({.threshold = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::slip_sequence_test
