#include "palpate/signals/curve_comparison.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::curve_comparison_test {
namespace {

using Function = std::function<double(double)>;

Series sampled(double fromS, double toS, double stepS, const Function& function) {
  Series series;
  const auto count = std::llround((toS - fromS) / stepS);
  for (long long i = 0; i <= count; ++i) {
    const double at = fromS + static_cast<double>(i) * stepS;
    series.timeS.push_back(at);
    series.values.push_back(function(at));
  }
  return series;
}

double line(double t) { return 3.0 * t + 2.0; }

TEST(CurveComparison, LinesAreReadExactlyWhateverTheirRates) {
  // B is A's line, 5 lower, recorded from 1.03 s of A on at another rate.
  const Series a = sampled(0.0, 8.0, 0.05, line);
  const Series b = sampled(0.0, 9.0, 0.03, [](double t) { return line(t + 1.03) - 5.0; });
  const CurveComparison report = compareCurves(a, b, 1.03);
  EXPECT_NEAR(report.fromS, 1.03, 1e-12);
  EXPECT_NEAR(report.toS, 8.0, 1e-12);
  EXPECT_NEAR(report.stepS, 0.05, 1e-12);
  EXPECT_EQ(report.samples, 140u);  // floor(6.97 / 0.05) + 1
  EXPECT_NEAR(report.meanDifference, 5.0, 1e-9);
  EXPECT_NEAR(report.rmsDifference, 5.0, 1e-9);
  EXPECT_NEAR(report.largestDifference, 5.0, 1e-9);
  ASSERT_TRUE(report.correlation);
  EXPECT_NEAR(*report.correlation, 1.0, 1e-12);
}

TEST(CurveComparison, CorrelationOfSineAndCosineIsZeroOfOppositeMinusOne) {
  const double tau = 2.0 * std::numbers::pi;
  const auto sine = [=](double t) { return 100.0 * std::sin(tau * t) + 7.0; };
  const auto cosine = [=](double t) { return 20.0 * std::cos(tau * t) - 3.0; };
  // 1000 samples, each phase once: sums over whole periods vanish.
  const Series a = sampled(0.0, 1.0 - 1e-3, 1e-3, sine);
  EXPECT_NEAR(
      *compareCurves(a, sampled(0.0, 1.0 - 1e-3, 1e-3, cosine), 0.0).correlation, 0.0, 1e-12);
  const auto opposite = [=](double t) { return 50.0 - sine(t); };
  EXPECT_NEAR(
      *compareCurves(a, sampled(0.0, 1.0 - 1e-3, 1e-3, opposite), 0.0).correlation, -1.0, 1e-12);
  // A phase shift of 60 degrees: cos 60 = 0.5.
  const auto later = [=](double t) { return 30.0 * std::sin(tau * t - std::numbers::pi / 3.0); };
  EXPECT_NEAR(
      *compareCurves(a, sampled(0.0, 1.0 - 1e-3, 1e-3, later), 0.0).correlation, 0.5, 1e-12);
}

TEST(CurveComparison, TheRightOffsetUndoesAShift) {
  const auto bump = [](double t) { return 500.0 * std::exp(-(t - 3.0) * (t - 3.0)); };
  const Series a = sampled(0.0, 6.0, 0.02, bump);
  const Series b = sampled(0.0, 6.0, 0.02, [&](double t) { return bump(t + 0.8); });
  const CurveComparison aligned = compareCurves(a, b, 0.8);
  EXPECT_NEAR(*aligned.correlation, 1.0, 1e-9);
  EXPECT_NEAR(aligned.rmsDifference, 0.0, 1e-6);
  EXPECT_LT(*compareCurves(a, b, 0.0).correlation, 0.9);
}

TEST(CurveComparison, SwappingChangesOnlySigns) {
  const Series a = sampled(0.0, 4.0, 0.05, [](double t) { return t * t; });
  const Series b = sampled(0.0, 3.0, 0.07, [](double t) { return 5.0 * std::sin(t); });
  const CurveComparison ab = compareCurves(a, b, 0.4), ba = compareCurves(b, a, -0.4);
  EXPECT_EQ(ab.samples, ba.samples);
  EXPECT_NEAR(ab.meanDifference, -ba.meanDifference, 1e-9);
  EXPECT_NEAR(ab.rmsDifference, ba.rmsDifference, 1e-9);
  EXPECT_NEAR(ab.largestDifference, -ba.largestDifference, 1e-9);
  EXPECT_NEAR(*ab.correlation, *ba.correlation, 1e-9);
}

TEST(CurveComparison, TheLargestDifferenceIsNamedWithItsMoment) {
  const Series a = sampled(0.0, 2.0, 0.5, [](double) { return 10.0; });
  Series b = a;
  b.values[3] = 45.0;
  const CurveComparison report = compareCurves(a, b, 0.0);
  EXPECT_EQ(report.largestDifference, -35.0);
  EXPECT_NEAR(report.largestAtS, 1.5, 1e-12);
}

TEST(CurveComparison, WhatLiesInAGapIsLeftOut) {
  Series a = sampled(0.0, 1.0, 0.1, [](double t) { return t; });
  const Series after = sampled(21.0, 22.0, 0.1, [](double t) { return t; });
  a.timeS.insert(a.timeS.end(), after.timeS.begin(), after.timeS.end());
  a.values.insert(a.values.end(), after.values.begin(), after.values.end());
  const Series b = sampled(0.0, 22.0, 0.1, [](double t) { return t + 1.0; });
  const CurveComparison gap = compareCurves(a, b, 0.0, {.aS = 1.0, .bS = 1.0});
  EXPECT_EQ(gap.samples, 22u);
  EXPECT_EQ(compareCurves(a, b, 0.0).samples, 221u);
  EXPECT_NEAR(gap.meanDifference, -1.0, 1e-9);
  EXPECT_EQ(compareCurves(b, a, 0.0, {.bS = 1.0}).samples, 22u);
}

// Outside of the span A and B are equal, within it B is twice A: only that part counts.
TEST(CurveComparison, ComparesOnlyAPart) {
  const Series a = sampled(0.0, 10.0, 0.1, [](double t) { return t; });
  const Series b =
      sampled(0.0, 10.0, 0.1, [](double t) { return t > 1.95 && t < 3.05 ? -2.0 * t : t; });
  const CurveComparison part = compareCurves(a, b, 0.0, {}, TimeSpan{2.0, 3.0});
  EXPECT_NEAR(part.fromS, 2.0, 1e-12);
  EXPECT_NEAR(part.toS, 3.0, 1e-12);
  EXPECT_EQ(part.samples, 11u);
  EXPECT_NEAR(*part.correlation, -1.0, 1e-12);
  EXPECT_NEAR(part.meanDifference, 3.0 * 2.5, 1e-9);
  EXPECT_GT(*compareCurves(a, b, 0.0).correlation, 0.0);
  // What the curves don't have isn't compared either.
  EXPECT_NEAR(compareCurves(a, b, 0.0, {}, TimeSpan{-5.0, 1.0}).fromS, 0.0, 1e-12);
  EXPECT_EQ(compareCurves(a, b, 0.0, {}, TimeSpan{11.0, 12.0}).samples, 0u);
}

TEST(CurveComparison, SaysWhereThereIsNoCorrelation) {
  const Series constant = sampled(0.0, 2.0, 0.1, [](double) { return 812.3; });
  const Series rising = sampled(0.0, 2.0, 0.1, line);
  EXPECT_EQ(compareCurves(constant, rising, 0.0).correlation, std::nullopt);
  EXPECT_EQ(compareCurves(rising, constant, 0.0).correlation, std::nullopt);
  const CurveComparison two = compareCurves(rising, rising, 1.9);
  EXPECT_EQ(two.samples, 2u);
  EXPECT_EQ(two.correlation, std::nullopt);
  EXPECT_EQ(compareCurves(rising, rising, 2.1).samples, 0u);
  EXPECT_EQ(compareCurves(Series{}, rising, 0.0).samples, 0u);
}

TEST(CurveComparison, OneSampleIsComparedToo) {
  const Series one{{0.0}, {40.0}};
  const Series rising = sampled(0.0, 2.0, 0.1, [](double t) { return 10.0 * t; });
  const CurveComparison report = compareCurves(rising, one, 1.05);
  EXPECT_EQ(report.samples, 1u);
  EXPECT_NEAR(report.meanDifference, 10.5 - 40.0, 1e-9);
  const CurveComparison both = compareCurves(one, one, 0.0);
  EXPECT_EQ(both.samples, 1u);
  EXPECT_EQ(both.stepS, 0.0);
}

TEST(CurveComparison, NotANumberIsAGapAndBadSeriesAreRefused) {
  Series a = sampled(0.0, 1.0, 0.1, line);
  a.values[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(compareCurves(a, sampled(0.0, 1.0, 0.1, line), 0.0).samples, 10u);
  a.values.pop_back();
  EXPECT_THROW(compareCurves(a, a, 0.0), std::invalid_argument);
}

TEST(CurveComparison, GapsBeginWhereTimingSaysThem) {
  EXPECT_DOUBLE_EQ(gapFromS({.rateHz = 30.0, .gaps = {}}), 1.0);
  EXPECT_DOUBLE_EQ(gapFromS({.rateHz = 0.5, .gaps = {}}), 10.0);
  EXPECT_DOUBLE_EQ(gapFromS({}), 1.0);
}

TEST(CurveComparison, GapsOfASeriesAreThoseOfItsIntervals) {
  EXPECT_EQ(gapOfTimesS(std::vector<double>{}), 1.0);
  EXPECT_EQ(gapOfTimesS(std::vector<double>{3.0}), 1.0);
  EXPECT_EQ(gapOfTimesS(std::vector<double>{0.0, 0.01, 0.02, 9.0}), 1.0);
  EXPECT_EQ(gapOfTimesS(std::vector<double>{0.0, 2.0, 4.0, 6.0, 60.0}), 10.0);
}

TEST(CurveComparison, TheSampleAtATimeIsTheLastOneBeforeIt) {
  const Series series{.timeS = {1.0, 1.5, 4.0}, .values = {1.0, 2.0, 3.0}};
  EXPECT_EQ(sampleAt(series, 0.9, 1.0), std::nullopt);
  EXPECT_EQ(sampleAt(series, 1.0, 1.0), 0u);
  EXPECT_EQ(sampleAt(series, 2.5, 1.0), 1u);
  EXPECT_EQ(sampleAt(series, 2.6, 1.0), std::nullopt);
  EXPECT_EQ(sampleAt(series, 4.5, 1.0), 2u);
}

// Two grasps of the same object are more alike from their contacts on than from where recording
// happened to begin.
TEST(CurveComparisonOfRealGrasps, ContactsAlignBetterThanStarts) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  std::vector<TimedProfile> all;
  for (const auto& entry :
       std::filesystem::directory_iterator(*folder / "grasps_by_class" / "dice_large"))
    all.push_back(timedProfile(openRecording(entry.path())));
  ASSERT_GE(all.size(), 2u);
  double atContact = 0.0, atStart = 0.0;
  const SeriesChoice whole{.index = sdh2().layout->numMatrices(), .signal = SignalKind::kSum};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size(); ++k) {
      const Series a = readSeries(all[i].profile, whole, 0.0, 1e6);
      const Series b = readSeries(all[k].profile, whole, 0.0, 1e6);
      const CurveGaps gaps{gapFromS(all[i].timing), gapFromS(all[k].timing)};
      const auto correlation = [&](Alignment alignment) {
        return compareCurves(a, b, *offsetBetween(all[i], all[k], alignment), gaps)
            .correlation.value();
      };
      atContact += correlation(Alignment::kContact);
      atStart += correlation(Alignment::kStart);
    }
  EXPECT_GT(atContact, atStart);
}

}  // namespace
}  // namespace palpate::curve_comparison_test
