// What the Import dialog asks for, what it remembers in the settings, and the work that a worker
// does for it.
#pragma once

#include <QSettings>
#include <QString>
#include <filesystem>
#include <optional>
#include <vector>

#include <palpate/imports/recording_import.h>

#include "gui/appearance/named_items.h"

namespace palpate::gui {

struct ImportRequest {
  QString data;
  // Name of a known hand, or its folder.
  QString hand;
  ImportMapping mapping;
  // Other tables that become series of the recording.
  std::vector<SeriesFile> series = {};
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

// Mappings by name.
NamedItems<ImportMapping> importPresets(QSettings& settings);

}  // namespace palpate::gui
