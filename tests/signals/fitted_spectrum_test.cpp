// The spectrum of a signal whose frames arrive in bursts, by the sender's clock.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/model/fitted_times.h"
#include "palpate/model/profile_builder.h"
#include "palpate/signals/profile_series.h"
#include "palpate/signals/welch.h"

namespace palpate::fitted_spectrum_test {
namespace {

// 1 kHz, ten frames per write: a sine of 50 Hz and amplitude 500.
Profile sineInBursts() {
  const auto layout = std::make_shared<SensorLayout>(std::vector{MatrixLayout::full(1, 1, 1.0)});
  ProfileBuilder builder(layout);
  for (std::int64_t i = 0; i < 20'000; ++i) {
    const double turns = 0.05 * static_cast<double>(i);
    const std::vector values{
        static_cast<float>(1000.0 + 500.0 * std::sin(2.0 * std::numbers::pi * turns))};
    builder.addFrame(
        1'700'000'000'000'000 + (i / 10 * 10 + 9) * 1000 + i % 10, values, 5'000'000 + i * 1000);
  }
  return builder.finish({});
}

std::vector<SpectralPeak> peaksOf(const Profile& profile) {
  TaxelSelection taxel(profile.layout());
  taxel.toggle(0, 0, 0);
  const Series series =
      readSeries(profile, {.kind = SeriesChoice::Kind::kTaxels, .taxels = taxel}, -1.0, 1e6, {});
  return spectralPeaks(welchSpectrum(series.timeS, series.values, welchOptions(1000)).mean);
}

TEST(FittedSpectrum, ASineInBurstsIsOneLineAgain) {
  const Profile profile = sineInBursts();
  EXPECT_LT(peaksOf(profile).front().amplitude, 400.0);
  const auto peaks = peaksOf(fittedTimes(profile).profile);
  ASSERT_FALSE(peaks.empty());
  EXPECT_NEAR(peaks.front().frequencyHz, 50.0, 0.01);
  EXPECT_NEAR(peaks.front().amplitude, 500.0, 20.0);  // at most 4 % too large
  for (std::size_t i = 1; i < peaks.size(); ++i) EXPECT_LT(peaks[i].amplitude, 1.0);
}

}  // namespace
}  // namespace palpate::fitted_spectrum_test
