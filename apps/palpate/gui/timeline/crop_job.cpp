#include "gui/timeline/crop_job.h"

#include <QFileDialog>
#include <QFileInfo>
#include <utility>

#include <palpate/recording/crop.h>
#include <palpate/recording/recording.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

constexpr const char* kCropFolder = "recent/crop_folder";

}  // namespace

CropJob::CropJob(WindowState& windowState, QAction& crop, QWidget* window)
    : windowState_(windowState), strip_(new OpeningStrip(window, "Cropping", "working")) {
  windowState.prompts.cropped = [window](const QString& suggestion) {
    return QFileDialog::getSaveFileName(
        window,
        "Crop to a new recording",
        suggestion,
        "Palpate recording (*.palpate);;DSA recording (*.dsa);;CSV table (*.csv);;NumPy (*.npz)");
  };
  connect(&crop, &QAction::triggered, this, &CropJob::cropSelection);
  connect(&job_, &BackgroundJob::started, strip_, &OpeningStrip::begin);
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

void CropJob::cropSelection() {
  const OpenedRecordingPtr recording = windowState_.displayed.unfilteredRecording();
  if (!recording || !windowState_.selection.span())
    return windowState_.messages.flash(
        "nothing is selected: drag in the timeline, or press [ and ]");
  const auto frames = windowState_.selectedFrames();
  if (!frames)
    return windowState_.messages.fail("No frame lies in the selection: there is nothing to crop");
  const auto number = [](std::size_t frame) { return QString("%1").arg(frame, 6, 10, QChar('0')); };
  const QString here = QFileInfo(pathText(recording->path)).absolutePath();
  const QString folder = windowState_.settings.value(kCropFolder, here).toString();
  const QString stem = QFileInfo(fileNameOf(*recording)).completeBaseName();
  QString path = windowState_.prompts.cropped(folder + "/" + stem + "_" + number(frames->first) +
                                              "-" + number(frames->last) + ".palpate");
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".palpate";
  windowState_.settings.setValue(kCropFolder, QFileInfo(path).absolutePath());
  start(path, frames->first, frames->last);
}

void CropJob::start(const QString& path, std::size_t first, std::size_t last) {
  EventEditor* editor = windowState_.events.editor();
  std::vector<RecordingEvent> noted = editor ? editor->events() : std::vector<RecordingEvent>();
  job_.start(
      path,
      [recording = windowState_.displayed.unfilteredRecording(),
       first,
       last,
       path,
       noted = std::move(noted)](const Progress& progress) {
        const std::filesystem::path out = path.toStdString();
        requireOther(recording->path, out);
        const auto half = [&](double from) {
          return [&progress, from](double fraction) { return progress(from + 0.5 * fraction); };
        };
        const Profile part = cropped(recording->profile, first, last, half(0.0));
        // The dialogue has already asked whether an existing file may be replaced.
        saveRecording(part, eventsWithin(noted, part), out, Overwrite::kReplace, half(0.5));
      },
      [this, path, count = last - first + 1] {
        windowState_.messages.flash("written: " + path + " (" + QString::number(count) +
                                    " frames)");
        windowState_.recent.add(path);
        emit written(path);
        const QString ending = QFileInfo(path).suffix().toLower();
        if (ending == "csv" || ending == "npz") return;
        windowState_.recordings.open({{path.toStdString()}, OpenRequest::Then::kList});
      });
}

}  // namespace palpate::gui
