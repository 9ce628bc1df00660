// Native recordings. Loading all frames, angles and temperatures of the shared recordings beside
// loading the same from .dsa, in the same round (target: ten times faster); and, with
// PALPATE_BENCHMARK_DAY=1, a recording of 24 hours, made once in the temporary folder (about 1.5
// GB): opening it under 2 s, any frame under 20 ms, its per-second summary under 100 ms, under 500
// MB; and exports of it (target: 100 MB of taxels per second in 300 MB of memory).
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/batch/derived_series.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/second_summary.h"

#include "testing/testing.h"

namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using palpate::Profile;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

// Every value of every stream.
double loadAll(const fs::path& path) {
  const Profile profile = palpate::openRecording(path);
  double sum = 0.0;
  palpate::TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    sum += static_cast<double>(frame.values[i % frame.values.size()]);
  }
  for (std::size_t i = 0; i < profile.numAngles(); ++i) sum += profile.angles(i).values[0];
  for (std::size_t i = 0; i < profile.numTemperatures(); ++i)
    sum += profile.temperatures(i).values[0];
  return sum;
}

void loadAllBesideDsa(benchmark::State& state) {
  const auto folder = palpate::testing::recordingsFolder();
  if (!folder) return state.SkipWithError("no recordings: set PALPATE_RECORDINGS");
  const palpate::testing::TemporaryFolder converted;
  std::vector<std::pair<fs::path, fs::path>> files;
  for (const auto& entry : fs::recursive_directory_iterator(*folder)) {
    if (entry.path().extension() != ".dsa") continue;
    files.emplace_back(entry.path(), converted / (std::to_string(files.size()) + ".palpate"));
    palpate::saveRecording(palpate::openRecording(entry.path()), {}, files.back().second);
  }
  std::vector<double> ratios;
  for (auto _ : state) {
    const auto begin = Clock::now();
    double dsa = 0.0;
    for (const auto& [from, to] : files) dsa += loadAll(from);
    const auto middle = Clock::now();
    double native = 0.0;
    for (const auto& [from, to] : files) native += loadAll(to);
    const auto end = Clock::now();
    if (dsa != native) return state.SkipWithError("the values differ");
    state.SetIterationTime(seconds(end - middle));
    ratios.push_back(seconds(middle - begin) / seconds(end - middle));
  }
  std::sort(ratios.begin(), ratios.end());
  state.counters["times_faster"] = ratios[ratios.size() / 2];
  state.counters["files"] = static_cast<double>(files.size());
}
BENCHMARK(loadAllBesideDsa)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(2.0);

constexpr int kDayFrames = 2'600'000;
constexpr int kDayAngles = 9'500'000;

// Frames of a hand that holds something now and then, in the blocks of a commit every 100 ms.
void makeDay(const fs::path& path) {
  palpate::PalpateWriterOptions options;
  options.synced = false;
  const auto& hand = palpate::sdh2();
  palpate::PalpateWriter writer(path, hand.layout, {}, options);
  palpate::TactileFrame frame(hand.layout);
  palpate::Sample angles{0, std::vector<double>(7)};
  palpate::Sample temperatures{0, std::vector<double>(9, 30.0), palpate::kTemperatureSeries};
  std::mt19937 random(1);
  constexpr std::int64_t kStartUs = 1'400'000'000'000'000;
  int nextAngles = 0;
  int nextSecond = 0;
  for (int i = 0; i < kDayFrames; ++i) {
    frame.hostUs = kStartUs + i * 86'400'000'000LL / kDayFrames;
    std::fill(frame.values.begin(), frame.values.end(), 0.0F);
    if (i % 1000 < 600)
      for (int k = 0; k < 60; ++k)
        frame.values[static_cast<std::size_t>(k * 8 + k % 3)] = static_cast<float>(random() % 2000);
    for (; nextAngles * 86'400'000'000LL / kDayAngles + kStartUs <= frame.hostUs; ++nextAngles) {
      angles.hostUs = nextAngles * 86'400'000'000LL / kDayAngles + kStartUs;
      for (double& deg : angles.values) deg = static_cast<double>(random() % 900) / 10.0;
      writer.addSample(angles);
    }
    for (; nextSecond * 1'000'000LL + kStartUs <= frame.hostUs; ++nextSecond) {
      temperatures.hostUs = nextSecond * 1'000'000LL + kStartUs;
      writer.addSample(temperatures);
    }
    writer.addFrame(frame);
  }
  writer.finish();
}

// Made by another process, so that its memory doesn't count.
const fs::path& day() {
  static const fs::path path = [] {
    const char* given = std::getenv("PALPATE_BENCHMARK_DAY_FILE");
    fs::path file = given ? fs::path(given) : fs::temp_directory_path() / "palpate-day.palpate";
    if (!fs::exists(file)) {
      const pid_t child = fork();
      if (child == 0) {
        makeDay(file);
        _exit(0);
      }
      int status = 0;
      waitpid(child, &status, 0);
    }
    return file;
  }();
  return path;
}

