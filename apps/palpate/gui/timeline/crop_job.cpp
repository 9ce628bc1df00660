#include "gui/timeline/crop_job.h"

#include <QFileInfo>
#include <QPushButton>
#include <QToolButton>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/recording/crop.h>
#include <palpate/recording/recording.h>
#include <palpate/recording/recording_losses.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

constexpr const char* kCropFolder = "recent/crop_folder";
constexpr std::string_view kCropEnding = ".palpate";

// Whether a file of this format can be opened as a recording.
bool canBeOpened(const QString& path) { return formatOf(path.toStdString()).reader != nullptr; }

}  // namespace

QString recordingFormatFilter() {
  QStringList formats;
  for (const RecordingFormat* format : recordingFormats())
    for (const char* ending : format->endings)
      formats.insert(ending == kCropEnding ? 0 : formats.size(),
                     QString("%1 (*%2)").arg(format->purpose, ending));
  return formats.join(";;");
}

CropJob::CropJob(WindowState& windowState, QAction& crop, QAction& saveAs, QWidget* window)
    : windowState_(windowState),
      strip_(new OpeningStrip(window, "Saving", "working")),
      offer_(new OfferStrip(window)) {
  connect(&crop, &QAction::triggered, this, &CropJob::cropSelection);
  connect(&saveAs, &QAction::triggered, this, &CropJob::saveAs);
  connect(&job_, &BackgroundJob::started, strip_, &OpeningStrip::begin);
  offer_->findChild<QPushButton*>("offerAccept")->setObjectName("openSaved");
  offer_->findChild<QToolButton*>("offerClose")->setObjectName("openSavedClose");
  connect(&job_, &BackgroundJob::started, offer_, &OfferStrip::dismiss);
  connect(&windowState.displayed, &DisplayedSource::shown, offer_, &OfferStrip::dismiss);
  connect(&job_, &BackgroundJob::progressed, strip_, &OpeningStrip::setProgress);
  connect(&job_, &BackgroundJob::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, &job_, &BackgroundJob::cancel);
  connect(&job_, &BackgroundJob::failed, &windowState.messages, &Messages::fail);
  connect(&job_, &BackgroundJob::cancelled, this, [this](const QString& text) {
    windowState_.messages.flash(QFileInfo(text).fileName() + ": cancelled, nothing was written");
  });
  windowState.escapeHandler.add(EscapeHandler::Order::kWork, [this] {
    if (!job_.busy()) return false;
    job_.cancel();
    return true;
  });
}

SaveExtras CropJob::extrasOf(const ExportSource& source,
                             const Profile& profile,
                             const std::filesystem::path& out,
                             bool isPart) {
  SaveExtras extras;
  // The file of the recording may be damaged, or gone since it was opened.
  if (formatOf(out).takesSeries) extras = exportExtras({}, source, out, profile, {});
  extras.meta = source.meta();
  if (isPart) extras.meta.erase("settings");
  return extras;
}

void CropJob::cropSelection() {
  const OpenedRecordingPtr recording = windowState_.displayed.unfilteredRecording();
  if (!recording || !windowState_.selection.span())
    return windowState_.messages.flash(
        "nothing is selected: drag in the timeline, or press [ and ]");
  const auto frames = windowState_.selectedFrames();
  if (!frames) return windowState_.messages.fail("The selection contains no frames");
  const auto number = [](std::size_t frame) { return QString("%1").arg(frame, 6, 10, QChar('0')); };
  const QString here = QFileInfo(pathText(recording->path)).absolutePath();
  const QString folder = windowState_.settings.value(kCropFolder, here).toString();
  const QString stem = QFileInfo(fileNameOf(*recording)).completeBaseName();
  QString path = windowState_.ask.newFile(
      "Crop to a new recording",
      folder + "/" + stem + "_" + number(frames->first) + "-" + number(frames->last) + ".palpate",
      recordingFormatFilter());
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".palpate";
  windowState_.settings.setValue(kCropFolder, QFileInfo(path).absolutePath());
  start(path, Frames{frames->first, frames->last});
}

void CropJob::saveAs() {
  const OpenedRecordingPtr recording = windowState_.displayed.unfilteredRecording();
  if (!recording) return;
  const QFileInfo file(pathText(recording->path));
  const QString folder = windowState_.settings.value(kCropFolder, file.absolutePath()).toString();
  // A copy beside the recording gets a name of its own.
  QString suggestion = folder + "/" + file.completeBaseName() + ".palpate";
  if (QFileInfo::exists(suggestion))
    suggestion = folder + "/" + file.completeBaseName() + "_copy.palpate";
  QString path =
      windowState_.ask.newFile("Save the recording as", suggestion, recordingFormatFilter());
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".palpate";
  windowState_.settings.setValue(kCropFolder, QFileInfo(path).absolutePath());
  start(path, std::nullopt);
}

void CropJob::start(const QString& path, const std::optional<Frames>& part) {
  try {
    const std::string leftOut =
        leftOutText(windowState_.displayed.unfilteredRecording()->profile, path.toStdString());
    if (!leftOut.empty() &&
        !windowState_.ask.confirmed(QString::fromStdString(leftOut) + ".", "Save without them"))
      return;
  } catch (const Error& error) {
    return windowState_.messages.fail(QString::fromUtf8(error.what()));
  }
  EventEditor* editor = windowState_.events.editor();
  std::vector<Event> noted = editor ? editor->events() : std::vector<Event>();
  job_.start(
      path,
      [recording = windowState_.displayed.unfilteredRecording(),
       part,
       path,
       noted = std::move(noted)](const Progress& progress) {
        const std::filesystem::path out = path.toStdString();
        requireOther(recording->path, out);
        const ExportSource source(recording->path, recording->meta);
        const auto save =
            [&](const Profile& profile, const std::vector<Event>& events, const Progress& saving) {
              // The dialogue has already asked whether an existing file may be replaced.
              saveRecording(profile,
                            events,
                            out,
                            Overwrite::kReplace,
                            saving,
                            extrasOf(source, profile, out, part.has_value()));
            };
        if (!part) return save(recording->profile, noted, progress);
        const Profile selected =
            cropped(recording->profile, part->first, part->last, partOf(progress, 0.0, 0.5));
        save(selected, eventsWithin(noted, selected), partOf(progress, 0.5, 1.0));
      },
      [this,
       path,
       part,
       written = editor ? editor->events() : std::vector<Event>(),
       saved = windowState_.displayed.unfilteredRecording(),
       count = part ? part->last - part->first + 1
                    : windowState_.displayed.unfilteredRecording()->profile.numFrames()] {
        // The open recording doesn't have the labels of the copy: what was unsaved in it still is.
        windowState_.messages.flash("written: " + path + " (" + numberOf(count, "frame") + ")");
        if (canBeOpened(path)) windowState_.recent.add(path);
        emit this->written(path);
        if (!canBeOpened(path)) return;
        // Not when something was labelled while the copy was written.
        if (!part && windowState_.events.eventsOf(saved) == written)
          windowState_.events.savedElsewhere(saved);
        windowState_.recordings.open({{path.toStdString()}, OpenRequest::Then::kList});
        // Another recording may be shown by now.
        if (!part && windowState_.displayed.unfilteredRecording() == saved)
          offer_->offer(
              "Saved as " + QFileInfo(path).fileName() + ". " + fileNameOf(*saved) + " stays open.",
              "Open the new one",
              [this, path] { windowState_.openOrShow({path.toStdString()}); });
      });
}

}  // namespace palpate::gui
