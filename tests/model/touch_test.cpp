#include "palpate/model/touch.h"

#include <cmath>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::touch_test {
namespace {

std::shared_ptr<const SensorLayout> layoutOf(const TouchRule& rule) {
  MatrixLayout matrix = MatrixLayout::full(1, 3, 2.0);
  matrix.touch = rule;
  return std::make_shared<SensorLayout>(std::vector{matrix});
}

TactileFrame frameOf(const TouchRule& rule,
                     std::vector<float> readings,
                     std::shared_ptr<const Baseline> baseline = nullptr) {
  TactileFrame frame(layoutOf(rule));
  frame.readings = std::move(readings);
  decideTouch(frame, std::move(baseline));
  return frame;
}

std::shared_ptr<const Baseline> restAt(std::vector<float> rest, std::vector<float> noise = {}) {
  return std::make_shared<const Baseline>(Baseline{std::move(rest), std::move(noise)});
}

using Values = std::vector<float>;

TEST(Touch, WithoutARuleFramesStayAsTheyAre) {
  TactileFrame frame(layoutOf({}));
  EXPECT_TRUE(frame.readings.empty());
  frame.values = {0.0F, 3.0F, -1.0F};
  decideTouch(frame, restAt({1.0F}));
  EXPECT_EQ(frame.values, (Values{0.0F, 3.0F, -1.0F}));
}

TEST(Touch, OfASignTheMagnitudePresses) {
  const TactileFrame frame = frameOf({.isSigned = true, .threshold = 2.0F}, {-5.0F, 1.5F, 7.0F});
  EXPECT_EQ(frame.values, (Values{5.0F, 0.0F, 7.0F}));
  EXPECT_EQ(frame.allValues(), (Values{5.0F, 1.5F, 7.0F}));
  EXPECT_EQ(forceAt(frame, {0, 0, 0})[2], -5.0F);
}

TEST(Touch, TheKindOfReadingsIsText) {
  EXPECT_EQ(readingsText(*layoutOf({})), "");
  EXPECT_EQ(readingsText(*layoutOf({.threshold = 5.0F, .sigmas = 3.0F})), "");
  EXPECT_EQ(readingsText(*layoutOf({.isSigned = true})), "signed");
  EXPECT_EQ(readingsText(*layoutOf({.components = 3})), "3 components");
  const MatrixLayout three = layoutOf({.components = 3, .isSigned = true})->matrix(0);
  const MatrixLayout one = layoutOf({.isSigned = true})->matrix(0), plain = layoutOf({})->matrix(0);
  EXPECT_EQ(readingsText(SensorLayout({three, plain, three})), "3 components, signed");
  EXPECT_EQ(readingsText(SensorLayout({three, one})), "3 components, signed; signed");
}

TEST(Touch, AReadingWithoutASignMustBeAboveItsRest) {
  const TactileFrame frame =
      frameOf({.threshold = 3.0F}, {10.0F, 13.0F, 14.0F}, restAt({20.0F, 10.0F, 10.0F}));
  EXPECT_EQ(frame.values, (Values{0.0F, 0.0F, 4.0F})) << "3 above is not above the threshold";
  EXPECT_EQ(frame.allValues(), (Values{-10.0F, 3.0F, 4.0F}));
}

TEST(Touch, TheNoiseSetsTheThresholdWhereItIsLarger) {
  const TouchRule rule{.threshold = 3.0F, .sigmas = 4.0F};
  const TactileFrame frame =
      frameOf(rule, {5.0F, 5.0F, 5.0F}, restAt({0.0F, 0.0F, 0.0F}, {0.5F, 1.0F, 1.5F}));
  EXPECT_EQ(frame.values, (Values{5.0F, 5.0F, 0.0F}));
}

TEST(Touch, OfThreeComponentsTheLengthDecidesAndZPresses) {
  const TactileFrame frame = frameOf({.components = 3, .isSigned = true, .threshold = 4.9F},
                                     {3.0F, 4.0F, 0.0F, 1.0F, 2.0F, 2.0F, 0.0F, 0.0F, -6.0F},
                                     restAt({0, 0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_GT(frame.values[0], 0.0F) << "it only shears";
  EXPECT_LT(frame.values[0], 1e-30F);
  EXPECT_EQ(frame.values[1], 0.0F) << "its length is 3";
  EXPECT_EQ(frame.values[2], 7.0F);
  EXPECT_EQ(frame.allValues(), (Values{frame.values[0], 2.0F, 7.0F}));
  EXPECT_EQ(forceAt(frame, {0, 0, 0}), (std::array{3.0F, 4.0F, 0.0F}));
  EXPECT_EQ(forceAt(frame, {0, 0, 2}), (std::array{0.0F, 0.0F, -7.0F}));
}

TEST(Touch, TheBaselineIsMeanAndDeviation) {
  RestMeter meter;
  for (const float value : {1.0F, 2.0F, 6.0F}) meter.add(Values{value, -value, 4.0F});
  const Baseline baseline = meter.baseline();
  EXPECT_EQ(baseline.rest, (Values{3.0F, -3.0F, 4.0F}));
  // Of 1, 2, 6: squares 4 + 1 + 9 = 14, over 2.
  EXPECT_FLOAT_EQ(baseline.noise[0], std::sqrt(7.0F));
  EXPECT_EQ(baseline.noise[2], 0.0F);
  EXPECT_THROW(RestMeter().baseline(), std::invalid_argument);
}

TEST(Touch, WhatMovesIsNoRest) {
  const auto meterOf = [](double fullScale, float step) {
    RestMeter meter(fullScale);
    for (int i = 0; i < 20; ++i) {
      const float noise = i % 2 == 0 ? 1.0F : -1.0F;
      meter.add(Values{noise, 10.0F + noise + (i < 10 ? 0.0F : step)});
    }
    EXPECT_EQ(meter.numFrames(), 20u);
    return meter;
  };
  // 0.2 % of 1000 are 2.
  EXPECT_THROW(meterOf(1'000.0, 5.0F).baseline(), Error);
  EXPECT_NO_THROW(meterOf(1'000.0, 2.5F).baseline()) << "its noise is 1";
  EXPECT_NO_THROW(meterOf(10'000.0, 5.0F).baseline());
  EXPECT_NO_THROW(meterOf(1'000.0, 1.5F).baseline());
  EXPECT_NO_THROW(meterOf(0.0, 500.0F).baseline()) << "not asked for";
  RestMeter few(1'000.0);
  few.add(Values{1.0F, 2.0F});
  EXPECT_THROW(few.baseline(), std::invalid_argument) << "one frame";
  EXPECT_THROW(few.add(Values{1.0F}), std::invalid_argument) << "of another layout";
  few.add(Values{500.0F, 2.0F});
  EXPECT_EQ(few.baseline().rest, (Values{250.5F, 2.0F})) << "too few frames to tell";
}

TEST(Touch, WhatWasTakenIsToldInOneLine) {
  EXPECT_EQ(baselineText({{-3.0F, 12.0F}, {0.25F, 0.75F}}, 33),
            "33 frames: 2 readings at rest from -3.0 to 12.0, noise up to 0.8");
  EXPECT_EQ(baselineText({{1.0F}, {}}, 2), "2 frames: 1 reading at rest from 1.0 to 1.0");
}

TEST(Touch, ABaselineTakenLaterIsTheOneThatIsSeen) {
  const SensorLayout layout = *layoutOf({.isSigned = true});
  const Baseline recorded{{1.0F, 2.0F, 3.0F}, {}};
  const Baseline later{{4.0F, 5.0F, 6.0F}, {}};
  const std::vector<Event> events{baselineEvent(recorded, 10),
                                  baselineEvent(later, 30, kNewBaselineKind)};
  const Baselines seen = baselinesOf(events, layout);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(*baselineAt(seen, 10), later) << "of the whole recording";
  const Baselines asRecorded = recordedBaselinesOf(events, layout);
  ASSERT_EQ(asRecorded.size(), 1u);
  EXPECT_EQ(*asRecorded[0].second, recorded);
}

TEST(Touch, BaselinesComeBackFromTheirEvents) {
  const SensorLayout layout = *layoutOf({.isSigned = true});
  const Baseline first{{0.1F, -2.5F, 3e-7F}, {0.25F, 0.0F, 1.0F}};
  const Baseline second{{1.0F, 2.0F, 3.0F}, {}};
  const std::vector<Event> events{{5, 5, "baseline", {}, "", R"({"rest": [1]})"},
                                  {7, 7, "baseline", {}, "", "no JSON"},
                                  baselineEvent(second, 20),
                                  baselineEvent(first, 10)};
  std::size_t wrong = 0;
  const Baselines read = baselinesOf(events, layout, &wrong);
  EXPECT_EQ(wrong, 2u);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(*read[0].second, first);
  EXPECT_EQ(*read[1].second, second);
  EXPECT_EQ(baselineAt(read, 3), read[0].second) << "also before";
  EXPECT_EQ(baselineAt(read, 19), read[0].second);
  EXPECT_EQ(baselineAt(read, 20), read[1].second);
  EXPECT_EQ(baselineAt({}, 20), nullptr);
  EXPECT_THROW(baselineEvent({Values(60'000, 0.123F), {}}, 1), Error);
}

TEST(Touch, RulesComeBackFromTheirText) {
  const TouchRule rule{3, true, 0.5F, 4.0F};
  const SensorLayout layout = *layoutOf(rule);
  const SensorLayout plain = withoutTouchRules(layout);
  EXPECT_FALSE(plain.decidesTouch());
  EXPECT_EQ(withTouchRules(plain, touchRulesText(layout)), layout);
  EXPECT_THROW(withTouchRules(plain, "[]"), Error);
  EXPECT_THROW(
      withTouchRules(plain, R"([{"components": 2, "signed": true, "threshold": 0, "sigmas": 0}])"),
      Error);
}

TEST(Touch, AProfileKeepsReadingsAndIsSeenOverABaseline) {
  ProfileBuilder builder(layoutOf({.isSigned = true, .threshold = 1.0F}));
  builder.addReadings(1, Values{-4.0F, 0.5F, 2.0F});
  EXPECT_THROW(builder.addReadings(2, Values{1.0F}), std::invalid_argument);
  EXPECT_THROW(builder.addFrame(2, Values{1.0F, 2.0F, 3.0F}), std::invalid_argument)
      << "values among readings";
  const Profile profile = builder.finish({});
  EXPECT_TRUE(profile.givesReadings());
  EXPECT_EQ(profile.frame(0).values, (Values{4.0F, 0.0F, 2.0F}));
  const Profile other = profile.withBaselines({{0, restAt({-4.0F, 0.5F, 0.0F})}});
  EXPECT_EQ(other.frame(0).readings, (Values{-4.0F, 0.5F, 2.0F}));
  EXPECT_EQ(other.frame(0).values, (Values{0.0F, 0.0F, 2.0F}));
}

TEST(Touch, AHandSaysItsRules) {
  const HandDescription hand = parseHand(
      R"({"format": "palpate-hand", "version": 1, "name": "skin", "touch_threshold": 5,
          "full_scale": 1000,
          "matrices": [
            {"name": "a", "rows": 1, "columns": 2, "pitch_mm": 4, "components": 3},
            {"name": "b", "rows": 1, "columns": 2, "pitch_mm": 4, "signed": true,
             "touch_sigma": 4, "picture": {"column": 1, "row": 0}},
            {"name": "c", "rows": 1, "columns": 2, "pitch_mm": 4, "touch_threshold": 0,
             "picture": {"column": 2, "row": 0}}]})",
      "",
      "hand.json");
  const SensorLayout& layout = *hand.layout;
  EXPECT_EQ(layout.matrix(0).touch, (TouchRule{3, true, 5.0F, 0.0F}));
  EXPECT_EQ(layout.matrix(1).touch, (TouchRule{1, true, 5.0F, 4.0F}));
  EXPECT_EQ(layout.matrix(2).touch, TouchRule{});
  EXPECT_EQ(layout.numCells(), 6u);
  EXPECT_EQ(layout.numReadings(), 10u);
  EXPECT_EQ(layout.readingOffset(2), 8u);
  EXPECT_TRUE(layout.decidesTouch());
}

}  // namespace
}  // namespace palpate::touch_test
