// Recordings to MCAP (target: 100 MB of taxels per second, two bytes per taxel, in 300 MB of
// memory) and back: a synthetic recording of an hour in a .palpate, in each compression, and with
// its signals; beside it the same frames only read.

#include <benchmark/benchmark.h>

#include "palpate/batch/derived_series.h"
#include "palpate/recording/mcap_recording.h"
#include "palpate/recording/recording.h"

#include "benchmarks/hour_recording.h"
#include "testing/testing.h"

namespace {

using palpate::McapCompression;
using palpate::Profile;
using palpate::benchmarks::hourOfFrames;
using palpate::benchmarks::setTaxelBytes;

void writeMcapWith(benchmark::State& state, McapCompression compression, bool withSignals) {
  const Profile profile = hourOfFrames();
  const palpate::testing::TemporaryFolder folder;
  for ([[maybe_unused]] auto _ : state) {
    palpate::ExportExtras extras;
    extras.series =
        palpate::derivedSeries(profile, {.withSignals = withSignals, .withSlip = false});
    palpate::McapWriteOptions options;
    options.compression = compression;
    palpate::writeMcap(
        {profile, {}, {}, extras}, folder / "a.mcap", palpate::Overwrite::kReplace, {}, options);
  }
  setTaxelBytes(state, profile);
}

void mcapZstd(benchmark::State& state) { writeMcapWith(state, McapCompression::kZstd, false); }
void mcapLz4(benchmark::State& state) { writeMcapWith(state, McapCompression::kLz4, false); }
void mcapNone(benchmark::State& state) { writeMcapWith(state, McapCompression::kNone, false); }
void mcapWithSignals(benchmark::State& state) {
  writeMcapWith(state, McapCompression::kZstd, true);
}

// Opened, which reads all of it, and each frame read.
void mcapRead(benchmark::State& state) {
  const Profile profile = hourOfFrames();
  const palpate::testing::TemporaryFolder folder;
  palpate::writeMcap({profile, {}, {}, palpate::ExportExtras{}}, folder / "a.mcap");
  palpate::TactileFrame frame;
  for ([[maybe_unused]] auto _ : state) {
    const Profile read = palpate::openRecording(folder / "a.mcap");
    for (std::size_t i = 0; i < read.numFrames(); ++i) read.readFrame(i, frame);
  }
  setTaxelBytes(state, profile);
}

// The reference.
void mcapPlainRead(benchmark::State& state) {
  const Profile profile = hourOfFrames();
  palpate::TactileFrame frame;
  for ([[maybe_unused]] auto _ : state)
    for (std::size_t i = 0; i < profile.numFrames(); ++i) {
      profile.readFrame(i, frame);
      benchmark::DoNotOptimize(frame.values.data());
    }
  setTaxelBytes(state, profile);
}

BENCHMARK(mcapPlainRead)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mcapNone)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mcapLz4)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mcapZstd)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mcapWithSignals)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mcapRead)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
