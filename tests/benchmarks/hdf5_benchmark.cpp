// Recordings to HDF5 (target: 100 MB of taxels per second, two bytes per taxel, in 300 MB of
// memory): a synthetic recording of an hour in a .palpate, alone, with its signals, and with
// signals and slip; beside it the same taxels written to a file as they are.
#include <fstream>
#include <vector>

#include <benchmark/benchmark.h>

#include "palpate/batch/derived_series.h"
#include "palpate/recording/hdf5_recording.h"
#include "palpate/recording/recording.h"

#include "benchmarks/hour_recording.h"
#include "testing/testing.h"

namespace {

using palpate::Profile;
using palpate::benchmarks::hourOfFrames;
using palpate::benchmarks::setTaxelBytes;

void writeHdf5With(benchmark::State& state, bool withSignals, bool withSlip) {
  const Profile profile = hourOfFrames();
  const palpate::testing::TemporaryFolder folder;
  for ([[maybe_unused]] auto _ : state) {
    palpate::ExportExtras extras;
    extras.series =
        palpate::derivedSeries(profile, {.withSignals = withSignals, .withSlip = withSlip});
    palpate::writeHdf5({profile, {}, {}, extras}, folder / "a.h5", palpate::Overwrite::kReplace);
  }
  setTaxelBytes(state, profile);
}

void hdf5Alone(benchmark::State& state) { writeHdf5With(state, false, false); }
void hdf5WithSignals(benchmark::State& state) { writeHdf5With(state, true, false); }
void hdf5WithSignalsAndSlip(benchmark::State& state) { writeHdf5With(state, true, true); }

// The reference: frames read, converted to counts, and written as they are.
void hdf5PlainWrite(benchmark::State& state) {
  const Profile profile = hourOfFrames();
  const palpate::testing::TemporaryFolder folder;
  for ([[maybe_unused]] auto _ : state) {
    std::ofstream out(folder / "a.raw", std::ios::binary);
    palpate::TactileFrame frame;
    std::vector<std::uint16_t> counts(profile.layout().numCells());
    for (std::size_t i = 0; i < profile.numFrames(); ++i) {
      profile.readFrame(i, frame);
      for (std::size_t k = 0; k < counts.size(); ++k)
        counts[k] = static_cast<std::uint16_t>(frame.values[k]);
      out.write(reinterpret_cast<const char*>(counts.data()),
                static_cast<std::streamsize>(counts.size() * 2));
    }
  }
  setTaxelBytes(state, profile);
}

BENCHMARK(hdf5PlainWrite)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hdf5Alone)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hdf5WithSignals)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hdf5WithSignalsAndSlip)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
