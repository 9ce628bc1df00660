// Calibration beside references in the same run: the step fit (variable projection, several
// starts), plain and with a robust loss, beside one search of the same model's four parameters by
// the same solver; a recording of ten minutes with thirty steps; a live frame through a calibration
// beside the characteristic signals of that frame.
#include <cmath>
#include <random>

#include <benchmark/benchmark.h>

#include "palpate/calibration/least_squares.h"
#include "palpate/calibration/pressure_map.h"
#include "palpate/calibration/step_report.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"
#include "palpate/signals/characteristic_signals.h"

namespace palpate::calibration_benchmark {
namespace {

constexpr double kRateHz = 31.7;

struct Samples {
  std::vector<double> t, y;
};

Samples stepOf500() {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 11.0);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  const StepParameters truth = StepParameters::ofTimes(436.0, 12.4, 0.505, 0.0636);
  Samples samples;
  for (int i = 0; i < 500; ++i) {
    samples.t.push_back(i == 0 ? 0.0 : (i + jitter(random)) / kRateHz);
    samples.y.push_back(stepResponse(truth, samples.t.back()) + noise(random));
  }
  return samples;
}

void BM_StepFitOf500Samples(benchmark::State& state) {
  const Samples samples = stepOf500();
  for (auto _ : state) benchmark::DoNotOptimize(fitStep(samples.t, samples.y));
}
BENCHMARK(BM_StepFitOf500Samples)->Unit(benchmark::kMicrosecond);

// The same step with every twelfth sample 150 counts too high: the plain fit, its repetitions with
// less weight for outliers.
void BM_StepFitOf500SamplesHuber(benchmark::State& state) {
  Samples samples = stepOf500();
  for (std::size_t i = 36; i < samples.y.size(); i += 12) samples.y[i] += 150.0;
  StepFitOptions options;
  options.loss = StepLoss::kHuber;
  for (auto _ : state) benchmark::DoNotOptimize(fitStep(samples.t, samples.y, options));
}
BENCHMARK(BM_StepFitOf500SamplesHuber)->Unit(benchmark::kMicrosecond);

// K, m, log T1, log T2 from one good start, derivatives by differences.
void BM_StepFitOf500SamplesByCeres(benchmark::State& state) {
  const Samples samples = stepOf500();
  LeastSquaresProblem problem;
  problem.numResiduals = samples.t.size();
  problem.residuals = [&](std::span<const double> x, std::span<double> r) {
    const StepParameters p = StepParameters::ofTimes(x[0], x[1], std::exp(x[2]), std::exp(x[3]));
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = samples.y[i] - stepResponse(p, samples.t[i]);
    return true;
  };
  const Eigen::Vector4d start(400.0, 10.0, std::log(0.4), std::log(0.05));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        solveLeastSquares(problem, start, {.maxIterations = 100, .tolerance = 1e-10}));
}
BENCHMARK(BM_StepFitOf500SamplesByCeres)->Unit(benchmark::kMicrosecond);

Profile tenMinutes() {
  ProfileBuilder builder(sdh2().layout);
  const std::size_t offset = sdh2().layout->offset(1);
  const StepParameters p = StepParameters::ofTimes(4000.0 / 10.0, 10.0, 0.5, 0.07);
  for (int i = 0; i < 600 * kRateHz; ++i) {
    const double inStep = std::fmod(i / kRateHz, 20.0) - 5.0;  // 5 s unloaded, 15 s loaded
    std::vector<float> values(sdh2().layout->numCells(), 0.0F);
    const auto counts = static_cast<float>(std::round(stepResponse(p, inStep)));
    for (std::size_t place = 30; place < 54; ++place) values[offset + place] = counts;
    builder.addFrame(1 + static_cast<std::int64_t>(1e6 * i / kRateHz), values);
  }
  builder.addTemperatures(1, std::vector<double>(9, 35.0));
  return builder.finish({});
}

void BM_TenMinutesWithThirtySteps(benchmark::State& state) {
  const Profile profile = tenMinutes();
  std::size_t steps = 0;
  for (auto _ : state) steps = reportSteps(profile, 1).steps.size();
  state.counters["steps"] = static_cast<double>(steps);
}
BENCHMARK(BM_TenMinutesWithThirtySteps)->Unit(benchmark::kMillisecond);

// Reading the frames alone.
void BM_TenMinutesReadOnly(benchmark::State& state) {
  const Profile profile = tenMinutes();
  TactileFrame frame;
  for (auto _ : state)
    for (std::size_t i = 0; i < profile.numFrames(); ++i) profile.readFrame(i, frame);
}
BENCHMARK(BM_TenMinutesReadOnly)->Unit(benchmark::kMillisecond);

// A grasp: two fingertips and one proximal matrix are touched.
TactileFrame grasp() {
  TactileFrame frame(sdh2().layout);
  for (const std::size_t m : {std::size_t{1}, std::size_t{4}, std::size_t{5}})
    for (Eigen::Index y = 5; y < 10; ++y)
      for (Eigen::Index x = 1; x < 5; ++x)
        frame.matrix(m)(y, x) = static_cast<float>(200 + 50 * x + 30 * y);
  return frame;
}

void BM_CalibrationOfALiveFrame(benchmark::State& state) {
  Calibration calibration;
  for (int i = 0; i < 24; ++i) {
    PressureSample s;
    s.staticResponseCounts = 100.0 + 30.0 * i;
    s.driftCountsPerS = 2.0 + 0.5 * i + (i % 3);
    s.nearestDegC = 28.0 + 4.0 * (i % 5);
    s.pressureKpa = 20.0 + 3.0 * i + (i % 2);
    calibration.samples.push_back(s);
  }
  calibration.pressure = fitPressureModel(calibration.samples);
  calibration.pressure.steadyS = 1.6;
  PressureMap map(calibration, sdh2());
  TactileFrame frame = grasp();
  const std::vector<double> degC(9, 36.0);
  PressureFrame out;
  for (auto _ : state) {
    frame.hostUs += 31'500;
    map.apply(frame, degC, out);
    benchmark::DoNotOptimize(out);
  }
}
BENCHMARK(BM_CalibrationOfALiveFrame);

void BM_CharacteristicSignalsOfALiveFrame(benchmark::State& state) {
  const TactileFrame frame = grasp();
  for (auto _ : state) benchmark::DoNotOptimize(characteristicSignals(frame));
}
BENCHMARK(BM_CharacteristicSignalsOfALiveFrame);

}  // namespace
}  // namespace palpate::calibration_benchmark
