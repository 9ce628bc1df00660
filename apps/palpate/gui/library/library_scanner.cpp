#include "gui/library/library_scanner.h"

#include <QMetaObject>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

constexpr std::size_t kPortion = 200;  // entries that the window takes at once
constexpr double kLibraryScannerSmallestNews = 0.01;
constexpr auto kPatience = std::chrono::seconds(2);  // waiting time for a thread to end

}  // namespace

std::string caseFolded(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()))
      .toCaseFolded()
      .toStdString();
}

// What the thread and the object share; it exists as long as either of them.
struct LibraryScanner::Run {
  std::atomic<bool> cancelled = false;
  std::mutex mutex;
  std::condition_variable ended;
  // Null when the scan was cancelled.
  LibraryScanner* owner = nullptr;
  // processScanResults() is already queued.
  bool called = false;
  bool done = false;
  std::optional<std::size_t> listed;
  std::deque<LibraryEntry> entries;
  std::optional<double> fraction;
  std::optional<CatalogReport> report;
  QString failure;

  // Makes a change and queues one call of processScanResults().
  template <typename Change>
  void post(Change change) {
    const std::lock_guard lock(mutex);
    change();
    if (owner == nullptr || called) return;
    called = true;
    QMetaObject::invokeMethod(owner, &LibraryScanner::processScanResults, Qt::QueuedConnection);
  }
};

LibraryScanner::LibraryScanner(const QString& cacheFolder, Catalog catalog, QObject* parent)
    : QObject(parent), cacheFolder_(cacheFolder), catalog_(std::move(catalog)) {}

LibraryScanner::~LibraryScanner() {
  const std::shared_ptr<Run> run = run_;
  abandonScan();
  if (!run) return;
  std::unique_lock lock(run->mutex);
  run->ended.wait_for(lock, kPatience, [&] { return run->done; });
}

void LibraryScanner::abandonScan() {
  const std::shared_ptr<Run> run = std::exchange(run_, nullptr);
  if (!run) return;
  run->cancelled = true;
  const std::lock_guard lock(run->mutex);
  run->owner = nullptr;
  run->entries.clear();
}

void LibraryScanner::scan(const QString& folder) {
  abandonScan();
  run_ = std::make_shared<Run>();
  run_->owner = this;
  std::thread(&LibraryScanner::work,
              run_,
              catalog_,
              std::filesystem::path(folder.toStdString()),
              std::filesystem::path(cacheFolder_.toStdString()))
      .detach();
}

void LibraryScanner::cancel() {
  if (!run_) return;
  abandonScan();
  emit cancelled();
}

void LibraryScanner::work(const std::shared_ptr<Run>& run,
                          const Catalog& catalog,
                          const std::filesystem::path& folder,
                          const std::filesystem::path& cacheFolder) {
  CatalogSink sink;
  sink.listed = [&](std::size_t numFiles) { run->post([&] { run->listed = numFiles; }); };
  sink.take = [&](RecordingDetails&& details) {
    LibraryEntry entry{std::move(details), {}};
    entry.text = searchableText(entry.details, folder, caseFolded);
    run->post([&] { run->entries.push_back(std::move(entry)); });
  };
  double reported = -1.0;
  const Progress progress = [&](double fraction) {
    if (fraction - reported >= kLibraryScannerSmallestNews) {
      reported = fraction;
      run->post([&] { run->fraction = fraction; });
    }
    return !run->cancelled;
  };
  std::optional<CatalogReport> report;
  QString failure;
  try {
    report = catalog(folder, cacheFolder, sink, progress);
  } catch (const Cancelled&) {
  } catch (const std::exception& error) {
    failure = QString::fromUtf8(error.what());
  }
  run->post([&] {
    run->report = std::move(report);
    run->failure = failure;
    run->done = true;
  });
  run->ended.notify_all();
}

// Takes one portion at a time, so that the window can process other events in between.
void LibraryScanner::processScanResults() {
  const std::shared_ptr<Run> run = run_;
  // The scan was cancelled meanwhile.
  if (!run) return;
  std::optional<std::size_t> numFiles;
  std::optional<double> fraction;
  std::vector<LibraryEntry> entries;
  bool ended = false;
  {
    const std::lock_guard lock(run->mutex);
    numFiles = std::exchange(run->listed, std::nullopt);
    fraction = std::exchange(run->fraction, std::nullopt);
    const auto count = std::min(kPortion, run->entries.size());
    const auto end = run->entries.begin() + static_cast<std::ptrdiff_t>(count);
    entries.assign(std::make_move_iterator(run->entries.begin()), std::make_move_iterator(end));
    run->entries.erase(run->entries.begin(), end);
    run->called = !run->entries.empty();
    ended = run->done && run->entries.empty();
    if (run->called)
      QMetaObject::invokeMethod(this, &LibraryScanner::processScanResults, Qt::QueuedConnection);
  }
  if (numFiles) emit listed(static_cast<int>(*numFiles));
  if (fraction) emit progressed(*fraction);
  if (!entries.empty()) emit found(entries);
  if (!ended || run != run_) return;
  run_.reset();
  if (run->report)
    emit finished(*run->report);
  else
    emit failed(run->failure);
}

}  // namespace palpate::gui
