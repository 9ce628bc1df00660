// The window: how soon it is painted, and what playback costs. Run it where a display is, e.g.
// under `xvfb-run -a`; without one it uses Qt's offscreen platform.
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/dsa_writer.h"

#include "benchmarks/window_bench.h"
#include "gui/matrices/matrices_view.h"
#include "gui/shell/main_window.h"
#include "testing/background_program.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace {
namespace fs = std::filesystem;
namespace gui = palpate::gui;
using palpate::testing::processSeconds;
using palpate::testing::usePlatform;
using palpate::testing::windowApplication;

// A real recording where there is one, else the demonstration.
fs::path recording() {
  const auto folder = palpate::testing::recordingsFolder();
  return folder ? *folder / "grasps/foam_ball.dsa"
                : palpate::testing::dataFolder() / "demo_grasps.dsa";
}

// From the start of the process to the saved picture of the window with a recording open: an upper
// bound of the time to the first paint. Target of the first paint: 1 s.
void processToPicture(benchmark::State& state) {
  usePlatform();
  const palpate::testing::TemporaryFolder folder;
  const std::string out = folder / "window.png";
  for (auto _ : state) {
    const auto result = palpate::testing::runProgram(
        PALPATE_PROGRAM, {"--screenshot", out, "--force", recording().string()});
    if (result.exitCode != 0) return state.SkipWithError(result.err.c_str());
  }
}

// The reference: the same process without window and recording.
void processToVersion(benchmark::State& state) {
  for (auto _ : state)
    if (palpate::testing::runProgram(PALPATE_PROGRAM, {"--version"}).exitCode != 0)
      return state.SkipWithError("failed");
}

// From the start of the process to the first paint of the window on its start page, as the program
// itself says it (category palpate.startup; to 10 ms). Counter: the median [ms]; target: 200.
void processToFirstPaint(benchmark::State& state) {
  usePlatform();
  const palpate::testing::TemporaryFolder home;
  std::string line;
  for (const char* variable : {"HOME",
                               "XDG_CONFIG_HOME",
                               "XDG_DATA_HOME",
                               "XDG_STATE_HOME",
                               "XDG_CACHE_HOME",
                               "XDG_RUNTIME_DIR"})
    line += std::string(variable) + "='" + home.path().string() + "' ";
  line += "QT_LOGGING_RULES=palpate.startup.debug=true exec '" + std::string(PALPATE_PROGRAM) +
          "' --no-gl 2>&1";
  std::vector<double> timesMs;
  for (auto _ : state) {
    palpate::testing::BackgroundProgram program("/bin/sh", {"-c", line});
    const std::string key = "first paint ";
    const auto said = program.awaitLine(key);
    if (!said) return state.SkipWithError("the window isn't painted");
    timesMs.push_back(std::stod(said->substr(said->find(key) + key.size())));
    state.SetIterationTime(1e-3 * timesMs.back());
    program.signal(SIGTERM);
    program.wait();
  }
  std::sort(timesMs.begin(), timesMs.end());
  state.counters["first_paint_ms"] = timesMs[timesMs.size() / 2];
}

// A command that reads a recording of next to nothing.
void processToInfo(benchmark::State& state) {
  const palpate::testing::TemporaryFolder folder;
  const fs::path path = folder / "two.dsa";
  palpate::writeDsa(palpate::synthesize({.durationS = 0.1, .rateHz = 10.0, .grasps = 0}), path);
  for (auto _ : state)
    if (palpate::testing::runProgram(PALPATE_PROGRAM, {"info", path.string()}).exitCode != 0)
      return state.SkipWithError("failed");
}

// Counts the paint events of a widget.
class PaintCounter : public QObject {
 public:
  explicit PaintCounter(QObject* watched) { watched->installEventFilter(this); }
  int count = 0;

 protected:
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    if (event->type() == QEvent::Paint) ++count;
    return false;
  }
};

void wait(int ms) {
  QEventLoop loop;
  QTimer::singleShot(ms, Qt::PreciseTimer, &loop, &QEventLoop::quit);
  loop.exec();
}

enum class Work { kPlay, kRepaintAll, kNothing };

// A grasp that is held for 24 s, with noise, at 62.5 frames/s: every refresh of 60 a second shows a
// frame that differs from the one before.
fs::path busyRecording(const fs::path& folder) {
  const fs::path path = folder / "busy.dsa";
  palpate::writeDsa(
      palpate::synthesize(
          {.durationS = 40.0, .rateHz = 62.5, .grasps = 1, .peakCounts = 1800, .noiseCounts = 8.0}),
      path);
  return path;
}
constexpr double kHeldFromS = 9.0;

// 20 s of a window of 1600 x 1000. Counters: CPU time of the process as percent of one core (target
// while playing: 15), paint events of the heat maps per second. The reference repaints all widgets.
void window(benchmark::State& state, Work work) {
  windowApplication();
  const QTemporaryDir settings;
  gui::MainWindow window({.dataFolder = palpate::testing::dataFolder(),
                          .settingsPath = settings.filePath("palpate.ini"),
                          .clock = nullptr,
                          .read = {}});
  window.resize(1600, 1000);
  window.show();
  const palpate::testing::TemporaryFolder folder;
  window.state().open({busyRecording(folder.path())});
  QEventLoop opened;
  QObject::connect(
      &window.state().opener, &gui::RecordingOpener::finished, &opened, &QEventLoop::quit);
  opened.exec();
  wait(500);
  window.state().playback.seekSeconds(kHeldFromS);
  auto* view = window.findChild<gui::MatricesView*>();
  if (!view) return state.SkipWithError("no heat maps");
  PaintCounter paints(view);
  constexpr int kMs = 20'000;
  QTimer everything;
  QObject::connect(&everything, &QTimer::timeout, &window, [&] {
    for (QWidget* widget : window.findChildren<QWidget*>()) widget->update();
  });
  for (auto _ : state) {
    paints.count = 0;
    QElapsedTimer wall;
    wall.start();
    const double before = processSeconds();
    if (work == Work::kPlay) window.state().playback.play();
    if (work == Work::kRepaintAll) everything.start(16);
    wait(kMs);
    everything.stop();
    window.state().playback.pause();
    const double seconds = 1e-3 * static_cast<double>(wall.elapsed());
    state.SetIterationTime(seconds);
    state.counters["cpu_percent"] = 100.0 * (processSeconds() - before) / seconds;
    state.counters["repaints_per_s"] = paints.count / seconds;
  }
}

BENCHMARK(processToPicture)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(processToFirstPaint)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(9);
BENCHMARK(processToVersion)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(processToInfo)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(window, playback, Work::kPlay)->UseManualTime()->Iterations(1);
BENCHMARK_CAPTURE(window, repainting_everything, Work::kRepaintAll)->UseManualTime()->Iterations(1);
BENCHMARK_CAPTURE(window, paused, Work::kNothing)->UseManualTime()->Iterations(1);

}  // namespace
