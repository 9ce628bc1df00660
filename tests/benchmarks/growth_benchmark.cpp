// How costs grow with sizes, for docs/notes/growth.md: opening (frames), the library (recordings),
// training (grasps, classes), an answer (classes), the signals of a frame (taxels). The argument of
// a benchmark is the size; peak_MB is how far the memory rises meanwhile. The timeline's is in
// timeline_benchmark.cpp.
#include <chrono>
#include <filesystem>
#include <random>
#include <string>

#include <benchmark/benchmark.h>

#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/library/recording_catalog.h"
#include "palpate/recognition/grasp_features.h"
#include "palpate/recognition/sample_set.h"
#include "palpate/recognition/session_offset.h"
#include "palpate/recognition/trained_model.h"
#include "palpate/recording/dsa_writer.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/characteristic_signals.h"

#include "growth_bench.h"
#include "testing/testing.h"

namespace palpate::growth_benchmark {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

void openAndReadTheLastFrame(benchmark::State& state, const fs::path& path) {
  const testing::PeakRise rise;
  for (auto _ : state) {
    const Profile profile = openRecording(path);
    benchmark::DoNotOptimize(profile.frame(profile.numFrames() - 1));
  }
  state.counters["peak_MB"] = rise.take();
}

void growthOpen(benchmark::State& state) {
  const testing::TemporaryFolder folder;
  const fs::path path = folder / "long.palpate";
  testing::writeRecordingOf(static_cast<int>(state.range(0)), path);
  openAndReadTheLastFrame(state, path);
}

void growthOpenDsa(benchmark::State& state) {
  const testing::TemporaryFolder folder;
  const fs::path path = folder / "long.dsa";
  const auto frames = static_cast<double>(state.range(0));
  writeDsa(synthesize({.durationS = frames / 31.7, .grasps = static_cast<int>(frames / 100.0)}),
           path);
  openAndReadTheLastFrame(state, path);
}

// A folder of hard links to a recording of ten seconds; a file system may limit the links of one.
void makeLibrary(const fs::path& folder, std::int64_t size) {
  constexpr int kLinksOfAFile = 1000;
  fs::path original;
  for (int i = 0; i < size; ++i) {
    const fs::path path = folder / (std::to_string(i) + ".palpate");
    if (i % kLinksOfAFile == 0) {
      testing::writeRecordingOf(300, path);
      original = path;
    } else {
      fs::create_hard_link(original, path);
    }
  }
}

void growthLibrary(benchmark::State& state, bool knownBefore) {
  const testing::TemporaryFolder folder, cache;
  makeLibrary(folder.path(), state.range(0));
  std::size_t told = 0;
  const CatalogSink sink{.take = [&](RecordingDetails&&) { ++told; }};
  if (knownBefore) catalogRecordings(folder.path(), cache.path(), sink);
  const testing::PeakRise rise;
  for (auto _ : state) {
    if (!knownBefore) {
      state.PauseTiming();
      fs::remove_all(cache.path());
      state.ResumeTiming();
    }
    const CatalogReport report = catalogRecordings(folder.path(), cache.path(), sink);
    if (report.numRead != (knownBefore ? 0 : static_cast<std::size_t>(state.range(0))))
      return state.SkipWithError("the cache doesn't do what it is for");
  }
  state.counters["peak_MB"] = rise.take();
}

// Grasps whose features scatter about a place of their class.
SampleSet graspsOf(int numClasses, std::int64_t numGrasps) {
  SampleSet samples;
  samples.features = featureNames(FeatureSet::kStudy, sdh2());
  const auto columns = static_cast<Eigen::Index>(samples.features.size());
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd places(numClasses, columns);
  for (Eigen::Index i = 0; i < places.size(); ++i) places.data()[i] = 3.0 * normal(random);
  samples.x.resize(numGrasps, columns);
  for (int c = 0; c < numClasses; ++c) samples.classes.push_back("class " + std::to_string(c));
  for (Eigen::Index i = 0; i < samples.x.rows(); ++i) {
    const auto c = static_cast<int>(i % numClasses);
    samples.y.push_back(c);
    for (Eigen::Index j = 0; j < columns; ++j) samples.x(i, j) = places(c, j) + normal(random);
  }
  return samples;
}

PipelineOptions optionsOf(ClassifierKind kind) {
  PipelineOptions options;
  options.classifier = kind;
  if (kind == ClassifierKind::kSvm) options.components = 14;
  return options;
}

void train(benchmark::State& state, const SampleSet& samples, ClassifierKind kind) {
  const testing::PeakRise rise;
  for (auto _ : state)
    benchmark::DoNotOptimize(trainModel(samples, FeatureSet::kStudy, "", optionsOf(kind)));
  state.counters["peak_MB"] = rise.take();
}

void growthTrainGrasps(benchmark::State& state, ClassifierKind kind) {
  train(state, graspsOf(20, state.range(0)), kind);
}

// The same number of grasps, whatever the number of classes.
constexpr int kGraspsOfAllClasses = 3000;

void growthTrainClasses(benchmark::State& state, ClassifierKind kind) {
  train(state, graspsOf(static_cast<int>(state.range(0)), kGraspsOfAllClasses), kind);
}

void growthClassify(benchmark::State& state, ClassifierKind kind) {
  const SampleSet samples = graspsOf(static_cast<int>(state.range(0)), kGraspsOfAllClasses);
  const TrainedModel model = trainModel(samples, FeatureSet::kStudy, "", optionsOf(kind));
  const SessionOffset offset = unknownOffset();
  const testing::PeakRise rise;
  for (auto _ : state)
    benchmark::DoNotOptimize(classifyRows(model, samples.x.topRows(1), offset, true));
  state.counters["peak_MB"] = rise.take();
}

// The signals of a frame all of whose taxels are loaded, in matrices of 10 x 10.
void growthSignals(benchmark::State& state) {
  const std::vector<MatrixLayout> matrices(static_cast<std::size_t>(state.range(0) / 100),
                                           MatrixLayout::full(10, 10, 3.4));
  TactileFrame frame(std::make_shared<const SensorLayout>(matrices));
  for (std::size_t i = 0; i < frame.values.size(); ++i)
    frame.values[i] = static_cast<float>(100 + i % 1000);
  std::vector<CharacteristicSignals> rows;
  const testing::PeakRise rise;
  for (auto _ : state) {
    allSignals(frame, rows);
    benchmark::DoNotOptimize(rows.data());
  }
  state.counters["peak_MB"] = rise.take();
}

void inMs(benchmark::internal::Benchmark* one) {
  one->Unit(benchmark::kMillisecond)->UseRealTime()->RangeMultiplier(10);
}

BENCHMARK(growthOpen)->Apply(inMs)->Range(100, 1'000'000);
BENCHMARK(growthOpenDsa)->Apply(inMs)->Range(100, 100'000);
BENCHMARK_CAPTURE(growthLibrary, first, false)->Apply(inMs)->Range(100, 10'000)->Iterations(1);
BENCHMARK_CAPTURE(growthLibrary, again, true)->Apply(inMs)->Range(100, 10'000);
BENCHMARK_CAPTURE(growthTrainGrasps, gauss, ClassifierKind::kGauss)
    ->Apply(inMs)
    ->Range(100, 10'000);
BENCHMARK_CAPTURE(growthTrainGrasps, svm, ClassifierKind::kSvm)->Apply(inMs)->Range(100, 10'000);
BENCHMARK_CAPTURE(growthTrainClasses, gauss, ClassifierKind::kGauss)
    ->Apply(inMs)
    ->Arg(10)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300);
BENCHMARK_CAPTURE(growthTrainClasses, svm, ClassifierKind::kSvm)
    ->Apply(inMs)
    ->Arg(10)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300);
BENCHMARK_CAPTURE(growthClassify, gauss, ClassifierKind::kGauss)
    ->Apply(inMs)
    ->Arg(10)
    ->Arg(30)
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000);
BENCHMARK(growthSignals)->Apply(inMs)->Range(100, 1'000'000);

}  // namespace
}  // namespace palpate::growth_benchmark
