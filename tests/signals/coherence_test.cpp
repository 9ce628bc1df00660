#include "palpate/signals/coherence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "palpate/core/error.h"

#include "reference_signals.h"
#include "testing/testing.h"

namespace palpate::coherence_test {
namespace {

using testing::referenceA;
using testing::referenceNoise;
using testing::referenceTimes;

// 7 + 3 sin(5.3 Hz) + 3 sin(5.3 Hz, two samples later) + 10 noise(2) + a / 5.
std::vector<double> signalB() {
  const std::vector<double> a = referenceA(), noise = referenceNoise(2);
  std::vector<double> values;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double turn = 2.0 * std::numbers::pi * 5.3 / testing::kReferenceRateHz;
    values.push_back(7.0 + 3.0 * std::sin(turn * static_cast<double>(i)) +
                     3.0 * std::sin(turn * (static_cast<double>(i) - 2.0)) + 10.0 * noise[i] +
                     0.2 * a[i]);
  }
  return values;
}

// scipy 1.10.1: scipy.signal.coherence(a, b, 50, window="hann", nperseg=64, noverlap=32), and the
// angle of scipy.signal.csd of the same.
TEST(Coherence, IsSciPys) {
  const Coherence got = coherenceOf(referenceTimes(), referenceA(), signalB(), welchOptions(64));
  ASSERT_EQ(got.coherence.size(), 33u);
  EXPECT_EQ(got.segments, 17u);
  EXPECT_NEAR(got.binHz, 50.0 / 64.0, 1e-9);
  struct {
    std::size_t bin;
    double coherence, phaseDeg;
  } const expected[] = {{1, 0.3473837981, -4.647178909},
                        {6, 0.9860798689, -13.51264295},
                        {7, 0.9935693518, -13.30240788},
                        {12, 0.09556151174, 73.08543674},
                        {16, 0.8977369237, -0.6885080517},
                        {20, 0.08512707098, -47.06688544}};
  for (const auto& one : expected) {
    EXPECT_NEAR(got.coherence[one.bin], one.coherence, 1e-7) << one.bin;
    EXPECT_NEAR(got.phaseDeg[one.bin], one.phaseDeg, 1e-5) << one.bin;
  }
  EXPECT_NEAR(got.coherence[32], 0.003388251909, 1e-7);
  const auto mean = welchSpectrum(referenceTimes(), referenceA(), welchOptions(64)).mean;
  for (std::size_t k = 0; k < 33; ++k) EXPECT_NEAR(got.psdA[k], mean.psd[k], 1e-9) << k;
}

TEST(Coherence, OfASignalWithItselfIsOne) {
  std::vector<double> twice = referenceA();
  for (double& value : twice) value = 5.0 - 2.0 * value;
  const Coherence got = coherenceOf(referenceTimes(), referenceA(), twice, welchOptions(64));
  for (std::size_t k = 0; k < got.coherence.size(); ++k) {
    EXPECT_NEAR(got.coherence[k], 1.0, 1e-9) << k;
    EXPECT_NEAR(std::abs(got.phaseDeg[k]), 180.0, 1e-6) << k;
  }
}

TEST(Coherence, IndependentNoiseExceedsTheLevelInOneOfTwentyBins) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> timeS, a, b;
  for (int i = 0; i < 40'000; ++i) {
    timeS.push_back(i / 100.0);
    a.push_back(normal(random));
    b.push_back(normal(random));
  }
  std::size_t above = 0, bins = 0;
  // Many records of few segments.
  for (std::size_t begin = 0; begin + 1000 <= a.size(); begin += 1000) {
    const Coherence got = coherenceOf(std::span(timeS).subspan(begin, 1000),
                                      std::span(a).subspan(begin, 1000),
                                      std::span(b).subspan(begin, 1000),
                                      welchOptions(100));
    EXPECT_LT(got.independentSegments, static_cast<double>(got.segments));
    for (std::size_t k = 2; k + 2 < got.coherence.size(); ++k, ++bins)
      above += got.coherence[k] > got.level95() ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(above) / static_cast<double>(bins), 0.05, 0.02);
}

TEST(CoherencePeaks, AreTheCommonFrequencies) {
  const Coherence got = coherenceOf(referenceTimes(), referenceA(), signalB(), welchOptions(64));
  const auto peaks = coherencePeaks(got);
  ASSERT_GE(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].bin, 7u);  // 5.5 Hz
  EXPECT_NEAR(peaks[0].frequencyHz, 7 * 50.0 / 64, 1e-9);
  EXPECT_NEAR(peaks[0].coherence, 0.9935693518, 1e-7);
  EXPECT_NEAR(peaks[0].phaseDeg, -13.30240788, 1e-5);
  EXPECT_EQ(coherencePeaks(got, 1).size(), 1u);
  EXPECT_TRUE(coherencePeaks({}).empty());
}

TEST(Coherence, LeavesOutSamplesThatOneOfThemLacks) {
  std::vector<double> a = referenceA(), b = signalB();
  a[100] = b[200] = std::numeric_limits<double>::quiet_NaN();
  const Coherence got = coherenceOf(referenceTimes(), a, b, welchOptions(64));
  EXPECT_EQ(got.report.notFinite, 2u);
  EXPECT_GT(got.coherence[7], 0.98);
}

TEST(Coherence, NeedsTwoSegmentsAndPower) {
  const Coherence one = coherenceOf(referenceTimes(), referenceA(), signalB(), welchOptions(500));
  EXPECT_TRUE(one.coherence.empty());
  EXPECT_EQ(one.level95(), 1.0);
  const std::vector<double> rest(600, 3.0);
  const Coherence none = coherenceOf(referenceTimes(), referenceA(), rest, welchOptions(64));
  ASSERT_EQ(none.coherence.size(), 33u);
  EXPECT_TRUE(std::all_of(none.coherence.begin(), none.coherence.end(), [](double value) {
    return std::isnan(value);
  }));
  EXPECT_THROW(coherenceOf(referenceTimes(), referenceA(), std::vector<double>{1.0}),
               std::invalid_argument);
  EXPECT_THROW(coherenceOf(referenceTimes(),
                           referenceA(),
                           signalB(),
                           welchOptions(64),
                           [](double) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace palpate::coherence_test
