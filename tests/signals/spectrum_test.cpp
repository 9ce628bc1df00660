#include "palpate/signals/spectrum.h"

#include <complex>

#include "palpate/core/error.h"

#include "filter/spectra_of.h"
#include "testing/testing.h"

namespace palpate::spectrum_test {
namespace {

using testing::evenTimes;
using testing::jitteredTimes;
using testing::Kept;
using testing::kPi;
using testing::noise;
using testing::Spectra;
using testing::spectraOf;
using testing::tone;

// Straight from the definition, in long double: window, transform, scaling.
Kept byDefinition(const std::vector<double>& samples, double rateHz) {
  const std::size_t n = samples.size();
  const long double turn = 2.0L * std::numbers::pi_v<long double>;
  long double sum = 0.0L, squares = 0.0L, mean = 0.0L;
  for (const double x : samples) mean += x;
  mean /= static_cast<long double>(n);
  std::vector<long double> weighed(n);
  for (std::size_t i = 0; i < n; ++i) {
    const long double w =
        (1.0L - std::cos(turn * static_cast<long double>(i) / static_cast<long double>(n))) / 2.0L;
    weighed[i] = (static_cast<long double>(samples[i]) - mean) * w;
    sum += w;
    squares += w * w;
  }
  Kept kept;
  for (std::size_t k = 0; k <= n / 2; ++k) {
    std::complex<long double> x = 0.0L;
    for (std::size_t i = 0; i < n; ++i)
      x += weighed[i] *
           std::polar(1.0L,
                      -turn * static_cast<long double>(i * k % n) / static_cast<long double>(n));
    const long double sides = k == 0 || 2 * k == n ? 1.0L : 2.0L;
    kept.psd.push_back(static_cast<double>(sides * std::norm(x) / (rateHz * squares)));
    kept.magnitude.push_back(static_cast<double>(sides * std::abs(x) / sum));
  }
  return kept;
}

// Powers of two, small and large primes, and what is neither.
TEST(Spectrum, IsTheTransformOfTheDefinitionForEveryLength) {
  for (const int n : {2, 3, 4, 5, 6, 7, 10, 31, 32, 50, 61, 67, 134, 251, 254, 499, 1000}) {
    const auto size = static_cast<std::size_t>(n);
    std::vector<double> values = noise(2 * size, 100.0);
    for (double& value : values) value += 500.0;
    const Spectra spectra =
        spectraOf(evenTimes(2 * size, 50.0), values, {.window = n, .overlap = 0});
    ASSERT_EQ(spectra.segments.size(), 2u) << n;
    for (std::size_t s = 0; s < 2; ++s) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(s * size);
      const Kept expected = byDefinition({begin, begin + static_cast<std::ptrdiff_t>(size)}, 50.0);
      for (std::size_t k = 0; k < expected.psd.size(); ++k) {
        EXPECT_NEAR(spectra.segments[s].psd[k], expected.psd[k], 1e-7) << n << " bin " << k;
        EXPECT_NEAR(spectra.segments[s].magnitude[k], expected.magnitude[k], 1e-7) << n;
      }
    }
  }
}

TEST(Spectrum, OfAToneAtABinReadsItsAmplitudeThere) {
  const double rateHz = 64.0;
  const auto timeS = evenTimes(200, rateHz);
  for (std::size_t bin = 1; bin < 16; ++bin) {
    const Spectra spectra = spectraOf(timeS, tone(timeS, 2.0 * static_cast<double>(bin), 120.0));
    EXPECT_NEAR(spectra.report.rateHz, rateHz, 1e-9);
    ASSERT_EQ(spectra.segments.size(), 169u);
    for (const Kept& segment : spectra.segments) {
      EXPECT_DOUBLE_EQ(segment.binHz, 2.0);
      EXPECT_NEAR(segment.magnitude[bin], 120.0, 1e-6) << "bin " << bin;
      for (std::size_t k = 0; k < segment.magnitude.size(); ++k)
        if (k + 1 < bin || k > bin + 1) {
          EXPECT_NEAR(segment.magnitude[k], 0.0, 1e-6) << k;
        }
    }
  }
}

// Between bins: the transform of the periodic Hann window, W(d) = D(d)/2 + (D(d-1) + D(d+1))/4 with
// the Dirichlet kernel D(d) = sum e^(2 pi i d n / N), a geometric series.
TEST(Spectrum, OfAToneBetweenBinsLosesTheScallopingOfTheHannWindow) {
  const int n = 256;
  const auto dirichlet = [](double d) {
    const std::complex<double> q = std::polar(1.0, 2.0 * kPi * d / n);
    return std::abs(q - 1.0) < 1e-12 ? std::complex<double>(n, 0.0)
                                     : (std::polar(1.0, 2.0 * kPi * d) - 1.0) / (q - 1.0);
  };
  const auto timeS = evenTimes(400, 256.0);
  for (const double offset : {0.0, 0.1, 0.25, 0.5}) {
    const auto spectra = spectraOf(timeS, tone(timeS, 60.0 + offset, 10.0), {.window = n});
    const std::complex<double> gain =
        0.5 * dirichlet(offset) - 0.25 * dirichlet(offset - 1.0) - 0.25 * dirichlet(offset + 1.0);
    const double expected = 10.0 * std::abs(gain) / (n / 2.0);
    for (const Kept& segment : spectra.segments) {
      EXPECT_NEAR(segment.magnitude[60], expected, 1e-3) << offset;
      const auto strongest = std::max_element(segment.magnitude.begin(), segment.magnitude.end());
      EXPECT_NEAR(static_cast<double>(strongest - segment.magnitude.begin()), 60.0 + offset, 0.51);
    }
  }
  // The half way of the header.
  const auto half = spectraOf(timeS, tone(timeS, 60.5, 10.0), {.window = n});
  EXPECT_NEAR(half.segments[0].magnitude[60], 8.488, 0.002);
}

TEST(Spectrum, KeepsTheEnergyOfEachSegment) {
  for (const int n : {32, 33, 100}) {
    const auto size = static_cast<std::size_t>(n);
    const std::vector<double> values = noise(size, 30.0);
    const auto spectra = spectraOf(
        evenTimes(size, 74.0), values, {.window = n, .overlap = 0, .detrend = Detrend::kNone});
    double weighed = 0.0, squares = 0.0, total = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      const double w = std::pow(std::sin(kPi * static_cast<double>(i) / n), 2);
      weighed += values[i] * values[i] * w * w;
      squares += w * w;
    }
    for (const double density : spectra.segments.at(0).psd) total += density * 74.0 / n;
    EXPECT_NEAR(total, weighed / squares, 1e-9 * total);
  }
}

