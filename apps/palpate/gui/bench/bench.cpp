#include "gui/bench/bench.h"

#include <QDateTime>
#include <QFileInfo>
#include <QTime>

#include <palpate/core/number_text.h>
#include <palpate/recording/recording.h>

#include "gui/look/path_text.h"

namespace palpate::gui {
namespace {

constexpr const char* kDemoFile = "demo_grasps.dsa";

const Clock& clockOf(const WindowSurroundings& surroundings) {
  return surroundings.clock ? *surroundings.clock : systemClock();
}

RecordingOpener::Read readerOf(const WindowSurroundings& surroundings) {
  if (surroundings.read) return surroundings.read;
  return [](const std::filesystem::path& path, const Progress& progress) {
    return openRecording(path, progress);
  };
}

}  // namespace

Bench::Bench(const WindowSurroundings& given, QWidget* window)
    : surroundings(given),
      settings(given.settingsPath, QSettings::IniFormat),
      recent(settings),
      look(settings),
      log(clockOf(given)),
      messages(log),
      actions(window),
      playback(clockOf(given)),
      opener(readerOf(given)),
      recordings(opener),
      live(given.dataFolder),
      subject(live, playback, selection),
      events(subject, recordings, messages, questions),
      filtering(subject, events, live, messages, settings),
      moment(subject, filtering, live, playback) {}

std::filesystem::path Bench::demoRecording() const { return surroundings.dataFolder / kDemoFile; }

void Bench::open(const std::vector<std::filesystem::path>& files, OpenRequest::Then then) {
  if (files.empty()) return;
  messages.dismissFailures();
  recordings.open({files, then});
}

void Bench::askAndOpen(OpenRequest::Then then) {
  std::vector<std::filesystem::path> files;
  for (const QString& path : questions.recordings()) files.emplace_back(path.toStdString());
  if (files.empty()) return;
  recent.setLastFolder(QFileInfo(pathText(files[0])).path());
  open(files, then);
}

void Bench::connectTo(const Connection& connection) {
  if (live.recording() && !questions.endRecording()) return;
  messages.dismissFailures();
  live.connectTo(connection);
}

std::optional<FrameSpan> Bench::selectedFrames() const {
  const OpenedRecordingPtr& recording = subject.behind();
  const auto& span = selection.span();
  if (!recording || !span) return std::nullopt;
  const auto frames = recording->framesWithin(span->fromS, span->toS);
  if (!frames) return std::nullopt;
  return FrameSpan{frames->first, frames->second};
}

std::optional<FramePictures> Bench::framePictures(const QString& suffix) const {
  if (!subject.isRecording()) return std::nullopt;
  const OpenedRecordingPtr recording = subject.seen();
  FramePictures pictures;
  pictures.fileName = recordingStem() + suffix;
  pictures.numFrames = recording->profile.numFrames();
  pictures.selected = selectedFrames();
  pictures.timeUs = [recording](std::size_t frame) {
    return recording->profile.frameTimeUs(frame);
  };
  return pictures;
}

QString Bench::recordingStem() const {
  if (!subject.isRecording()) return frameStem();
  return QFileInfo(fileNameOf(*subject.behind())).completeBaseName();
}

QString Bench::frameStem() const {
  if (!subject.isRecording()) return "live_" + QTime::currentTime().toString("HHmmss");
  return QString("%1_frame_%2")
      .arg(QFileInfo(fileNameOf(*subject.behind())).completeBaseName())
      .arg(playback.frame(), 5, 10, QChar('0'));
}

QString Bench::pictureTitle() const {
  if (subject.isLive()) return describe(live.connection()) + filtering.caption();
  return subject.isRecording() ? fileNameOf(*subject.behind()) + filtering.caption() : QString();
}

QString Bench::pictureCaption() const {
  if (subject.isLive())
    return QDateTime::fromMSecsSinceEpoch(moment.frame().hostUs / kUsPerMs)
        .toString("yyyy-MM-dd HH:mm:ss.zzz");
  if (!subject.isRecording()) return {};
  const double seconds = subject.behind()->timeAt(playback.frame());
  return "frame " + QString::number(playback.frame()) + " · " +
         QString::fromStdString(fixedText(seconds, 2)) + " s";
}

}  // namespace palpate::gui
