// Goes through a folder of recordings beside the window and hands over what it finds, in portions
// that the window takes without a stop. A folder that hangs holds up nobody: its thread is given
// up. Signals come in the thread of this object.
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/recording/recording_catalog.h>
#include <palpate/recording/recording_search.h>

namespace palpate::gui {

// UTF-8 text as it is compared whatever its case: Unicode's case folding, by Qt. Bytes that are no
// UTF-8 become U+FFFD.
std::string caseFolded(std::string_view text);

// A recording as the library has it.
struct LibraryEntry {
  RecordingDetails details;
  SearchableText text;
};

class LibraryScanner : public QObject {
  Q_OBJECT
 public:
  // How a folder is gone through; tests hand in their own.
  using Catalog = std::function<CatalogReport(const std::filesystem::path& folder,
                                              const std::filesystem::path& cacheFolder,
                                              const CatalogSink& sink,
                                              const Progress& progress)>;

  explicit LibraryScanner(const QString& cacheFolder, Catalog catalog, QObject* parent = nullptr);
  // Cancels; waits for a moment, then leaves a thread that hangs to itself.
  ~LibraryScanner() override;

  // Gives up what is at work, of which nothing more is heard, and begins anew.
  void scan(const QString& folder);
  void cancel();  // cancelled() follows
  bool busy() const noexcept { return run_ != nullptr; }

 signals:
  void listed(int numFiles);
  void found(const std::vector<palpate::gui::LibraryEntry>& entries);
  void progressed(double fraction);  // 0..1
  // One of these three ends each scan.
  void finished(const palpate::CatalogReport& report);
  void cancelled();
  void failed(const QString& message);

 private:
  struct Run;  // shared with the thread
  void abandonScan();
  void processScanResults();
  static void work(const std::shared_ptr<Run>& run,
                   const Catalog& catalog,
                   const std::filesystem::path& folder,
                   const std::filesystem::path& cacheFolder);

  QString cacheFolder_;
  Catalog catalog_;
  std::shared_ptr<Run> run_;  // null: nothing is at work
};

}  // namespace palpate::gui
