// Slip of six loaded matrices, translation and rotation together, per frame. Beside each other:
// every method, and what the study's program did for `alcazar`: two full convolutions; and the
// detection in a recording on one thread, two, and all.
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/slip/slip_segments.h"
#include "palpate/slip/slip_tracker.h"

namespace palpate::slip_benchmark {
namespace {

// 200 frames in which a contact wanders on every matrix.
std::vector<TactileFrame> wandering() {
  const auto layout = sdh2().layout;
  std::vector<TactileFrame> frames;
  std::vector<SyntheticSlip> slips;
  for (std::size_t m = 0; m < layout->numMatrices(); ++m) {
    SyntheticSensor sensor;
    sensor.layout = layout->matrix(m);
    slips.emplace_back(sensor, m + 1);
  }
  for (int i = 0; i < 200; ++i) {
    TactileFrame frame(layout);
    frame.hostUs = 1'000'000 + 31'500 * i;
    for (std::size_t m = 0; m < slips.size(); ++m) {
      SyntheticContact contact;
      contact.shape = slipShapes()[m];
      contact.x = 2.5 + 0.6 * std::sin(0.13 * i);
      contact.y = 6.5 + 1.2 * std::sin(0.0314159265 * i);
      contact.angleDeg = 15.0 * std::sin(0.0314159265 * i);
      slips[m].read(contact, frame.matrix(m));
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

void slipOfSixMatrices(benchmark::State& state, SlipMethod method) {
  const std::vector<TactileFrame> frames = wandering();
  SlipTrackerOptions options;
  options.method = method;
  SensorSlipTracker tracker(*sdh2().layout, options);
  std::size_t i = 0;
  std::int64_t stampUs = 0;
  TactileFrame frame = frames[0];
  for (auto _ : state) {
    // To and fro, so that nothing jumps.
    const std::size_t at = i % (2 * frames.size());
    const TactileFrame& source = frames[at < frames.size() ? at : 2 * frames.size() - 1 - at];
    frame.values.assign(source.values.begin(), source.values.end());
    frame.hostUs = (stampUs += 31'500);
    benchmark::DoNotOptimize(tracker.update(frame).data());
    ++i;
  }
}
BENCHMARK_CAPTURE(slipOfSixMatrices, centroid, SlipMethod::kCentroid)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slipOfSixMatrices, alcazar, SlipMethod::kAlcazar)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slipOfSixMatrices, ncc_paraboloid, SlipMethod::kNccParaboloid)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slipOfSixMatrices, ncc_gauss3, SlipMethod::kNccGauss3)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slipOfSixMatrices, phase, SlipMethod::kPhase)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slipOfSixMatrices, phase_normalized, SlipMethod::kPhaseNormalized)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slipOfSixMatrices, register, SlipMethod::kRegister)
    ->Unit(benchmark::kMicrosecond);

// The study's way to `alcazar`: the whole convolution of both frames and its centre of mass.
void studyConvolutionsOfSixMatrices(benchmark::State& state) {
  const std::vector<TactileFrame> frames = wandering();
  std::size_t i = 0;
  for (auto _ : state) {
    const TactileFrame& a = frames[i % frames.size()];
    const TactileFrame& b = frames[(i + 1) % frames.size()];
    for (std::size_t m = 0; m < 6; ++m) {
      const ConstMatrixMap from = a.matrix(m);
      const ConstMatrixMap to = b.matrix(m);
      for (int twice = 0; twice < 2; ++twice) {  // to the last frame and to the reference
        MatrixValues all =
            MatrixValues::Zero(from.rows() + to.rows() - 1, from.cols() + to.cols() - 1);
        for (Eigen::Index y = 0; y < from.rows(); ++y)
          for (Eigen::Index x = 0; x < from.cols(); ++x)
            all.block(y, x, to.rows(), to.cols()) += from(y, x) * to;
        benchmark::DoNotOptimize(all.sum());
      }
    }
    ++i;
  }
}
BENCHMARK(studyConvolutionsOfSixMatrices)->Unit(benchmark::kMicrosecond);

// The slip of a recording: every matrix loaded, 2000 frames, by the number of threads (0: all).
void slipRun(benchmark::State& state) {
  const std::vector<TactileFrame> frames = wandering();
  ProfileBuilder builder(sdh2().layout);
  constexpr std::size_t kFrames = 2000;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const std::size_t at = i % (2 * frames.size());
    builder.addFrame(1'000'000 + 31'500 * static_cast<std::int64_t>(i),
                     frames[at < frames.size() ? at : 2 * frames.size() - 1 - at].values);
  }
  const Profile profile = builder.finish({});
  for (auto _ : state)
    runSlipDetector(profile,
                    {.threads = static_cast<std::size_t>(state.range(0))},
                    [](std::size_t, std::int64_t, const std::vector<SlipDetection>& detections) {
                      benchmark::DoNotOptimize(detections.data());
                    });
  state.SetBytesProcessed(static_cast<std::int64_t>(static_cast<std::size_t>(state.iterations()) *
                                                    kFrames * profile.layout().numCells() * 2));
}
BENCHMARK(slipRun)->Arg(1)->Arg(2)->Arg(0)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace palpate::slip_benchmark
