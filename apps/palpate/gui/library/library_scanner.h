// Scans a folder of recordings in the background and delivers the entries in small portions, so
// that the window stays responsive. Used by LibraryPanel.
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/library/recording_catalog.h>
#include <palpate/library/recording_search.h>

#include "gui/source/abandonable.h"

namespace palpate::gui {

// UTF-8 text for comparison without regard to case (Unicode case folding by Qt). Bytes that are not
// UTF-8 become U+FFFD.
std::string caseFolded(std::string_view text);

// One recording of the library, with its text for the search.
struct LibraryEntry {
  RecordingDetails details;
  SearchableText text;
};

class LibraryScanner : public QObject {
  Q_OBJECT
 public:
  // The function that scans a folder; tests pass their own.
  using Catalog = std::function<CatalogReport(const std::filesystem::path& folder,
                                              const std::filesystem::path& cacheFolder,
                                              const CatalogSink& sink,
                                              const Progress& progress)>;

  explicit LibraryScanner(const QString& cacheFolder, Catalog catalog, QObject* parent = nullptr);

  // Cancels the running scan, which emits nothing more, and starts a new one.
  void scan(const QString& folder);
  // Cancels the running scan; emits cancelled().
  void cancel();
  bool busy() const noexcept { return work_.busy(); }

 signals:
  void listed(int numFiles);
  void found(const std::vector<palpate::gui::LibraryEntry>& entries);
  // `fraction`: 0..1.
  void progressed(double fraction);
  // Each scan ends with exactly one of these three signals, unless scan() replaces it.
  void finished(const palpate::CatalogReport& report);
  void cancelled();
  void failed(const QString& message);

 private:
  QString cacheFolder_;
  Catalog catalog_;
  Abandonable work_;
};

}  // namespace palpate::gui
