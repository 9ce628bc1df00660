#include "gui/timeline/grasp_export.h"

#include <QFileInfo>
#include <memory>
#include <stdexcept>
#include <vector>

#include <palpate/batch/grasp_files.h>
#include <palpate/core/error.h>
#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/timeline/crop_job.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

constexpr const char* kGraspFolder = "recent/grasp_folder";
constexpr const char* kNumber = "{n}";

// With the number of the grasp in the name, and an ending.
QString graspTemplate(QString path) {
  if (QFileInfo(path).suffix().isEmpty()) path += ".palpate";
  const QFileInfo file(path);
  if (file.fileName().contains(kNumber)) return path;
  return file.path() + "/" + file.completeBaseName() + "_" + kNumber + "." + file.suffix();
}

}  // namespace

GraspExport::GraspExport(WindowState& windowState, QWidget* window, QObject* parent)
    : QObject(parent),
      windowState_(windowState),
      strip_(new OpeningStrip(window, "Exporting the grasps of", "exportingGrasps")) {
  QAction* action = windowState.actions.make("exportGrasps", "File", "Export each grasp…");
  action->setToolTip("Save each grasp as a separate recording, with its labels");
  connect(action, &QAction::triggered, this, &GraspExport::exportEach);
  windowState.actionEnabler.add({action},
                                [&windowState] { return windowState.displayed.hasFrames(); });
  connect(&job_, &BackgroundJob::started, strip_, &OpeningStrip::begin);
  connect(&job_, &BackgroundJob::progressed, strip_, &OpeningStrip::setProgress);
  connect(&job_, &BackgroundJob::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, &job_, &BackgroundJob::cancel);
  connect(&job_, &BackgroundJob::failed, &windowState.messages, &Messages::fail);
  connect(&job_, &BackgroundJob::cancelled, this, [&windowState] {
    windowState.messages.flash(
        "exporting the grasps was cancelled; the files that were written are complete");
  });
  windowState.escapeHandler.add(EscapeHandler::Order::kWork, [this] {
    if (!job_.busy()) return false;
    job_.cancel();
    return true;
  });
}

void GraspExport::exportEach() {
  const OpenedRecordingPtr recording = windowState_.displayed.unfilteredRecording();
  EventEditor* editor = windowState_.events.editor();
  if (!recording || !editor || !windowState_.displayed.hasFrames()) return;
  const QFileInfo source(pathText(recording->path));
  const QString folder =
      windowState_.settings.value(kGraspFolder, source.absolutePath()).toString();
  QString path = windowState_.ask.newFile(
      "Export each grasp ({n} is its number)",
      folder + "/" + source.completeBaseName() + "_" + kNumber + ".palpate",
      recordingFormatFilter());
  if (path.isEmpty()) return;
  path = graspTemplate(path);
  windowState_.settings.setValue(kGraspFolder, QFileInfo(path).absolutePath());
  auto files = std::make_shared<std::vector<std::filesystem::path>>();
  job_.start(
      pathText(recording->path),
      [recording, path, files, events = editor->events()](const Progress& progress) {
        const std::vector<GraspFrames> grasps = graspFrames(recording->profile, events);
        if (grasps.empty())
          throw Error(recording->path.string() + ": has no grasp; mark some in the timeline");
        try {
          const GraspTemplate names(path.toStdString());
          for (std::size_t i = 0; i < grasps.size(); ++i)
            files->push_back(
                names.pathFor({.name = recording->path.stem().string(),
                               .ending = recording->path.extension().string().erase(0, 1),
                               .timeUs = recording->profile.frameTimeUs(0)},
                              i + 1,
                              grasps.size()));
        } catch (const std::invalid_argument& error) {
          throw Error(error.what());
        }
        GraspFilesOptions options;
        const ExportSource exported(recording->path, recording->meta);
        options.extras = [&exported](const Profile& grasp, const std::filesystem::path& out) {
          return CropJob::extrasOf(exported, grasp, out, true);
        };
        saveGrasps(recording->path, recording->profile, events, grasps, *files, options, progress);
      },
      [this, files] {
        QStringList paths;
        for (const std::filesystem::path& file : *files) paths.append(pathText(file));
        windowState_.messages.flash(
            "written: " + QString::fromStdString(counted(files->size(), "grasp")) + ", " +
            paths.first() + " and on");
        emit written(paths);
      });
}

}  // namespace palpate::gui
