#include <QEventLoop>
#include <QFile>
#include <QPixmap>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>
#include <chrono>

#include <palpate/core/error.h>
#include <palpate/core/output_file.h>
#include <palpate/core/time.h>

#include "gui/appearance/window_settings.h"
#include "gui/calibrate/calibrate_feature.h"
#include "gui/calibrate/calibrate_panel.h"
#include "gui/compare/compare_feature.h"
#include "gui/compare/compare_panel.h"
#include "gui/connect/connect_feature.h"
#include "gui/desktop/application.h"
#include "gui/filter/filter_feature.h"
#include "gui/hand/hand_dock.h"
#include "gui/hand/hand_feature.h"
#include "gui/hand3d/gl_probe.h"
#include "gui/hand3d/hand3d_feature.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/picture/picture_export.h"
#include "gui/recognise/recognise_feature.h"
#include "gui/recognise/recognise_panel.h"
#include "gui/shell/main_window.h"
#include "gui/shell/run_window.h"
#include "gui/slip/slip_feature.h"
#include "gui/source/file_reading.h"
#include "gui/spectrum/spectrum_feature.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"

namespace palpate::gui {
namespace {

// Opens the recording and waits for it; throws Error when that fails.
void openAndWait(MainWindow& window, const ScreenshotOptions& options) {
  QEventLoop loop;
  QString failure;
  QObject::connect(&window.state().opener,
                   &RecordingOpener::failed,
                   &loop,
                   [&](const QString&, const QString& message) { failure = message; });
  QObject::connect(&window.state().opener, &RecordingOpener::finished, &loop, &QEventLoop::quit);
  std::vector<std::filesystem::path> files = {*options.file};
  if (options.comparedWith) files.push_back(*options.comparedWith);
  window.state().open(files);
  loop.exec();
  if (!failure.isEmpty()) throw Error(failure.toStdString());
}

void runFor(double seconds) {
  QEventLoop loop;
  QTimer::singleShot(static_cast<int>(seconds * kMsPerS), &loop, &QEventLoop::quit);
  loop.exec();
}

void showCompare(MainWindow& window, const ScreenshotOptions& options) {
  constexpr double kLookS = 0.01;
  constexpr double kPatienceS = 60.0;
  if (!window.state().comparison.on()) window.state().actions.at("compare")->trigger();
  for (double waitedS = 0.0;
       !window.feature<CompareFeature>().panel().complete() && waitedS < kPatienceS;
       waitedS += kLookS)
    runFor(kLookS);
  // Without a chosen frame, shows a time that both recordings have.
  const auto common = window.feature<CompareFeature>().panel().common();
  if (!options.frame && common && window.state().playback.positionS() > common->toS)
    window.state().playback.seekSeconds(common->toS);
}

// Connects to the demo and waits for the first frame.
void runDemo(MainWindow& window) {
  constexpr double kPatienceS = 30.0;
  constexpr double kLookS = 0.02;
  QString failure;
  const auto failedConnection =
      QObject::connect(&window.state().live, &LiveController::failed, [&](const QString& message) {
        failure = message;
      });
  window.state().connectTo(emulatedBallConnection());
  for (double waitedS = 0.0; !window.state().live.hasReceivedFrames(); waitedS += kLookS) {
    if (failure.isEmpty() && waitedS > kPatienceS)
      failure = "no frame of the emulated hand arrived";
    if (!failure.isEmpty()) throw Error(failure.toStdString());
    runFor(kLookS);
  }
  QObject::disconnect(failedConnection);
}

void goToFrame(MainWindow& window, const ScreenshotOptions& options) {
  PlaybackController& playback = window.state().playback;
  if (options.frame && *options.frame >= playback.numFrames())
    throw Error("no frame " + std::to_string(*options.frame) + ": " +
                window.state().displayed.unfilteredRecording()->path.string() + " has frames 0.." +
                std::to_string(static_cast<long long>(playback.numFrames()) - 1));
  if (options.afterS > 0.0) {
    playback.play();
    runFor(options.afterS);
  }
  playback.pause();
  if (options.frame)
    playback.seekFrame(*options.frame);
  else if (options.afterS <= 0.0)
    playback.seekFrame(window.state().displayed.unfilteredRecording()->table.frameOfLargestSum());
}

// For a demo, --after is time during which it runs. A recording has already been played for that
// time; here it only gets time for the presses.
QImage pressAll(MainWindow& window, const ScreenshotOptions& options) {
  constexpr double kGraceS = 1.0;
  double forS = options.demo ? options.afterS : 0.0;
  for (const ScreenshotPress& press : options.presses)
    forS = std::max(forS, press.atS + (options.demo ? 0.0 : kGraceS));
  return forS > 0.0 ? runAndPress(window, options.presses, forS) : QImage();
}

ThemeChoice themeOf(const ScreenshotOptions& options) {
  const ThemeChoice choice = themeChoiceFrom(QString::fromStdString(options.theme));
  if (choice == ThemeChoice::kSystem)
    throw Error("no theme '" + options.theme + "': dark or light");
  return choice;
}

// The theme is there before the first widget: a later one styles all of them again.
void useSettings(const QString& to, const ScreenshotOptions& options) {
  if (options.settings && !QFile::copy(QString::fromStdString(options.settings->string()), to))
    throw FileError(*options.settings, "the settings can't be read");
  if (options.settings) QFile::setPermissions(to, QFile::ReadOwner | QFile::WriteOwner);
  QSettings stored(to, QSettings::IniFormat);
  ViewSettings view = loadViewSettings(stored);
  view.theme = themeOf(options);
  saveViewSettings(view, stored);
  stored.sync();
  if (stored.status() != QSettings::NoError)
    throw Error("the settings can't be written: " + to.toStdString());
}

void settle(MainWindow& window) {
  // Files first: the rest computes from them.
  window.settle();
  window.feature<FilterFeature>().settle();
  TimelineChart& timeline = window.feature<TimelineFeature>().panel().chart();
  timeline.store().waitForFirstLook();
  timeline.storeBefore().waitForFirstLook();
  window.feature<SpectrumFeature>().settle();
  window.feature<CalibrateFeature>().settle();
  window.feature<RecogniseFeature>().settle();
  window.feature<SlipFeature>().settle();
  // Layout requests and queued replots follow one another in several rounds of events.
  constexpr int kRounds = 5;
  for (int i = 0; i < kRounds; ++i) QCoreApplication::processEvents();
}

template <typename Panel>
void showPage(Panel& panel, const QString& dock, const QString& page) {
  if (page.isEmpty()) return;
  if (!panel.pageNames().contains(page))
    throw Error("no page '" + page.toStdString() + "' of " + dock.toStdString() + ": there are " +
                panel.pageNames().join(", ").toStdString());
  panel.showPage(page);
}

void showDocks(MainWindow& window, const ScreenshotOptions& options) {
  for (const std::string& dock : options.docks) {
    const QString given = QString::fromStdString(dock).section('/', 0, 0);
    const QStringList names = window.docks().names();
    const auto found = std::find_if(names.begin(), names.end(), [&](const QString& each) {
      return each.compare(given, Qt::CaseInsensitive) == 0;
    });
    if (found == names.end())
      throw Error("no dock '" + dock + "': there are " + names.join(", ").toStdString());
    const QString& name = *found;
    if (window.state().displayed.kind() != DisplayedSource::Kind::kNothing)
      window.docks().show(name);
    // "Calibrate/Noise" names a page of the dock.
    const QString page = QString::fromStdString(dock).section('/', 1);
    const bool hasPages = name == "Hand" || name == "Calibrate" || name == "Recognise";
    if (!page.isEmpty() && !hasPages)
      throw Error("no page '" + page.toStdString() + "': " + name.toStdString() + " has no pages");
    if (name == "Hand") showPage(window.feature<HandFeature>().panel(), name, page);
    if (name == "Calibrate") showPage(window.feature<CalibrateFeature>().panel(), name, page);
    if (name == "Recognise") showPage(window.feature<RecogniseFeature>().panel(), name, page);
  }
}

}  // namespace

int takeScreenshot(int& argc, char** argv, const ScreenshotOptions& options) {
  themeOf(options);  // refused before anything is made
  std::error_code ignored;
  if (!options.force && std::filesystem::exists(options.out, ignored))
    throw FileError(options.out, "exists already; give another name, or --force to replace it");
  // Default settings, independent of those of the user.
  const QTemporaryDir settings;
  // Without a login session this folder doesn't exist, and Qt would warn on standard error.
  if (!qEnvironmentVariableIsSet("XDG_RUNTIME_DIR"))
    qputenv("XDG_RUNTIME_DIR", settings.path().toLocal8Bit());
  const auto application = makeApplication(argc, argv);
  // No thread may see the application being destroyed.
  struct ThreadsEnd {
    ~ThreadsEnd() { Abandonable::awaitThreads(std::chrono::hours(1)); }
  } const last;
  useSettings(settings.filePath("palpate.ini"), options);
  MainWindow window({.dataFolder = options.dataFolder,
                     .settingsPath = settings.filePath("palpate.ini"),
                     .clock = nullptr,
                     .read = {},
                     .assumedAnglesDeg = options.assumedAnglesDeg,
                     .recipe = options.recipe});
  if (options.openGl && openGlProblem().isEmpty())
    window.feature<Hand3dFeature>().panel().view().useOpenGl();
  window.setFixedSize(options.size);
  window.show();
  if (options.file) {
    openAndWait(window, options);
    goToFrame(window, options);
  } else if (options.demo) {
    runDemo(window);
  }
  if (options.comparedWith) showCompare(window, options);
  showDocks(window, options);
  FileReading::settleAll(window);
  QImage image = pressAll(window, options);
  settle(window);
  if (image.isNull()) image = window.grab().toImage();
  // There is no user to ask; an opened recording stays unchanged.
  window.state().events.discardAll();
  window.closeUnasked();
  writePng(options.out, image, options.force ? Overwrite::kReplace : Overwrite::kRefuse);
  return 0;
}

}  // namespace palpate::gui
