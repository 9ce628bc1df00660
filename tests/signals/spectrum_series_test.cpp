// Spectra of what recordings are like: gaps, values that are none, series that are too short or too
// long.
#include <stdexcept>

#include "palpate/signals/spectrum.h"

#include "filter/spectra_of.h"
#include "testing/testing.h"

namespace palpate::spectrum_series_test {
namespace {

using testing::evenTimes;
using testing::kNan;
using testing::noise;
using testing::spectraOf;
using testing::tone;

TEST(SpectrumSeries, NoSegmentSpansAGap) {
  auto timeS = evenTimes(40, 20.0);
  const auto later = evenTimes(50, 40.0, timeS.back() + 1.5);  // another rate
  timeS.insert(timeS.end(), later.begin(), later.end());
  timeS.push_back(timeS.back() + 3.0);  // a lonely frame
  std::vector<double> values(40, 10.0);
  values.resize(90, 500.0);
  values.push_back(900.0);
  const auto spectra = spectraOf(timeS, values);
  ASSERT_EQ(spectra.report.stretches.size(), 3u);
  const auto& stretches = spectra.report.stretches;
  EXPECT_EQ(stretches[0].segments, 9u);
  EXPECT_EQ(stretches[1].segments, 19u);
  EXPECT_EQ(stretches[2].segments, 0u);
  EXPECT_EQ(stretches[1].first, 40u);
  EXPECT_EQ(stretches[2].samples, 1u);
  EXPECT_EQ(stretches[2].rateHz, 0.0);
  EXPECT_NEAR(stretches[0].rateHz, 20.0, 1e-9);
  EXPECT_NEAR(stretches[1].rateHz, 40.0, 1e-9);
  EXPECT_NEAR(spectra.report.rateHz, 40.0, 1e-9) << "of the longest";
  EXPECT_NEAR(spectra.report.jitter, 0.35, 0.02) << "gaps don't count: 39 of 50, 49 of 25 ms";
  EXPECT_EQ(spectra.report.inNoSegment, 1u);
  for (const testing::Kept& segment : spectra.segments) {
    EXPECT_NEAR(segment.binHz, segment.stretch == 0 ? 20.0 / 32.0 : 40.0 / 32.0, 1e-9);
    for (const double magnitude : segment.magnitude) EXPECT_EQ(magnitude, 0.0);
  }
}

TEST(SpectrumSeries, AGapIsLongerThanASecondAndFiveIntervals) {
  const auto stretchesWith = [](double rateHz, double intervalS) {
    auto timeS = evenTimes(50, rateHz);
    const auto rest = evenTimes(50, rateHz, timeS.back() + intervalS);
    timeS.insert(timeS.end(), rest.begin(), rest.end());
    return planSpectra(timeS, std::vector<double>(100)).stretches.size();
  };
  EXPECT_EQ(stretchesWith(74.0, 0.99), 1u);
  EXPECT_EQ(stretchesWith(74.0, 1.01), 2u);
  EXPECT_EQ(stretchesWith(2.0, 2.4), 1u);
  EXPECT_EQ(stretchesWith(2.0, 2.6), 2u);
}

TEST(SpectrumSeries, WhatIsNoNumberIsLeftOutAndCounted) {
  const auto timeS = evenTimes(100, 64.0);
  // A line is not changed by samples that are missing.
  std::vector<double> values(100);
  for (std::size_t i = 0; i < 100; ++i) values[i] = 2.0 * static_cast<double>(i);
  const auto whole = spectraOf(timeS, values);
  values[0] = values[40] = values[41] = kNan;
  values[70] = std::numeric_limits<double>::infinity();
  // the same grid as before
  const auto spectra = spectraOf(timeS, values, {.gridRate = GridRate::kMedian});
  EXPECT_EQ(spectra.report.notFinite, 4u);
  ASSERT_EQ(spectra.report.stretches.size(), 1u);
  EXPECT_EQ(spectra.report.stretches[0].first, 1u);
  EXPECT_EQ(spectra.report.stretches[0].samples, 96u);
  ASSERT_EQ(spectra.segments.size(), whole.segments.size() - 1);
  for (const testing::Kept& segment : spectra.segments)
    for (std::size_t k = 0; k < 17; ++k)
      EXPECT_NEAR(segment.magnitude[k], whole.segments[0].magnitude[k], 1e-9);
  // Enough of them make a gap.
  for (std::size_t i = 0; i < 100; ++i) values[i] = i < 10 || i >= 80 ? 1.0 : kNan;
  EXPECT_EQ(planSpectra(timeS, values).stretches.size(), 2u);
  EXPECT_EQ(spectraOf(timeS, std::vector<double>(100, kNan)).report.notFinite, 100u);
}

TEST(SpectrumSeries, TooFewSamplesHaveNoSegment) {
  EXPECT_EQ(spectraOf({}, {}).report.stretches.size(), 0u);
  const auto one = spectraOf({5.0}, {7.0}).report;
  EXPECT_EQ(one.stretches.size(), 1u);
  EXPECT_EQ(one.segments, 0u);
  EXPECT_EQ(one.rateHz, 0.0);
  EXPECT_EQ(one.jitter, 0.0);
  EXPECT_EQ(one.inNoSegment, 1u);
  EXPECT_EQ(spectraOf(evenTimes(31, 50.0), noise(31, 1.0)).report.inNoSegment, 31u);
  EXPECT_EQ(spectraOf(evenTimes(32, 50.0), noise(32, 1.0)).report.segments, 1u);
  const std::vector<double> nothing;
  MeanSpectrumCollector mean(planSpectra(nothing, nothing));
  EXPECT_EQ(mean.result().segments, 0u);
  EXPECT_EQ(mean.result().strongestHz(), 0.0);
}

TEST(SpectrumSeries, TakesTheMedianRateWhenAsked) {
  // 10 Hz, but every tenth frame is 0.4 s late.
  std::vector<double> timeS(1, 0.0);
  while (timeS.size() < 101) timeS.push_back(timeS.back() + (timeS.size() % 10 == 0 ? 0.5 : 0.1));
  const std::vector<double> values(101);
  const auto mean = planSpectra(timeS, values).stretches.at(0);
  const auto median = planSpectra(timeS, values, {.gridRate = GridRate::kMedian}).stretches.at(0);
  EXPECT_NEAR(mean.rateHz, 100.0 / 14.0, 1e-9);
  EXPECT_EQ(mean.gridSamples, 101u);
  EXPECT_NEAR(median.rateHz, 10.0, 1e-6);
  EXPECT_EQ(median.gridSamples, 141u);
}

TEST(SpectrumSeries, FewerSegmentsAreReachedByALargerHop) {
  const auto timeS = evenTimes(5000, 100.0);
  const auto values = tone(timeS, 12.5, 3.0);
  EXPECT_EQ(planSpectra(timeS, values).segments, 4969u);
  const auto few = spectraOf(timeS, values, {.maxSegments = 500});
  EXPECT_EQ(few.report.hop, 10u) << "4968 / 10 + 1 = 497 fit, 4968 / 9 + 1 = 553 don't";
  EXPECT_EQ(few.segments.size(), 497u);
  EXPECT_NEAR(few.segments[1].timeS - few.segments[0].timeS, 0.1, 1e-9);
  EXPECT_EQ(spectraOf(timeS, values, {.maxSegments = 1}).segments.size(), 1u);
  EXPECT_EQ(planSpectra(timeS, values, {.maxSegments = 4969}).hop, 1u);
}

TEST(SpectrumSeries, RefusesWhatHasNoMeaning) {
  const auto timeS = evenTimes(100, 50.0);
  const std::vector<double> values(100);
  for (const SpectrumOptions& bad : {SpectrumOptions{.window = 1, .overlap = 0},
                                     SpectrumOptions{.window = 65'537},
                                     SpectrumOptions{.window = -4},
                                     SpectrumOptions{.window = 32, .overlap = 32},
                                     SpectrumOptions{.window = 16},  // overlap 31
                                     SpectrumOptions{.overlap = -1}})
    EXPECT_THROW(planSpectra(timeS, values, bad), std::invalid_argument);
  try {
    planSpectra(timeS, values, {.window = 16});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "spectrum: overlap must be 0..15 (below the window), is 31");
  }
  EXPECT_THROW(planSpectra(timeS, std::vector<double>(99)), std::invalid_argument);
  for (const double wrong : {kNan, 0.2, 0.58}) {
    auto times = timeS;
    times[30] = wrong;
    EXPECT_THROW(planSpectra(times, values), std::invalid_argument) << wrong;
  }
}

}  // namespace
}  // namespace palpate::spectrum_series_test
