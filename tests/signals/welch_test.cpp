#include "palpate/signals/welch.h"

#include <stdexcept>

#include "palpate/core/error.h"

#include "reference_signals.h"
#include "testing/testing.h"

namespace palpate::welch_test {
namespace {

using testing::referenceA;
using testing::referenceTimes;

// scipy 1.10.1: scipy.signal.welch(a, 50, window="hann", nperseg=64, noverlap=32,
// detrend="constant")
TEST(Welch, IsSciPysMeanSpectrum) {
  const WelchSpectrum spectrum = welchSpectrum(referenceTimes(), referenceA(), welchOptions(64));
  EXPECT_EQ(spectrum.report.segments, 17u);  // (600 - 64) / 32 + 1
  EXPECT_EQ(spectrum.mean.segments, 17u);
  ASSERT_EQ(spectrum.mean.psd.size(), 33u);
  EXPECT_NEAR(spectrum.mean.binHz, 50.0 / 64.0, 1e-9);
  const std::pair<std::size_t, double> expected[] = {{0, 0.5720094713},
                                                     {1, 0.4039082525},
                                                     {6, 297.6701111},
                                                     {7, 641.913987},
                                                     {8, 82.33378504},
                                                     {16, 98.86399075},
                                                     {32, 0.2360653657}};
  for (const auto& [bin, psd] : expected)
    EXPECT_NEAR(spectrum.mean.psd[bin], psd, 1e-6 * psd) << bin;
}

// scipy 1.10.1: find_peaks(10 log10(psd), prominence=3), and peak_widths(psd, peaks, rel_height=.5)
// with prominences psd[peaks] over the whole spectrum.
TEST(SpectralPeaks, AreThoseOfSciPy) {
  const auto peaks =
      spectralPeaks(welchSpectrum(referenceTimes(), referenceA(), welchOptions(64)).mean);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].bin, 7u);
  EXPECT_EQ(peaks[1].bin, 16u);
  EXPECT_NEAR(peaks[0].widthHz, 1.176500773, 1e-7);
  EXPECT_NEAR(peaks[1].widthHz, 1.047352488, 1e-7);
  EXPECT_NEAR(peaks[0].prominenceDb, 32.74714401, 1e-6);
  EXPECT_NEAR(peaks[1].prominenceDb, 25.72672094, 1e-6);
}

TEST(SpectralPeaks, SayFrequencyAndAmplitudeOfATone) {
  const auto peaks =
      spectralPeaks(welchSpectrum(referenceTimes(), referenceA(), welchOptions(64)).mean);
  ASSERT_EQ(peaks.size(), 2u);
  // 5.3 Hz lies between two bins 0.78 Hz apart, 12.5 Hz on one.
  EXPECT_NEAR(peaks[0].frequencyHz, 5.3, 0.03);
  EXPECT_NEAR(peaks[0].amplitude, 40.0, 0.05 * 40.0);
  EXPECT_NEAR(peaks[1].frequencyHz, 12.5, 0.03);
  EXPECT_NEAR(peaks[1].amplitude, 15.0, 0.05 * 15.0);
}

TEST(SpectralPeaks, TheLargestAreKept) {
  MeanSpectrum mean;
  mean.binHz = 0.5;
  mean.psd = {9, 1, 4, 1, 16, 1, 1, 2, 1, 30};
  mean.magnitude.assign(10, 1.0);
  std::vector<std::size_t> bins;
  for (const SpectralPeak& peak : spectralPeaks(mean)) bins.push_back(peak.bin);
  EXPECT_EQ(bins, (std::vector<std::size_t>{4, 2, 7}));  // 2 over 1 is 3.01 dB
  EXPECT_EQ(spectralPeaks(mean, {.maxPeaks = 1}).size(), 1u);
  EXPECT_EQ(spectralPeaks(mean, {.prominenceDb = 5.0}).size(), 2u);
  EXPECT_THROW(spectralPeaks(mean, {.prominenceDb = 0.0}), std::invalid_argument);
  // A flat top: its middle. Zeros are far below.
  mean.psd = {0, 5, 5, 5, 0};
  mean.magnitude.assign(5, 1.0);
  const auto flat = spectralPeaks(mean);
  ASSERT_EQ(flat.size(), 1u);
  EXPECT_EQ(flat[0].bin, 2u);
  EXPECT_NEAR(flat[0].frequencyHz, 1.0, 1e-12);
  EXPECT_NEAR(flat[0].widthHz, 3.0 * 0.5, 1e-12);  // from bin 0.5 to 3.5
}

TEST(SpectralPeaks, NothingHasNone) {
  EXPECT_TRUE(spectralPeaks({}).empty());
  const std::vector<double> load(600, 80.0);
  EXPECT_TRUE(spectralPeaks(welchSpectrum(referenceTimes(), load, welchOptions(64)).mean).empty());
}

TEST(Welch, ASeriesShorterThanTheWindowHasNoBins) {
  const WelchSpectrum spectrum = welchSpectrum(referenceTimes(), referenceA(), welchOptions(601));
  EXPECT_EQ(spectrum.report.segments, 0u);
  EXPECT_TRUE(spectrum.mean.psd.empty());
  EXPECT_THROW(
      welchSpectrum(referenceTimes(), referenceA(), welchOptions(), [](double) { return false; }),
      Cancelled);
}

}  // namespace
}  // namespace palpate::welch_test
