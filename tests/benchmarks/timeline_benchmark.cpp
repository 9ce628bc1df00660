// The timeline of a recording of 24 hours (PALPATE_BENCHMARK_DAY=1, PALPATE_BENCHMARK_DAY_FILE or
// one made by the benchmarks called day..): from the file to its curves on screen (target 3 s), any
// zoom (target 100 ms), and how long it takes until everything is read. The reference in the same
// run: drawing the same number of samples without thinning them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <palpate/recording/recording.h>

#include "growth_bench.h"
#include "gui/timeline/timeline_chart.h"
#include "testing/testing.h"
#include "window_bench.h"

namespace {
namespace fs = std::filesystem;
using namespace palpate;
using namespace palpate::gui;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<PlottedCurve> allMatrices(const OpenedRecording& recording) {
  std::vector<PlottedCurve> curves;
  for (std::size_t m = 0; m < recording.numMatrices(); ++m)
    curves.push_back(matrixCurve(recording.profile.hand(), m, SignalKind::kMean));
  return curves;
}

void timelineOfADay(benchmark::State& state) {
  const char* wanted = std::getenv("PALPATE_BENCHMARK_DAY");
  const char* given = std::getenv("PALPATE_BENCHMARK_DAY_FILE");
  const fs::path file = given ? fs::path(given) : fs::temp_directory_path() / "palpate-day.palpate";
  if (!wanted || std::string(wanted) != "1" || !fs::exists(file))
    return state.SkipWithError("opt-in: PALPATE_BENCHMARK_DAY=1, with --benchmark_filter=day");
  palpate::testing::windowApplication();
  for (auto _ : state) {
    const auto begin = Clock::now();
    const auto recording = makeOpenedRecording(file, openRecording(file));
    TimelineChart chart;
    chart.resize(1600, 260);
    chart.setRecording(recording);
    chart.setCurves(allMatrices(*recording));
    chart.show();
    chart.store().waitForFirstLook();
    chart.replot(QCustomPlot::rpImmediateRefresh);
    state.counters["drawn_s"] = secondsSince(begin);

    // Zooms anywhere, while the rest is still being read.
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<double> zooms;
    for (int i = 0; i < 300; ++i) {
      const double span = recording->durationS() * std::pow(10.0, -5.0 * unit(random));
      const double from = (recording->durationS() - span) * unit(random);
      const auto asked = Clock::now();
      chart.setVisibleRange(from, from + span);
      chart.replot(QCustomPlot::rpImmediateRefresh);
      zooms.push_back(secondsSince(asked) * 1e3);
    }
    std::sort(zooms.begin(), zooms.end());
    state.counters["zoom_p50_ms"] = zooms[zooms.size() / 2];
    state.counters["zoom_max_ms"] = zooms.back();
    chart.store().waitUntilRead();
    state.counters["all_read_s"] = secondsSince(begin);

    // Zoomed in, until every sample of what is seen is there.
    std::vector<double> exact;
    for (int i = 0; i < 50; ++i) {
      const double from = recording->durationS() * 0.99 * unit(random);
      const auto asked = Clock::now();
      chart.setVisibleRange(from, from + 120.0);
      chart.store().waitUntilRead();
      chart.replot(QCustomPlot::rpImmediateRefresh);
      exact.push_back(secondsSince(asked) * 1e3);
    }
    std::sort(exact.begin(), exact.end());
    state.counters["two_minutes_exact_p50_ms"] = exact[exact.size() / 2];
    state.counters["two_minutes_exact_max_ms"] = exact.back();
    state.SetIterationTime(state.counters["drawn_s"]);
  }
}
// From the file to its curves, and until every frame is read; by the number of frames
// (docs/notes/growth.md).
void growthTimeline(benchmark::State& state) {
  const palpate::testing::TemporaryFolder folder;
  const fs::path file = folder / "long.palpate";
  palpate::testing::writeRecordingOf(static_cast<int>(state.range(0)), file);
  palpate::testing::windowApplication();
  const palpate::testing::PeakRise rise;
  for (auto _ : state) {
    const auto recording = makeOpenedRecording(file, openRecording(file));
    TimelineChart chart;
    chart.resize(1600, 260);
    chart.setRecording(recording);
    chart.setCurves(allMatrices(*recording));
    chart.show();
    chart.store().waitUntilRead();
    chart.replot(QCustomPlot::rpImmediateRefresh);
  }
  state.counters["peak_MB"] = rise.take();
}
BENCHMARK(growthTimeline)
    ->RangeMultiplier(10)
    ->Range(100, 1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK(timelineOfADay)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);

// What it would cost to hand a chart every frame of a day.
void chartWithoutThinning(benchmark::State& state) {
  palpate::testing::windowApplication();
  QCustomPlot chart;
  chart.resize(1600, 260);
  QCPGraph* graph = chart.addGraph();
  graph->setAdaptiveSampling(false);
  QVector<QCPGraphData> samples;
  for (int i = 0; i < 2'600'000; ++i) samples.append({i / 30.0, static_cast<double>(i % 1000)});
  graph->data()->set(samples, true);
  chart.rescaleAxes();
  chart.show();
  for (auto _ : state) chart.replot(QCustomPlot::rpImmediateRefresh);
}
BENCHMARK(chartWithoutThinning)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