bool dayWanted(benchmark::State& state) {
  const char* wanted = std::getenv("PALPATE_BENCHMARK_DAY");
  if (wanted && std::string(wanted) == "1") return true;
  state.SkipWithError("opt-in: set PALPATE_BENCHMARK_DAY=1");
  return false;
}

// Throws the file out of the page cache.
void forget(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  fsync(file);
  posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
  close(file);
}

double peakMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// The highest memory of this process since the last call [MB].
double takePeakMb() {
  std::ifstream status("/proc/self/status");
  std::string line;
  double peak = peakMb();
  while (std::getline(status, line))
    if (line.starts_with("VmHWM:")) peak = std::stod(line.substr(6)) / 1024.0;
  std::ofstream("/proc/self/clear_refs") << "5";
  return peak;
}

void dayOpens(benchmark::State& state) {
  if (!dayWanted(state)) return;
  day();
  takePeakMb();
  const double before = takePeakMb();
  for (auto _ : state) {
    forget(day());
    const auto begin = Clock::now();
    const Profile profile = palpate::openRecording(day());
    benchmark::DoNotOptimize(profile.frame(profile.numFrames() - 1));
    state.SetIterationTime(seconds(Clock::now() - begin));
  }
  state.counters["peak_MB"] = takePeakMb() - before;
  state.counters["file_MB"] = static_cast<double>(fs::file_size(day())) / 1e6;
}
BENCHMARK(dayOpens)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3);

void dayRandomFrame(benchmark::State& state) {
  if (!dayWanted(state)) return;
  const Profile profile = palpate::openRecording(day());
  forget(day());
  std::mt19937 random(2);
  palpate::TactileFrame frame;
  double slowest = 0.0;
  for (auto _ : state) {
    const auto begin = Clock::now();
    profile.readFrame(random() % profile.numFrames(), frame);
    const double took = seconds(Clock::now() - begin);
    slowest = std::max(slowest, took);
    state.SetIterationTime(took);
  }
  state.counters["slowest_ms"] = 1e3 * slowest;
  state.counters["peak_MB"] = peakMb();
}
BENCHMARK(dayRandomFrame)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(2000);

void daySeconds(benchmark::State& state) {
  if (!dayWanted(state)) return;
  std::size_t rows = 0;
  for (auto _ : state) {
    forget(day());
    const auto begin = Clock::now();
    rows = palpate::readSeconds(day()).size();
    state.SetIterationTime(seconds(Clock::now() - begin));
  }
  state.counters["rows"] = static_cast<double>(rows);
}
BENCHMARK(daySeconds)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);

// The 24 hours to another form by another process, so that its memory is its own: two bytes per
// taxel and second of wall time.
void dayExport(benchmark::State& state, const std::string& ending, bool withSlip) {
  if (!dayWanted(state)) return;
  day();
  const palpate::testing::TemporaryFolder folder;
  const fs::path out = folder / ("day." + ending);
  double peak = 0.0;
  for (auto _ : state) {
    const auto begin = Clock::now();
    const pid_t child = fork();
    if (child == 0) {
      try {
        const Profile profile = palpate::openRecording(day());
        if (ending == "raw") {
          std::ofstream raw(out, std::ios::binary);
          std::vector<std::uint16_t> counts(profile.layout().numCells());
          palpate::TactileFrame frame;
          for (std::size_t i = 0; i < profile.numFrames(); ++i) {
            profile.readFrame(i, frame);
            std::transform(frame.values.begin(), frame.values.end(), counts.begin(), [](float v) {
              return static_cast<std::uint16_t>(v);
            });
            raw.write(reinterpret_cast<const char*>(counts.data()),
                      static_cast<std::streamsize>(counts.size() * sizeof counts[0]));
          }
        } else {
          palpate::SaveExtras extras;
          if (withSlip)
            extras.exported.series =
                palpate::derivedSeries(profile, {.withSignals = true, .withSlip = true});
          palpate::saveRecording(profile, {}, out, palpate::Overwrite::kReplace, {}, extras);
        }
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        _exit(1);
      }
      _exit(0);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    if (status != 0) return state.SkipWithError("the export failed");
    peak = static_cast<double>(usage.ru_maxrss) / 1024.0;
    state.SetIterationTime(seconds(Clock::now() - begin));
  }
  const Profile profile = palpate::openRecording(day());
  state.SetBytesProcessed(
      static_cast<std::int64_t>(profile.numFrames() * profile.layout().numCells() * 2));
  state.counters["peak_MB"] = peak;
  state.counters["file_MB"] = static_cast<double>(fs::file_size(out)) / 1e6;
}
#define PALPATE_DAY_EXPORT(name, ending, withSlip)                  \
  BENCHMARK_CAPTURE(dayExport, name, std::string(ending), withSlip) \
      ->UseManualTime()                                             \
      ->Unit(benchmark::kSecond)                                    \
      ->Iterations(1)
// The reference: frames read, and written as counts.
PALPATE_DAY_EXPORT(raw, "raw", false);
PALPATE_DAY_EXPORT(h5, "h5", false);
PALPATE_DAY_EXPORT(h5_signals_slip, "h5", true);
PALPATE_DAY_EXPORT(mcap, "mcap", false);
PALPATE_DAY_EXPORT(csv, "csv", false);

}  // namespace
