// Finding grasps beside reading the same frames with nothing done to them (the least it can cost)
// and from a table of signals that is there already. An hour of an SDH-2 with a grasp every ten
// seconds, in memory.
#include <cstdint>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recognition/chebyshev_moments.h"
#include "palpate/recognition/grasp_features.h"
#include "palpate/recognition/grasp_segments.h"
#include "palpate/recognition/session_adaptive_classifier.h"
#include "palpate/recognition/session_offset.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace {
using namespace palpate;

constexpr int kGrasps = 360;

const Profile& hour() {
  static const Profile profile =
      synthesize({.durationS = 3600.0, .angleRateHz = 0.0, .grasps = kGrasps, .noiseCounts = 5.0});
  return profile;
}

// "items_per_second" are frames.
void countFrames(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(hour().numFrames()));
}

void readFramesOnly(benchmark::State& state) {
  const std::size_t frames = hour().numFrames();  // made before the clock runs
  TactileFrame frame;
  for (auto _ : state)
    for (std::size_t i = 0; i < frames; ++i) {
      hour().readFrame(i, frame);
      benchmark::DoNotOptimize(frame.values.data());
    }
  countFrames(state);
}

void findInFrames(benchmark::State& state, GraspRule rule) {
  for (auto _ : state)
    if (findGrasps(hour(), {.rule = rule}).size() != kGrasps)
      return state.SkipWithError("not the grasps that are there");
  countFrames(state);
}

void findInTable(benchmark::State& state) {
  const SignalTable table = SignalTable::of(hour());
  const TimingReport timing = timingOf(hour());
  for (auto _ : state)
    if (findGrasps(hour(), table, timing).size() != kGrasps)
      return state.SkipWithError("not the grasps that are there");
  countFrames(state);
}

// Features of one real grasp that is loaded (46 frames), beside reading its frames with nothing
// done to them. The prior program took 20 to 24 ms.
const Profile& realGrasp() {
  static const Profile profile = [] {
    const auto folder = palpate::testing::recordingsFolder();
    if (!folder) return synthesize({.durationS = 4.0, .grasps = 1, .noiseCounts = 5.0});
    return openRecording(*folder / "grasps_by_class/aerosol_can/aerosol_can_000083-000147.dsa");
  }();
  return profile;
}

void readGraspOnly(benchmark::State& state) {
  const GraspSegment grasp = findPinches(realGrasp(), FeatureSet::kBest).at(0);
  TactileFrame frame;
  for (auto _ : state)
    for (std::size_t i = grasp.begin; i <= grasp.end; ++i) {
      realGrasp().readFrame(i, frame);
      benchmark::DoNotOptimize(frame.values.data());
    }
}

void featuresOfGrasp(benchmark::State& state, FeatureSet set) {
  const GraspSegment grasp = findPinches(realGrasp(), FeatureSet::kBest).at(0);
  for (auto _ : state) {
    const GraspFeatures features = graspFeatures(realGrasp(), grasp, set);
    if (!features.problem.empty()) return state.SkipWithError(features.problem.c_str());
    benchmark::DoNotOptimize(features.values.data());
  }
}

// 25 invariants of a picture of 14 x 14 with some 20 pixels; the prior program's six-fold sums took
// 11 ms.
void momentInvariants(benchmark::State& state) {
  const ChebyshevPolynomials polynomials(14, 4);
  Eigen::MatrixXd picture = Eigen::MatrixXd::Zero(14, 14);
  for (int i = 0; i < 20; ++i) picture(4 + i / 4, 5 + i % 4) = 0.1 + 0.01 * i;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        chebyshevInvariants(picture, polynomials, ImageOrientation::kStudy).moments.data());
}

// One answer among 36 classes, summed over an unknown session offset.
void answerInAnotherSession(benchmark::State& state) {
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(36 * 10, 11) * 5.0;
  std::vector<int> y;
  std::vector<std::string> classes, features = featureNames(FeatureSet::kBest, sdh2());
  for (int c = 0; c < 36; ++c) classes.push_back("class " + std::to_string(c));
  for (int i = 0; i < 360; ++i) y.push_back(i % 36);
  const SessionAdaptiveClassifier model = SessionAdaptiveClassifier::learn(x, y, classes, features);
  const SessionOffset offset = unknownOffset();
  const Eigen::VectorXd one = x.row(7).transpose();
  for (auto _ : state) benchmark::DoNotOptimize(predict(model, one, offset).logLikelihoodRatio);
}

BENCHMARK(readGraspOnly)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(featuresOfGrasp, study, FeatureSet::kStudy)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(featuresOfGrasp, best, FeatureSet::kBest)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(featuresOfGrasp, session, FeatureSet::kSession)->Unit(benchmark::kMicrosecond);
BENCHMARK(momentInvariants)->Unit(benchmark::kMicrosecond);
BENCHMARK(answerInAnotherSession)->Unit(benchmark::kMicrosecond);
BENCHMARK(readFramesOnly)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(findInFrames, general, GraspRule::kGeneral)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(findInFrames, study, GraspRule::kStudy)->Unit(benchmark::kMillisecond);
BENCHMARK(findInTable)->Unit(benchmark::kMillisecond);

}  // namespace
