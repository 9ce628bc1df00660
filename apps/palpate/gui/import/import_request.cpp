#include "gui/import/import_request.h"

#include <QFileInfo>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/model/hand_file.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

constexpr const char* kImportHand = "import/hand";
constexpr const char* kImportMapping = "import/mapping";
constexpr const char* kImportFolder = "import/folder";
constexpr const char* kImportStrict = "import/strict";

std::string mappingText(const ImportMapping& mapping) { return mappingJson(mapping).text(-1); }

}  // namespace

ImportLook lookAtImport(const ImportRequest& request, const std::vector<fs::path>& folders) {
  ImportLook look;
  try {
    look.hand = findHand(request.hand.toStdString(), folders);
    if (request.data.isEmpty()) {
      look.problem = "choose a file";
      return look;
    }
    look.preview =
        previewImport(request.data.toStdString(), *look.hand, request.mapping, request.series);
    look.problem = QString::fromStdString(look.preview->problem);
  } catch (const std::exception& error) {
    look.problem = QString::fromUtf8(error.what());
  }
  return look;
}

ImportReport runImport(const ImportRequest& request,
                       const std::vector<fs::path>& folders,
                       const Progress& progress) {
  return importRecording(request.data.toStdString(),
                         findHand(request.hand.toStdString(), folders),
                         request.mapping,
                         request.out.toStdString(),
                         {.series = request.series,
                          .strict = request.strict,
                          .overwrite = request.replace ? Overwrite::kReplace : Overwrite::kRefuse},
                         progress);
}

QString textOf(const ImportReport& report, const QString& out) {
  QString text = "imported: " + QFileInfo(out).fileName() + " (" +
                 QString::fromStdString(counted(report.frames, "frame")) + ")";
  if (report.absentFrames > 0)
    text += ", " + QString::fromStdString(counted(report.absentFrames, "frame")) +
            " without an active taxel are not in the list";
  for (const ImportedSeries& series : report.series)
    text += ", series " + QString::fromStdString(series.description.name) + " (" +
            QString::fromStdString(counted(series.samples, "sample")) + ")";
  if (report.isPartial()) text += ", " + inWindowWords(QString::fromStdString(report.lossText()));
  return text;
}

void saveImportRequest(const ImportRequest& request, QSettings& settings) {
  settings.setValue(kImportHand, request.hand);
  settings.setValue(kImportMapping, QString::fromStdString(mappingText(request.mapping)));
  settings.setValue(kImportFolder, QFileInfo(request.data).absolutePath());
  settings.setValue(kImportStrict, request.strict);
}

ImportRequest loadImportRequest(const QSettings& settings) {
  ImportRequest request;
  request.hand = settings.value(kImportHand).toString();
  try {
    request.mapping =
        mappingFromJson(settings.value(kImportMapping).toString().toStdString(), "settings");
  } catch (const Error&) {
    // None is kept, or one that can't be read.
  }
  request.mapping.time.rateHz.reset();  // of the file that was imported
  request.data = settings.value(kImportFolder).toString();
  request.strict = settings.value(kImportStrict, false).toBool();
  return request;
}

NamedItems<ImportMapping> importPresets(QSettings& settings) {
  return {settings, "import_presets", mappingText, [](const std::string& text) {
            return mappingFromJson(text, "settings");
          }};
}

}  // namespace palpate::gui
