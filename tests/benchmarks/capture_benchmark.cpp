// What capture and recording cost: frames at 31.7 and 300 frames/s with angles at 110 Hz and
// temperatures at 1 Hz, through session, queue and recorder onto the disk, as share of one core
// (target: under 3 % at 31.7 frames/s). The recorder is moved by a clock of the benchmark, in its
// own rounds of 80 ms; the disk is the real one. Reference in the same run: the same frames and
// angles written plainly, and synced as often as the recorder commits. With a load cell at 1 kHz
// and an IMU at 200 Hz beside the hand (target: under 5 %) the reference is the hand alone.
#include <cstdio>
#include <vector>

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include "palpate/device/sdh2.h"

#include "capture/scripted_device.h"
#include "testing/testing.h"

namespace {
using namespace palpate;
using namespace palpate::testing;

constexpr double kRecordedS = 60.0;
constexpr double kAnglesHz = 110.0;
constexpr std::int64_t kRoundUs = 80'000;
constexpr std::int64_t kCellUs = 1'000;
constexpr std::int64_t kImuUs = 5'000;

// CPU time of this process [s], disk included, waiting for it not.
double cpuS() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

// Real frames have active taxels in patches; most places are 0.
TactileFrame graspFrame(std::size_t n) {
  TactileFrame frame(sdh2().layout);
  for (std::size_t k = 0; k < 60; ++k)
    frame.values[100 + k] = static_cast<float>((n * 31 + k * 97) % 1500);
  return frame;
}

// Calls `frame`, `angles` and `round` when they are due.
template <typename Frame, typename Angles, typename Round>
void playTime(double rateHz, const Frame& frame, const Angles& angles, const Round& round) {
  const auto frameUs = static_cast<std::int64_t>(1e6 / rateHz);
  const auto angleUs = static_cast<std::int64_t>(1e6 / kAnglesHz);
  std::int64_t nextFrameUs = frameUs;
  std::int64_t nextAngleUs = angleUs;
  const auto endUs = static_cast<std::int64_t>(kRecordedS * 1e6);
  for (std::int64_t now = kRoundUs; now <= endUs; now += kRoundUs) {
    for (; nextFrameUs <= now; nextFrameUs += frameUs) frame(nextFrameUs);
    for (; nextAngleUs <= now; nextAngleUs += angleUs) angles(nextAngleUs);
    round(now);
  }
}

const std::vector<SeriesDescription> kCellAndImu{{"cell", "", {{"f", "N"}}, ""},
                                                 {"imu",
                                                  "",
                                                  {{"ax", "m/s^2"},
                                                   {"ay", "m/s^2"},
                                                   {"az", "m/s^2"},
                                                   {"gx", "rad/s"},
                                                   {"gy", "rad/s"},
                                                   {"gz", "rad/s"}},
                                                  ""}};

// The samples of both in the round that ends at `nowUs`; returns how many.
std::int64_t addSeries(DeviceSink& sink, std::int64_t nowUs) {
  const auto add = [&](std::size_t series, std::int64_t atUs, std::size_t columns) {
    sink.onSample({kWallStartUs + atUs,
                   std::vector<double>(columns, 0.1 * static_cast<double>(atUs % 977)),
                   series,
                   atUs});
  };
  std::int64_t count = 0;
  for (std::int64_t at = nowUs - kRoundUs + kCellUs; at <= nowUs; at += kCellUs, ++count)
    add(kHandSeries, at, 1);
  for (std::int64_t at = nowUs - kRoundUs + kImuUs; at <= nowUs; at += kImuUs, ++count)
    add(kHandSeries + 1, at, 6);
  return count;
}

double recordedCpuS(double rateHz,
                    const std::vector<TactileFrame>& frames,
                    const std::vector<SeriesDescription>& series = {}) {
  const TemporaryFolder folder;
  ScriptedSession scripted({}, series);
  RecordingOptions options;
  options.path = folder / "a.palpate";
  scripted.session->startRecording(options);
  DeviceSink& sink = *scripted.device->sink;
  std::size_t n = 0;
  std::int64_t samples = 0;  // of the series beside the hand
  const double begin = cpuS();
  playTime(
      rateHz,
      [&](std::int64_t atUs) {
        TactileFrame frame = frames[n++ % frames.size()];
        frame.hostUs = kWallStartUs + atUs;
        sink.onFrame(std::move(frame));
      },
      [&](std::int64_t atUs) {
        sink.onSample({kWallStartUs + atUs, std::vector<double>(7, 0.1 * static_cast<double>(n))});
      },
      [&](std::int64_t nowUs) {
        scripted.clock.pass(kRoundUs);
        if (nowUs % 960'000 == 0)
          sink.onSample({kWallStartUs + nowUs, std::vector<double>(9, 33.5), kTemperatureSeries});
        if (!series.empty()) samples += addSeries(sink, nowUs);
        scripted.session->step();
      });
  const RecordingReport report = scripted.session->stopRecording();
  const double used = cpuS() - begin;
  for (const auto& each : report.series) samples -= each.samples;
  const bool isWhole =
      report.complete && report.frames == static_cast<std::int64_t>(n) && samples == 0;
  return isWhole ? used : -1.0;
}

double plainCpuS(double rateHz, const std::vector<TactileFrame>& frames) {
  const TemporaryFolder folder;
  std::FILE* file = std::fopen((folder / "a").c_str(), "wb");
  std::size_t n = 0;
  std::int64_t syncedUs = 0;
  const double begin = cpuS();
  playTime(
      rateHz,
      [&](std::int64_t) {
        const TactileFrame frame = frames[n++ % frames.size()];
        std::fwrite(frame.values.data(), sizeof(float), frame.values.size(), file);
      },
      [&](std::int64_t) {
        const std::vector<double> deg(7, 0.1 * static_cast<double>(n));
        std::fwrite(deg.data(), sizeof(double), deg.size(), file);
      },
      [&](std::int64_t nowUs) {
        if (nowUs - syncedUs < kRoundUs) return;
        syncedUs = nowUs;
        std::fflush(file);
        ::fdatasync(::fileno(file));
      });
  const double used = cpuS() - begin;
  std::fclose(file);
  return used;
}

void captureAndRecord(benchmark::State& state) {
  const double rateHz = static_cast<double>(state.range(0)) / 10.0;
  std::vector<TactileFrame> frames;
  for (std::size_t n = 0; n < 256; ++n) frames.push_back(graspFrame(n));
  double used = 0.0;
  double plain = 0.0;
  for (auto _ : state) {
    const double seconds = recordedCpuS(rateHz, frames);
    if (seconds < 0.0) return state.SkipWithError("not everything was recorded");
    plain += plainCpuS(rateHz, frames);
    used += seconds;
    state.SetIterationTime(seconds);
  }
  const double spanS = kRecordedS * static_cast<double>(state.iterations());
  state.counters["percent_of_a_core"] = 100.0 * used / spanS;
  state.counters["plain_write_percent"] = 100.0 * plain / spanS;
  state.counters["us_per_frame"] = 1e6 * used / spanS / rateHz;
}
BENCHMARK(captureAndRecord)
    ->Arg(317)
    ->Arg(3000)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

void captureWithSeries(benchmark::State& state) {
  constexpr double kRateHz = 31.7;
  std::vector<TactileFrame> frames;
  for (std::size_t n = 0; n < 256; ++n) frames.push_back(graspFrame(n));
  double used = 0.0;
  double alone = 0.0;
  for (auto _ : state) {
    const double seconds = recordedCpuS(kRateHz, frames, kCellAndImu);
    const double hand = recordedCpuS(kRateHz, frames);
    if (seconds < 0.0 || hand < 0.0) return state.SkipWithError("not everything was recorded");
    used += seconds;
    alone += hand;
    state.SetIterationTime(seconds);
  }
  const double spanS = kRecordedS * static_cast<double>(state.iterations());
  state.counters["percent_of_a_core"] = 100.0 * used / spanS;
  state.counters["hand_alone_percent"] = 100.0 * alone / spanS;
  state.counters["us_per_sample"] = 1e6 * (used - alone) / spanS / 1200.0;
}
BENCHMARK(captureWithSeries)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);

// From the device's thread into queue, mailbox and meter: what a port's thread pays for a frame.
void handOver(benchmark::State& state) {
  ScriptedSession scripted;
  DeviceSink& sink = *scripted.device->sink;
  const TactileFrame frame = graspFrame(1);
  std::int64_t at = kWallStartUs;
  for (auto _ : state) {
    TactileFrame copy = frame;
    copy.hostUs = ++at;
    sink.onFrame(std::move(copy));
    if (at % 4096 == 0) {
      state.PauseTiming();
      scripted.session->step();
      state.ResumeTiming();
    }
  }
}
BENCHMARK(handOver);

void handOverReference(benchmark::State& state) {
  const TactileFrame frame = graspFrame(1);
  for (auto _ : state) {
    TactileFrame copy = frame;
    benchmark::DoNotOptimize(copy);
  }
}
BENCHMARK(handOverReference);

}  // namespace
