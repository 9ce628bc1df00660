#include "palpate/slip/slip_rule.h"

#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

namespace palpate::slip_rule_test {
namespace {

// Evidence of a contact of age 100 in which one window measures the same shift of the centroid and
// of the registration.
SlipEvidence shifted(SlipWindow window, double taxels, double pMoved = 1.0, double logRise = 0.0) {
  SlipEvidence evidence{
      .computable = true, .contactAge = 100, .windows = {}, .last = {}, .recent = {}};
  WindowEvidence& seen = evidence.windows[window];
  seen.filled = true;
  seen.centroidX = taxels;
  seen.logLoadRatio = logRise;
  seen.hypotheses.computed = true;
  seen.hypotheses.motion.dx = taxels;
  seen.hypotheses.pMoved = pMoved;
  return evidence;
}

// Short window: 1.75 steps of 0.20 = 0.35 taxel.
TEST(SlipRule, TheShortWindowAlarmsAtOnce) {
  SlipRule rule;
  EXPECT_FALSE(rule.decide(shifted(kShortWindow, 0.34)).alarm);
  EXPECT_TRUE(rule.decide(shifted(kShortWindow, 0.36)).alarm);
}

// Middle window 3 steps = 0.6, long window 1.2 references = 1.2 taxels, in two frames.
TEST(SlipRule, TheOthersWantTwoFramesInARow) {
  for (const auto& [window, threshold] : {std::pair{kMiddleWindow, 0.6}, {kLongWindow, 1.2}}) {
    SlipRule rule;
    EXPECT_FALSE(rule.decide(shifted(window, threshold + 0.01)).alarm);
    EXPECT_FALSE(rule.decide(shifted(window, threshold - 0.01)).alarm);
    EXPECT_FALSE(rule.decide(shifted(window, threshold + 0.01)).alarm);
    EXPECT_TRUE(rule.decide(shifted(window, threshold + 0.01)).alarm);
    rule.reset();
    EXPECT_FALSE(rule.decide(shifted(window, threshold + 0.01)).alarm);
  }
}

// Half of the middle threshold is 0.3 taxel, 0.231 of the centroid.
TEST(SlipRule, TheLongWindowForgetsWhatIsOver) {
  SlipRule rule;
  SlipEvidence evidence = shifted(kLongWindow, 2.0);
  evidence.windows[kMiddleWindow] = shifted(kMiddleWindow, 0.22).windows[kMiddleWindow];
  rule.decide(evidence);
  EXPECT_FALSE(rule.decide(evidence).alarm);
  evidence.windows[kMiddleWindow] = shifted(kMiddleWindow, 0.24).windows[kMiddleWindow];
  rule.decide(evidence);
  EXPECT_TRUE(rule.decide(evidence).alarm);
}

// In a settled contact, 0.6 of 0.6 taxel exceeds 0.35.
TEST(SlipRule, TheScoreMustBeCertainInAYoungContact) {
  SlipRule rule;
  EXPECT_TRUE(rule.decide(shifted(kShortWindow, 0.6, 0.6)).alarm);
  EXPECT_FALSE(rule.decide(shifted(kShortWindow, 0.6, 0.58)).alarm);  // 0.348 < 0.35
  SlipEvidence young = shifted(kShortWindow, 0.6, 0.74);
  young.contactAge = 14;
  EXPECT_FALSE(rule.decide(young).alarm);
  young.contactAge = 15;
  EXPECT_TRUE(rule.decide(young).alarm);
  young = shifted(kShortWindow, 0.6, 0.76);
  young.contactAge = 14;
  EXPECT_TRUE(rule.decide(young).alarm);
}

// More than 1 reference in the middle window is slip at any score. With a score of 0.5, 0.99 taxel
// counts as 0.495, less than 0.6.
TEST(SlipRule, AMotionThatAccumulatesNeedsNoScore) {
  for (const auto& [taxels, pMoved, alarm] :
       {std::tuple{1.01, 0.0, true}, {0.99, 0.5, false}, {0.99, 0.61, true}}) {
    SlipRule rule;
    EXPECT_FALSE(rule.decide(shifted(kMiddleWindow, taxels, pMoved)).alarm);
    EXPECT_EQ(rule.decide(shifted(kMiddleWindow, taxels, pMoved)).alarm, alarm) << taxels;
  }
}

// Stored frames with residuals of 40 without motion and 1 with it, and 0.3 taxel in three frames.
SlipEvidence sliding(double motionResidual = 1.0) {
  SlipEvidence evidence{
      .computable = true, .contactAge = 100, .windows = {}, .last = {}, .recent = {}};
  evidence.stored = true;
  evidence.recent.filled = evidence.last.filled = true;
  evidence.recent.centroidY = 0.3;
  evidence.last.centroidY = 0.1;
  evidence.recent.hypotheses.computed = true;
  evidence.recent.hypotheses.loadShiftResidual = 40.0;
  evidence.recent.hypotheses.motionResidual = motionResidual;
  return evidence;
}

int framesToSequence(SlipRule& rule, const SlipEvidence& evidence) {
  for (int i = 1; i <= 30; ++i)
    if (rule.decide(evidence).alarm) return i;
  return 0;
}

// Evidence of a frame by the formula of slip_sequence.h: 2.230 + 2.394 ln 0.35 + 1.068 (ln 41 -
// ln 2) + 0.822 ln 2 + 3.319 0.1 = 3.843; its sum with memory 0.9 exceeds 22 in the 9th frame.
TEST(SlipRule, EvidenceAddsUpOverFrames) {
  SlipRule rule;
  EXPECT_EQ(framesToSequence(rule, sliding()), 9);
  rule.reset();
  EXPECT_EQ(rule.sum(), 0.0);
  // Where the load field explains the frames as well as the motion: 2.230 - 2.513 + 0.822 ln 41 +
  // 0.332 = 3.100.
  EXPECT_EQ(framesToSequence(rule, sliding(40.0)), 12);
}

TEST(SlipRule, TheSequenceBeginsAnewWithAContactAndStepsOnlyWithStoredFrames) {
  SlipRule rule;
  SlipEvidence evidence = sliding();
  rule.decide(evidence);
  const double once = rule.sum();
  EXPECT_NEAR(once, 3.843, 0.001);
  evidence.stored = false;
  rule.decide(evidence);
  EXPECT_EQ(rule.sum(), once);
  evidence = {.computable = true, .contactAge = 1, .windows = {}, .last = {}, .recent = {}};
  evidence.stored = true;
  rule.decide(evidence);
  EXPECT_EQ(rule.sum(), 0.0);
}

TEST(SlipRule, TheSequenceAllowsJointsToMoveAndScalesWithTheStep) {
  SlipRule rule;
  SlipEvidence evidence = sliding();
  evidence.recent.jointsDeg = 3.0;
  EXPECT_EQ(framesToSequence(rule, evidence), 0);
  SlipRule coarse({.stepTaxels = 0.8});
  EXPECT_EQ(framesToSequence(coarse, sliding()), 0);
}

TEST(SlipRule, AllowsMoreWhileTheLoadRisesOrJointsMove) {
  SlipRule rule;
  EXPECT_FALSE(rule.decide(shifted(kShortWindow, 0.64, 1.0, 0.2)).alarm);  // 0.35 + 1.5 * 0.2
  EXPECT_TRUE(rule.decide(shifted(kShortWindow, 0.66, 1.0, 0.2)).alarm);
  EXPECT_TRUE(rule.decide(shifted(kShortWindow, 0.36, 1.0, -0.2)).alarm);  // not while it falls
  SlipEvidence moving = shifted(kShortWindow, 0.54);
  moving.windows[kShortWindow].jointsDeg = 2.0;  // 0.35 + 0.1 * 2
  EXPECT_FALSE(rule.decide(moving).alarm);
  moving.windows[kShortWindow].jointsDeg = 1.8;
  EXPECT_TRUE(rule.decide(moving).alarm);
}

TEST(SlipRule, AContactSettlesFirst) {
  SlipRule rule;
  SlipEvidence young = shifted(kShortWindow, 2.0);
  young.contactAge = 8;  // the earlier frame is of age 5
  EXPECT_FALSE(rule.decide(young).alarm);
  young.contactAge = 9;
  EXPECT_TRUE(rule.decide(young).alarm);
}

// m = min(1.3 |centroid|, |registered|): a shift of only one of them is no motion.
TEST(SlipRule, CentroidAndRegistrationMustAgree) {
  SlipRule rule;
  SlipEvidence evidence = shifted(kShortWindow, 1.0);
  evidence.windows[kShortWindow].hypotheses.motion.dx = 0.3;
  EXPECT_FALSE(rule.decide(evidence).alarm);
  evidence = shifted(kShortWindow, 0.26);  // 1.3 * 0.26 = 0.338
  evidence.windows[kShortWindow].hypotheses.motion.dx = 1.0;
  EXPECT_FALSE(rule.decide(evidence).alarm);
  // A registration that differs so much from the centroid is rejected: P counts as 0.5.
  evidence = shifted(kShortWindow, 0.4);
  evidence.windows[kShortWindow].hypotheses.motion.dx = 4.0;
  EXPECT_FALSE(rule.decide(evidence).alarm);
}

TEST(SlipRule, AsksForTheWindowNearestToItsThreshold) {
  SlipRule rule;
  SlipEvidence evidence = shifted(kMiddleWindow, 0.7);
  EXPECT_EQ(rule.windowToEvaluate(evidence), kMiddleWindow);
  evidence.windows[kShortWindow] = shifted(kShortWindow, 0.6).windows[kShortWindow];
  EXPECT_EQ(rule.windowToEvaluate(evidence), kShortWindow);
  EXPECT_FALSE(rule.windowToEvaluate(shifted(kMiddleWindow, 0.45)));  // 1.3 * 0.45 < 0.6
  evidence.computable = false;
  EXPECT_FALSE(rule.windowToEvaluate(evidence));
}

TEST(SlipRule, ThresholdsScaleWithSteps) {
  SlipRule rule({.stepTaxels = 0.4, .referenceTaxels = 2.0});
  EXPECT_FALSE(rule.decide(shifted(kShortWindow, 0.69)).alarm);
  EXPECT_TRUE(rule.decide(shifted(kShortWindow, 0.71)).alarm);
  rule.decide(shifted(kLongWindow, 2.39));
  EXPECT_FALSE(rule.decide(shifted(kLongWindow, 2.39)).alarm);
  rule.decide(shifted(kLongWindow, 2.41));
  EXPECT_TRUE(rule.decide(shifted(kLongWindow, 2.41)).alarm);
}

TEST(SlipRule, TellsTurningWhereTheAngleIsKnown) {
  SlipRule rule;
  SlipEvidence evidence = shifted(kMiddleWindow, 0.1, 0.8);
  evidence.windows[kMiddleWindow].hypotheses.motion.angleDeg = -7.5;
  evidence.windows[kMiddleWindow].hypotheses.sdAngleDeg = 1.0;  // 7.5 - 2 > 5
  EXPECT_FALSE(rule.decide(evidence).rotating);
  const SlipRuleResult second = rule.decide(evidence);
  EXPECT_TRUE(second.rotating);
  EXPECT_FALSE(second.alarm);
  evidence.windows[kMiddleWindow].hypotheses.sdAngleDeg = 1.5;
  EXPECT_FALSE(rule.decide(evidence).rotating);
}

TEST(SlipRule, RefusesThresholdsThatAreNone) {
  EXPECT_THROW(SlipRule({.stepTaxels = 0.0}), std::invalid_argument);
  EXPECT_THROW(SlipRule({.referenceTaxels = -1.0}), std::invalid_argument);
  EXPECT_THROW(SlipRule({.rotationDeg = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::slip_rule_test
