// Telling a load that shifts from slip, per matrix: one contest of two frames (key, load field,
// registration), and all that a detector does with a frame. Beside them what the contest adds to:
// the registration of the same pair.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/slip/slip_detector.h"

namespace palpate::contest_benchmark {
namespace {

constexpr std::size_t kFrames = 200;
constexpr std::array<RigidMotion, 1> kFromRest = {RigidMotion{}};

// A bar that wanders and turns: every window is busy.
std::vector<MatrixValues> wandering() {
  SyntheticSlip slip(SyntheticSensor{}, 1);
  std::vector<MatrixValues> frames(kFrames, MatrixValues::Zero(14, 6));
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double t = static_cast<double>(i);
    slip.read({.shape = SlipShape::kBar,
               .x = 2.5 + 0.6 * std::sin(0.13 * t),
               .y = 6.5 + 1.2 * std::sin(0.0314159265 * t),
               .angleDeg = 15.0 * std::sin(0.0314159265 * t)},
              MatrixMap(frames[i].data(), 14, 6));
  }
  return frames;
}

ConstMatrixMap view(const MatrixValues& values) { return {values.data(), 14, 6}; }

void registrationOfAPair(benchmark::State& state) {
  const std::vector<MatrixValues> frames = wandering();
  KeyFrame key(MatrixLayout::full(14, 6, 3.4));
  const RegistrationOptions options = SlipHypothesisOptions{}.registration;
  std::size_t i = 0;
  for (auto _ : state) {
    key.set(view(frames[i % kFrames]));
    benchmark::DoNotOptimize(
        registerFrame(key, view(frames[(i + 3) % kFrames]), {}, options, nullptr));
    ++i;
  }
}
BENCHMARK(registrationOfAPair)->Unit(benchmark::kMicrosecond);

void contestOfAPair(benchmark::State& state) {
  const std::vector<MatrixValues> frames = wandering();
  KeyFrame key(MatrixLayout::full(14, 6, 3.4));
  const SlipHypothesisOptions options;
  std::size_t i = 0;
  for (auto _ : state) {
    key.set(view(frames[i % kFrames]));
    benchmark::DoNotOptimize(
        compareSlipHypotheses(key, view(frames[(i + 3) % kFrames]), kFromRest, options));
    ++i;
  }
}
BENCHMARK(contestOfAPair)->Unit(benchmark::kMicrosecond);

// Windows, rule and at most one contest; the vector is the centroid's. And with the motion weighed
// against the reference.
void detectorOfAMatrix(benchmark::State& state, SlipMethod method) {
  const std::vector<MatrixValues> frames = wandering();
  SlipDetectorOptions options;
  options.method = method;
  SlipDetector detector(MatrixLayout::full(14, 6, 3.4), options);
  std::size_t i = 0;
  std::int64_t timeUs = 0;
  for (auto _ : state) {
    const std::size_t at = i % (2 * kFrames);  // to and fro
    const MatrixValues& frame = frames[at < kFrames ? at : 2 * kFrames - 1 - at];
    benchmark::DoNotOptimize(&detector.update(view(frame), timeUs += 31'500));
    ++i;
  }
}
BENCHMARK_CAPTURE(detectorOfAMatrix, alarm, SlipMethod::kCentroid)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(detectorOfAMatrix, alarm_and_reading, SlipMethod::kContest)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palpate::contest_benchmark