// One-sided: the variance of white noise is spread over 0..Nyquist.
TEST(Spectrum, OfWhiteNoiseIsItsVarianceOverNyquist) {
  const auto timeS = evenTimes(64'000, 80.0);
  const auto values = noise(timeS.size(), 5.0);
  const SpectrumOptions options{.window = 64, .overlap = 32};
  MeanSpectrumCollector mean(planSpectra(timeS, values, options));
  visitSpectra(timeS, values, options, [&](const SpectrumSegment& segment) { mean.add(segment); });
  const MeanSpectrum result = mean.result();
  ASSERT_EQ(result.segments, 1999u);
  double level = 0.0;  // away from 0 Hz, which lost its mean
  for (std::size_t k = 3; k < 30; ++k) level += result.psd[k] / 27.0;
  EXPECT_NEAR(level, 25.0 / 40.0, 0.02 * 25.0 / 40.0);
}

TEST(Spectrum, OfAJitteredToneIsWithinOneBinAndOnePercent) {
  const auto timeS = jitteredTimes(3000, 74.0);
  const SpectrumOptions options{.window = 128, .overlap = 64};
  const SpectrumReport plan = planSpectra(timeS, std::vector<double>(timeS.size()), options);
  EXPECT_NEAR(plan.jitter, 0.25, 0.01);
  EXPECT_NEAR(plan.rateHz, 2999.0 / timeS.back(), 1e-9);
  EXPECT_NEAR(plan.nyquistHz, plan.rateHz / 2.0, 1e-12);
  for (const std::size_t bin : {3u, 5u}) {
    const double hz = static_cast<double>(bin) * plan.rateHz / 128.0;
    MeanSpectrumCollector mean(plan);
    visitSpectra(timeS, tone(timeS, hz, 200.0), options, [&](const SpectrumSegment& segment) {
      EXPECT_NEAR(segment.magnitude[bin], 200.0, 2.0);
      mean.add(segment);
    });
    EXPECT_EQ(mean.result().strongestBin(), bin);
    EXPECT_NEAR(mean.result().strongestHz(), hz, 1e-9);
    EXPECT_NEAR(mean.result().magnitude[bin], 200.0, 2.0);
  }
}

// What linear interpolation leaves of e^(i w t) at a place u of an interval L, (1-u) e^(-i w u L) +
// u e^(i w (1-u) L), is on average over u sinc^2(f L); an interval holds points in proportion to
// its length.
TEST(Spectrum, OfAJitteredToneNearNyquistIsDampedAsTheFormulaSays) {
  const auto timeS = jitteredTimes(20'000, 74.0);
  const SpectrumOptions options{.window = 128, .overlap = 64};
  const SpectrumReport plan = planSpectra(timeS, std::vector<double>(timeS.size()), options);
  for (const std::size_t bin : {16u, 32u, 48u}) {
    const double hz = static_cast<double>(bin) * plan.rateHz / 128.0;
    double gain = 0.0;
    for (std::size_t i = 1; i < timeS.size(); ++i) {
      const double interval = timeS[i] - timeS[i - 1], angle = kPi * hz * interval;
      gain += interval / timeS.back() * std::pow(std::sin(angle) / angle, 2);
    }
    MeanSpectrumCollector mean(plan);
    visitSpectra(timeS, tone(timeS, hz, 200.0), options, [&](const SpectrumSegment& segment) {
      mean.add(segment);
    });
    EXPECT_EQ(mean.result().strongestBin(), bin);
    EXPECT_NEAR(mean.result().magnitude[bin] / 200.0, gain, 0.02) << hz;
    EXPECT_NEAR(interpolationGain(hz, plan.rateHz), gain, 0.05) << hz;
  }
  EXPECT_NEAR(interpolationGain(0.5, 1.0), 4.0 / (kPi * kPi), 1e-12);
  EXPECT_EQ(interpolationGain(0.0, 1.0), 1.0);
}

TEST(Spectrum, StepsShowOnlyInWindowsThatHoldThem) {
  const auto timeS = evenTimes(200, 50.0);
  std::vector<double> values(200, 40.0);
  for (std::size_t i = 100; i < 200; ++i) values[i] = 90.0;
  const auto spectra = spectraOf(timeS, values);
  for (std::size_t s = 0; s < spectra.segments.size(); ++s) {
    const bool holds = s < 100 && s + 32 > 100;
    double total = 0.0;
    for (const double density : spectra.segments[s].psd) total += density;
    // Where only the window's zero touches the other side the transform is of the mean alone.
    EXPECT_EQ(total > 0.0, holds) << s;
    EXPECT_NEAR(spectra.segments[s].timeS, (static_cast<double>(s) + 16.0) / 50.0, 1e-9);
    if (!holds) continue;
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(s);
    const Kept expected = byDefinition({begin, begin + 32}, 50.0);
    for (std::size_t k = 0; k < 17; ++k)
      EXPECT_NEAR(spectra.segments[s].magnitude[k], expected.magnitude[k], 1e-9);
  }
}

TEST(Spectrum, DetrendsAsAsked) {
  const auto timeS = evenTimes(64, 32.0);
  std::vector<double> ramp(64), constant(64, 70.0);
  for (std::size_t i = 0; i < 64; ++i) ramp[i] = 5.0 + 3.0 * static_cast<double>(i);
  const auto straight = spectraOf(timeS, ramp, {.detrend = Detrend::kLine});
  for (const double magnitude : straight.segments[7].magnitude) EXPECT_NEAR(magnitude, 0.0, 1e-10);
  EXPECT_GT(spectraOf(timeS, ramp).segments[7].magnitude[1], 1.0) << "the mean leaves the slope";
  for (const auto how : {Detrend::kMean, Detrend::kLine}) {
    const auto spectra = spectraOf(timeS, constant, {.detrend = how});
    for (const double magnitude : spectra.segments[0].magnitude) EXPECT_EQ(magnitude, 0.0);
  }
  // Hann: the transform of a constant c is c N/2 at 0, -c N/4 beside it.
  const auto kept =
      spectraOf(timeS, constant, {.detrend = Detrend::kNone}).segments.at(0).magnitude;
  EXPECT_NEAR(kept[0], 70.0, 1e-9);
  EXPECT_NEAR(kept[1], 70.0, 1e-9);
  EXPECT_NEAR(kept[2], 0.0, 1e-9);
}

TEST(Spectrum, TakesTheLongestWindowEvenOfAPrimeNumberOfSamples) {
  const auto timeS = evenTimes(65'536, 100.0);
  const int prime = 65'521;
  const double hz = 4000.0 * 100.0 / prime;
  const auto spectra = spectraOf(timeS, tone(timeS, hz, 9.0), {.window = prime, .overlap = 0});
  EXPECT_NEAR(spectra.segments.at(0).magnitude[4000], 9.0, 1e-6);
  EXPECT_NEAR(spectra.segments.at(0).magnitude[4100], 0.0, 1e-6);
  EXPECT_EQ(planSpectra(timeS, timeS, {.window = 65'536}).segments, 1u);
}

TEST(Spectrum, CanBeCancelled) {
  const auto timeS = evenTimes(1000, 50.0);
  std::size_t seen = 0;
  const auto run = [&] {
    visitSpectra(
        timeS,
        timeS,
        {},
        [&](const SpectrumSegment&) { ++seen; },
        [&](double) { return seen < 100; });
  };
  EXPECT_THROW(run(), Cancelled);
  EXPECT_LT(seen, 200u);
}

}  // namespace
}  // namespace palpate::spectrum_test
