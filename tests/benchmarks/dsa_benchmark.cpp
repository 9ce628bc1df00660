// Reading .dsa recordings beside decompressing the same files with `bzip2 -dc`, by wall time, on
// two idle cores. The targets: large files at most 0.7 times `bzip2 -dc` and 1.2 times `lbzip2
// -dc`; all files, by the commands that read folders and by the library's first look, at most 0.65
// times `bzip2 -dc`. Each round runs the reference and the reader one after the other, so a busy
// machine slows both; the counter "ratio" is the median over the rounds of reader / bzip2.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <bzlib.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/library/recording_catalog.h"
#include "palpate/recording/dsa_reader.h"

#include "testing/testing.h"

namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

constexpr std::uintmax_t kLargeBytes = 100'000;

enum Files { kAll, kLarge, kSmall, kOneLarge, kOneSmall };

std::vector<std::string> filesOf(Files which) {
  std::vector<std::string> all;
  const auto folder = palpate::testing::recordingsFolder();
  if (!folder) return all;
  if (which == kOneLarge) return {(*folder / "grasps/foam_ball.dsa").string()};
  for (const auto& entry : fs::recursive_directory_iterator(*folder)) {
    if (entry.path().extension() != ".dsa") continue;
    const bool large = entry.file_size() >= kLargeBytes;
    if (which == kAll || large == (which == kLarge)) all.push_back(entry.path().string());
  }
  std::sort(all.begin(), all.end());
  if (which == kOneSmall && !all.empty()) all.resize(1);
  return all;
}

// Runs `PROGRAM -dc FILES`; `output` is where it writes to. Returns its process id, or -1.
pid_t startBzip2(const std::vector<std::string>& files, int output, const char* program = "bzip2") {
  std::vector<char*> arguments = {const_cast<char*>(program), const_cast<char*>("-dc")};
  for (const std::string& file : files) arguments.push_back(const_cast<char*>(file.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  pid_t child = -1;
  if (posix_spawnp(&child, program, &actions, nullptr, arguments.data(), environ) != 0) child = -1;
  posix_spawn_file_actions_destroy(&actions);
  return child;
}

bool endedWell(pid_t child) {
  int status = -1;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
         WEXITSTATUS(status) == 0;
}

// PROGRAM -dc FILES > /dev/null
bool runToNowhere(const std::vector<std::string>& files, const char* program) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const bool well = endedWell(startBzip2(files, nowhere, program));
  close(nowhere);
  return well;
}
bool runBzip2(const std::vector<std::string>& files) { return runToNowhere(files, "bzip2"); }
bool runLbzip2(const std::vector<std::string>& files) { return runToNowhere(files, "lbzip2"); }

// Its output read and thrown away.
bool runBzip2ThroughPipe(const std::vector<std::string>& files) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return false;
  const pid_t child = startBzip2(files, ends[1]);
  close(ends[1]);
  std::array<char, 1u << 16> buffer;
  while (read(ends[0], buffer.data(), buffer.size()) > 0) {
  }
  close(ends[0]);
  return endedWell(child);
}

// libbz2 within this process, one thread.
bool decompressAll(const std::vector<std::string>& files) {
  std::vector<char> out(64u << 10);
  for (const std::string& file : files) {
    const std::string bytes = palpate::testing::readFile(file);
    bz_stream z{};
    if (BZ2_bzDecompressInit(&z, 0, 0) != BZ_OK) return false;
    z.next_in = const_cast<char*>(bytes.data());
    z.avail_in = static_cast<unsigned>(bytes.size());
    int result = BZ_OK;
    while (result == BZ_OK) {
      z.next_out = out.data();
      z.avail_out = static_cast<unsigned>(out.size());
      result = BZ2_bzDecompress(&z);
    }
    BZ2_bzDecompressEnd(&z);
    if (result != BZ_STREAM_END) return false;
  }
  return true;
}

bool readAll(const std::vector<std::string>& files) {
  std::size_t frames = 0;
  for (const std::string& file : files) frames += palpate::readDsa(file).numFrames();
  benchmark::DoNotOptimize(frames);
  return frames > 0;
}

using Work = std::function<bool(const std::vector<std::string>&)>;

