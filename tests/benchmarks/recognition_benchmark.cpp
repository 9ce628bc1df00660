// Finding grasps beside reading the same frames with nothing done to them (the least it can cost) and from
// a table of signals that is there already. An hour of an SDH-2 with a grasp every ten seconds, in memory.
#include <cstdint>

#include <benchmark/benchmark.h>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recognition/grasp_segments.h"

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

BENCHMARK(readFramesOnly)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(findInFrames, general, GraspRule::kGeneral)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(findInFrames, study, GraspRule::kStudy)->Unit(benchmark::kMillisecond);
BENCHMARK(findInTable)->Unit(benchmark::kMillisecond);

}  // namespace
