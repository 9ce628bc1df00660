// Spectra beside OpenCV's transform and the naive one, on as many samples as the shared recording
// of a rough surface has (3236); filters of one signal, per sample.
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include "palpate/filter/kalman.h"
#include "palpate/filter/kelvin_voigt_estimation.h"
#include "palpate/filter/savitzky_golay.h"
#include "palpate/signals/spectrogram.h"

namespace {
using namespace palpate;

constexpr std::size_t kSamples = 3236;

struct Signal {
  std::vector<double> timeS, values;
};

// Intervals that vary by 18 % around 13.4 ms; whole milliseconds, as a .dsa has them, or not.
Signal signal(bool wholeMs) {
  std::mt19937 random(1);
  std::normal_distribution<double> unit;
  Signal made;
  double t = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    made.timeS.push_back(t);
    made.values.push_back(300.0 + 200.0 * std::sin(t) + 10.0 * unit(random));
    const double ms = std::max(6.0, 13.4 + 2.4 * unit(random));
    t += (wholeMs ? std::round(ms) : ms) / 1000.0;
  }
  return made;
}

void countSamples(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kSamples));
}

std::vector<double> hann(std::size_t n) {
  std::vector<double> window(n);
  for (std::size_t i = 0; i < n; ++i)
    window[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                     static_cast<double>(n));
  return window;
}

// Resampling, mean, PSD and magnitude included. "items_per_second" are samples (and segments: each
// begins one).
void spectra(benchmark::State& state) {
  const Signal made = signal(true);
  const auto window = static_cast<int>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(spectrogramOf(
        made.timeS, made.values, {.spectrum = {.window = window, .overlap = window - 1}}));
  countSamples(state);
}

// Only window, transform, magnitude.
void spectraByOpenCv(benchmark::State& state) {
  const Signal made = signal(true);
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<double> window = hann(n);
  std::vector<double> segment(n), magnitudes;
  for (auto _ : state) {
    magnitudes.clear();
    for (std::size_t begin = 0; begin + n <= kSamples; ++begin) {
      for (std::size_t i = 0; i < n; ++i) segment[i] = made.values[begin + i] * window[i];
      cv::Mat spectrum;
      cv::dft(cv::Mat(1, static_cast<int>(n), CV_64F, segment.data()),
              spectrum,
              cv::DFT_COMPLEX_OUTPUT);
      for (std::size_t k = 0; k <= n / 2; ++k)
        magnitudes.push_back(std::abs(spectrum.at<std::complex<double>>(static_cast<int>(k))));
    }
    benchmark::DoNotOptimize(magnitudes.data());
  }
  countSamples(state);
}

// The sum as it is written, with a table of the twiddle factors.
void spectraNaively(benchmark::State& state) {
  const Signal made = signal(true);
  const auto n = static_cast<std::size_t>(state.range(0));
  const std::vector<double> window = hann(n);
  std::vector<std::complex<double>> turns(n);
  for (std::size_t i = 0; i < n; ++i)
    turns[i] =
        std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
  std::vector<double> magnitudes;
  for (auto _ : state) {
    magnitudes.clear();
    for (std::size_t begin = 0; begin + n <= kSamples; ++begin)
      for (std::size_t k = 0; k <= n / 2; ++k) {
        double re = 0.0, im = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
          const double x = made.values[begin + i] * window[i];
          re += x * turns[i * k % n].real();
          im += x * turns[i * k % n].imag();
        }
        magnitudes.push_back(std::hypot(re, im));
      }
    benchmark::DoNotOptimize(magnitudes.data());
  }
  countSamples(state);
}

void runningMean(benchmark::State& state) {  // the least that a filter can cost
  const Signal made = signal(true);
  for (auto _ : state) {
    double mean = 0.0;
    for (const double value : made.values) benchmark::DoNotOptimize(mean += 0.27 * (value - mean));
  }
  countSamples(state);
}

void kalman(benchmark::State& state) {
  const Signal made = signal(true);
  KalmanFilter filter;
  for (auto _ : state)
    for (const double value : made.values) benchmark::DoNotOptimize(filter.step(value));
  countSamples(state);
}

void kalmanSmoother(benchmark::State& state) {
  const Signal made = signal(true);
  for (auto _ : state) benchmark::DoNotOptimize(rtsSmoothed(made.values));
  countSamples(state);
}

// Discretised once; as it comes by whole milliseconds; anew for every sample.
void kelvinVoigtEven(benchmark::State& state) {
  const Signal made = signal(true);
  KelvinVoigtFilter filter{KelvinVoigtModel{}};
  const KelvinVoigtStep interval = kelvinVoigtStep(filter.model(), 0.0134);
  for (auto _ : state)
    for (const double value : made.values) benchmark::DoNotOptimize(filter.step(value, interval));
  countSamples(state);
}

void kelvinVoigt(benchmark::State& state, bool wholeMs) {
  const Signal made = signal(wholeMs);
  KelvinVoigtFilter filter{KelvinVoigtModel{}};
  for (auto _ : state) {
    filter.restart();
    for (std::size_t i = 0; i < kSamples; ++i)
      benchmark::DoNotOptimize(
          filter.step(made.values[i], i > 0 ? made.timeS[i] - made.timeS[i - 1] : 0.0));
  }
  countSamples(state);
}

void kelvinVoigtSmoother(benchmark::State& state) {
  const Signal made = signal(true);
  for (auto _ : state)
    benchmark::DoNotOptimize(kelvinVoigtSmoothed(made.timeS, made.values, KelvinVoigtModel{}));
  countSamples(state);
}

// "items_per_second" are samples times rounds.
void estimation(benchmark::State& state, bool wholeMs) {
  constexpr int kRounds = 20;
  const Signal made = signal(wholeMs);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        estimateKelvinVoigt(made.timeS, made.values, {.tolerance = 0.0, .maxRounds = kRounds}));
  state.SetItemsProcessed(state.iterations() * kRounds * static_cast<std::int64_t>(kSamples));
}

void savitzkyGolay(benchmark::State& state) {
  const auto window = static_cast<int>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(savitzkyGolayWeights(window, 2, 0, (window - 1) / 2.0));
}

BENCHMARK(spectra)->Arg(32)->Arg(256)->Arg(251)->Unit(benchmark::kMillisecond);
BENCHMARK(spectraByOpenCv)->Arg(32)->Arg(256)->Arg(251)->Unit(benchmark::kMillisecond);
BENCHMARK(spectraNaively)->Arg(32)->Arg(256)->Arg(251)->Unit(benchmark::kMillisecond);
BENCHMARK(runningMean)->Unit(benchmark::kMicrosecond);
BENCHMARK(kalman)->Unit(benchmark::kMicrosecond);
BENCHMARK(kalmanSmoother)->Unit(benchmark::kMicrosecond);
BENCHMARK(kelvinVoigtEven)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(kelvinVoigt, whole_ms, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(kelvinVoigt, any_interval, false)->Unit(benchmark::kMicrosecond);
BENCHMARK(kelvinVoigtSmoother)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(estimation, whole_ms, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(estimation, any_interval, false)->Unit(benchmark::kMillisecond);
BENCHMARK(savitzkyGolay)->Arg(5)->Arg(101)->Unit(benchmark::kMicrosecond);

}  // namespace