// Times `work` on the files; the reference runs before each round, outside the timing.
void timeBesideReference(benchmark::State& state,
                         Files which,
                         const Work& reference,
                         const Work& work) {
  const std::vector<std::string> files = filesOf(which);
  if (files.empty()) return state.SkipWithError("no recordings: set PALPATE_RECORDINGS");
  std::vector<double> ratios;
  double referenceS = 0.0;
  double readerS = 0.0;
  for (auto _ : state) {
    const auto begin = Clock::now();
    if (!reference(files)) return state.SkipWithError("the reference failed");
    const auto middle = Clock::now();
    if (!work(files)) return state.SkipWithError("nothing was read");
    const auto end = Clock::now();
    state.SetIterationTime(seconds(end - middle));
    ratios.push_back(seconds(end - middle) / seconds(middle - begin));
    referenceS += seconds(middle - begin);
    readerS += seconds(end - middle);
  }
  std::sort(ratios.begin(), ratios.end());
  state.counters["ratio"] = ratios[ratios.size() / 2];
  state.counters["reference_ms"] = 1e3 * referenceS / static_cast<double>(ratios.size());
  state.counters["reader_ms"] = 1e3 * readerS / static_cast<double>(ratios.size());
  state.counters["files"] = static_cast<double>(files.size());
}

void readBesideReference(benchmark::State& state, Files which, const Work& reference) {
  timeBesideReference(state, which, reference, &readAll);
}

void readBesideLbzip2(benchmark::State& state) {
  if (!fs::exists("/usr/bin/lbzip2"))
    return state.SkipWithError("lbzip2 isn't installed (Debian package lbzip2)");
  readBesideReference(state, kLarge, &runLbzip2);
}

// The library's first look at the folder, without a cache.
bool lookAtAll(const std::vector<std::string>& files) {
  return palpate::catalogRecordings(*palpate::testing::recordingsFolder(), {}, {}).numRead >=
         files.size();
}

void libraryBesideBzip2(benchmark::State& state) {
  timeBesideReference(state, kAll, &runBzip2, &lookAtAll);
}

#ifdef PALPATE_PROGRAM
// `palpate COMMAND FOLDER > /dev/null`, of the folder with all files, as a process.
void folderBesideBzip2(benchmark::State& state, const std::string& command) {
  const palpate::testing::TemporaryFolder folder;
  std::string line = std::string(PALPATE_PROGRAM) + " " + command + " -q \"$PALPATE_RECORDINGS\"";
  if (command == "train") line += " --force -o " + (folder / "model.json").string();
  line += " > /dev/null 2>&1";
  const auto run = [&](const std::vector<std::string>&) {
    const int status = std::system(line.c_str());
    // 3: some of the recordings have no grasp.
    return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 3);
  };
  timeBesideReference(state, kAll, &runBzip2, run);
}

#define PALPATE_FOLDER_BENCHMARK(command)                 \
  BENCHMARK_CAPTURE(folderBesideBzip2, command, #command) \
      ->UseManualTime()                                   \
      ->Unit(benchmark::kMillisecond)                     \
      ->Iterations(15)
PALPATE_FOLDER_BENCHMARK(info);
PALPATE_FOLDER_BENCHMARK(verify);
// Not by the macro: Qt defines `signals` as another word.
BENCHMARK_CAPTURE(folderBesideBzip2, signals_command, "signals")
    ->Iterations(15)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
PALPATE_FOLDER_BENCHMARK(grasps);
PALPATE_FOLDER_BENCHMARK(features);
// Reads the folder, and then chooses and trains a model.
BENCHMARK_CAPTURE(folderBesideBzip2, train, "train")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);
#endif

#define PALPATE_DSA_BENCHMARK(name, which, reference)            \
  BENCHMARK_CAPTURE(readBesideReference, name, which, reference) \
      ->UseManualTime()                                          \
      ->Unit(benchmark::kMillisecond)                            \
      ->Iterations(15)

PALPATE_DSA_BENCHMARK(all_vs_bzip2, kAll, runBzip2);
PALPATE_DSA_BENCHMARK(large_vs_bzip2, kLarge, runBzip2);
PALPATE_DSA_BENCHMARK(small_vs_bzip2, kSmall, runBzip2);
PALPATE_DSA_BENCHMARK(one_large_vs_bzip2, kOneLarge, runBzip2);
PALPATE_DSA_BENCHMARK(one_small_vs_bzip2, kOneSmall, runBzip2);
PALPATE_DSA_BENCHMARK(all_vs_bzip2_through_a_pipe, kAll, runBzip2ThroughPipe);
PALPATE_DSA_BENCHMARK(all_vs_libbz2_in_process, kAll, decompressAll);
PALPATE_DSA_BENCHMARK(large_vs_libbz2_in_process, kLarge, decompressAll);
BENCHMARK(readBesideLbzip2)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(15);
BENCHMARK(libraryBesideBzip2)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(15);

}  // namespace
