#include "gui/import/import_request.h"

#include <QFileInfo>
#include <QUrl>

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
constexpr const char* kImportPresets = "import_presets";

QString keyOf(const QString& name) {
  return QString(kImportPresets) + "/" + QString::fromLatin1(QUrl::toPercentEncoding(name));
}

std::optional<ImportMapping> mappingIn(const QVariant& value) {
  if (!value.isValid()) return std::nullopt;
  try {
    return mappingFromJson(value.toString().toStdString(), "settings");
  } catch (const Error&) {
    return std::nullopt;
  }
}

QString jsonOf(const ImportMapping& mapping) {
  return QString::fromStdString(mappingJson(mapping).text(-1));
}

}  // namespace

ImportLook lookAtImport(const ImportRequest& request, const std::vector<fs::path>& folders) {
  ImportLook look;
  try {
    look.hand = findHand(request.hand.toStdString(), folders);
    if (request.data.isEmpty()) {
      look.problem = "choose a file";
      return look;
    }
    look.preview = previewImport(request.data.toStdString(), *look.hand, request.mapping);
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
                         {.strict = request.strict,
                          .overwrite = request.replace ? Overwrite::kReplace : Overwrite::kRefuse},
                         progress);
}

QString textOf(const ImportReport& report, const QString& out) {
  QString text = "imported: " + QFileInfo(out).fileName() + " (" +
                 QString::fromStdString(counted(report.frames, "frame")) + ")";
  if (report.absentFrames > 0)
    text += ", " + QString::fromStdString(counted(report.absentFrames, "frame")) +
            " without an active taxel are not in the list";
  if (report.isPartial()) text += ", " + inWindowWords(QString::fromStdString(report.lossText()));
  return text;
}

void saveImportRequest(const ImportRequest& request, QSettings& settings) {
  settings.setValue(kImportHand, request.hand);
  settings.setValue(kImportMapping, jsonOf(request.mapping));
  settings.setValue(kImportFolder, QFileInfo(request.data).absolutePath());
  settings.setValue(kImportStrict, request.strict);
}

ImportRequest loadImportRequest(const QSettings& settings) {
  ImportRequest request;
  request.hand = settings.value(kImportHand).toString();
  request.mapping = mappingIn(settings.value(kImportMapping)).value_or(ImportMapping());
  request.mapping.time.rateHz.reset();  // of the file that was imported
  request.data = settings.value(kImportFolder).toString();
  request.strict = settings.value(kImportStrict, false).toBool();
  return request;
}

QStringList importPresets(QSettings& settings) {
  QStringList names;
  settings.beginGroup(kImportPresets);
  const QStringList keys = settings.childKeys();
  settings.endGroup();
  for (const QString& key : keys) {
    const QString name = QUrl::fromPercentEncoding(key.toLatin1());
    if (importPreset(settings, name)) names << name;
  }
  return names;
}

std::optional<ImportMapping> importPreset(const QSettings& settings, const QString& name) {
  return mappingIn(settings.value(keyOf(name)));
}

void saveImportPreset(QSettings& settings, const QString& name, const ImportMapping& mapping) {
  settings.setValue(keyOf(name), jsonOf(mapping));
}

void removeImportPreset(QSettings& settings, const QString& name) { settings.remove(keyOf(name)); }

}  // namespace palpate::gui
