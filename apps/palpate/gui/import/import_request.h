// What the Import dialog asks for, what it remembers in the settings, and the work that a worker
// does for it.
#pragma once

#include <QSettings>
#include <QString>
#include <QStringList>
#include <filesystem>
#include <optional>
#include <vector>

#include <palpate/recording/recording_import.h>

namespace palpate::gui {

struct ImportRequest {
  QString data;
  // Name of a known hand, or its folder.
  QString hand;
  ImportMapping mapping;
  QString out;
  bool strict = false;
  bool replace = false;
};

// The hand and what an import would do; computed by a worker.
struct ImportLook {
  std::optional<HandDescription> hand;
  std::optional<ImportPreview> preview;
  // Why nothing can be imported, in one line; empty when it can.
  QString problem;
};
// Never throws for bad files. `folders`: where hands are looked for by name.
ImportLook lookAtImport(const ImportRequest& request,
                        const std::vector<std::filesystem::path>& folders);

// Throws as importRecording() and findHand().
ImportReport runImport(const ImportRequest& request,
                       const std::vector<std::filesystem::path>& folders,
                       const Progress& progress);

// What the status line says of a finished import.
QString textOf(const ImportReport& report, const QString& out);

// The last request: hand, mapping, folder of the data.
void saveImportRequest(const ImportRequest& request, QSettings& settings);
ImportRequest loadImportRequest(const QSettings& settings);

// Mappings by name. A stored one that can't be read is left out.
QStringList importPresets(QSettings& settings);
std::optional<ImportMapping> importPreset(const QSettings& settings, const QString& name);
void saveImportPreset(QSettings& settings, const QString& name, const ImportMapping& mapping);
void removeImportPreset(QSettings& settings, const QString& name);

}  // namespace palpate::gui
