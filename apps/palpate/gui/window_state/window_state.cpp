#include "gui/window_state/window_state.h"

#include <QDateTime>
#include <QFileInfo>
#include <QTime>

#include <palpate/core/number_text.h>
#include <palpate/recording/recording.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/settings_file.h"

namespace palpate::gui {
namespace {

constexpr const char* kDemoFile = "demo_grasps.dsa";

const Clock& clockOf(const WindowEnvironment& environment) {
  return environment.clock ? *environment.clock : systemClock();
}

RecordingOpener::Read readerOf(const WindowEnvironment& environment) {
  if (environment.read) return environment.read;
  return [](const std::filesystem::path& path, const Progress& progress) {
    return readRecording(path, {}, progress);
  };
}

// With a reader of its own, files are read by it alone.
RecordingOpener::ReadDamaged damagedReaderOf(const WindowEnvironment& environment) {
  if (environment.read) return {};
  return [](const std::filesystem::path& path, const Progress& progress) {
    return readableRecording(path, {}, progress);
  };
}

}  // namespace

WindowState::WindowState(const WindowEnvironment& given, QWidget* window)
    : environment(given),
      settingsPlace(readableSettings(given.settingsPath)),
      settings(settingsPlace.path, QSettings::IniFormat),
      recent(settings),
      appearance(settings),
      log(clockOf(given)),
      messages(log),
      dialogs(window),
      ask(given.ask ? *given.ask : dialogs),
      actions(window),
      playback(clockOf(given)),
      opener(readerOf(given), damagedReaderOf(given)),
      recordings(opener),
      live(given.dataFolder),
      displayed(live, playback, selection),
      events(displayed, recordings, messages, ask),
      activeFilters(displayed, events, live, messages, settings),
      currentFrame(displayed, activeFilters, live, playback),
      formulas(settings) {}

std::filesystem::path WindowState::demoRecording() const {
  return environment.dataFolder / kDemoFile;
}

void WindowState::open(const std::vector<std::filesystem::path>& files, OpenRequest::Then then) {
  if (files.empty()) return;
  messages.dismissFailures();
  OpenRequest request{.files = {}, .then = then};
  std::filesystem::path folder;
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    if (showLibrary && std::filesystem::is_directory(file, ignored))
      folder = file;
    else
      request.files.push_back(file);
  }
  if (!folder.empty()) showLibrary(QFileInfo(pathText(folder)).absoluteFilePath());
  if (!request.files.empty()) recordings.open(request);
}

void WindowState::openOrShow(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return;
  messages.dismissFailures();
  recordings.open({.files = files, .readAnew = false});
}

void WindowState::askAndOpen(OpenRequest::Then then) {
  std::vector<std::filesystem::path> files;
  for (const QString& path :
       ask.files("Open recordings",
                 recent.lastFolder(),
                 "Recordings (*.dsa *.palpate *.h5 *.hdf5 *.mcap *.xml);;All files (*)"))
    files.emplace_back(path.toStdString());
  if (files.empty()) return;
  recent.setLastFolder(QFileInfo(pathText(files[0])).path());
  open(files, then);
}

void WindowState::connectTo(const Connection& connection) {
  if (live.recording() && !prompts.endRecording(UserPrompts::Ending::kDisconnect)) return;
  messages.dismissFailures();
  live.connectTo(connection);
}

std::optional<FrameSpan> WindowState::selectedFrames() const {
  const OpenedRecordingPtr& recording = displayed.unfilteredRecording();
  const auto& span = selection.span();
  if (!recording || !span) return std::nullopt;
  const auto frames = recording->framesWithin(span->fromS, span->toS);
  if (!frames) return std::nullopt;
  return FrameSpan{frames->first, frames->second};
}

std::optional<FramePictures> WindowState::framePictures(const QString& suffix) const {
  if (!displayed.isRecording()) return std::nullopt;
  const OpenedRecordingPtr recording = displayed.filteredRecording();
  FramePictures pictures;
  pictures.fileName = recordingStem() + suffix;
  pictures.numFrames = recording->profile.numFrames();
  pictures.selected = selectedFrames();
  pictures.timeUs = [recording](std::size_t frame) {
    return recording->profile.frameTimeUs(frame);
  };
  return pictures;
}

QString WindowState::recordingStem() const {
  if (!displayed.isRecording()) return frameStem();
  return QFileInfo(fileNameOf(*displayed.unfilteredRecording())).completeBaseName();
}

QString WindowState::frameStem() const {
  if (!displayed.isRecording()) return "live_" + QTime::currentTime().toString("HHmmss");
  return QString("%1_frame_%2")
      .arg(QFileInfo(fileNameOf(*displayed.unfilteredRecording())).completeBaseName())
      .arg(playback.frame(), 5, 10, QChar('0'));
}

QString WindowState::pictureTitle() const {
  if (displayed.isLive()) return describe(live.connection()) + activeFilters.caption();
  return displayed.isRecording()
             ? fileNameOf(*displayed.unfilteredRecording()) + activeFilters.caption()
             : QString();
}

QString WindowState::pictureCaption() const {
  if (displayed.isLive())
    return QDateTime::fromMSecsSinceEpoch(currentFrame.frame().hostUs / kUsPerMs)
        .toString("yyyy-MM-dd HH:mm:ss.zzz");
  if (!displayed.isRecording()) return {};
  const double seconds = displayed.unfilteredRecording()->timeAt(playback.frame());
  return "frame " + QString::number(playback.frame()) + " · " +
         QString::fromStdString(fixedText(seconds, 2)) + " s";
}

}  // namespace palpate::gui
