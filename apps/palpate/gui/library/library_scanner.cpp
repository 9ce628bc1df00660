#include "gui/library/library_scanner.h"

#include <QElapsedTimer>
#include <utility>

namespace palpate::gui {
namespace {

constexpr std::size_t kPortion = 200;  // entries that the window takes at once
constexpr qint64 kTellAfterMs = 50;    // fewer of them, once this has passed since the last portion

}  // namespace

std::string caseFolded(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()))
      .toCaseFolded()
      .toStdString();
}

LibraryScanner::LibraryScanner(const QString& cacheFolder, Catalog catalog, QObject* parent)
    : QObject(parent), cacheFolder_(cacheFolder), catalog_(std::move(catalog)) {
  connect(&work_, &Abandonable::progressed, this, &LibraryScanner::progressed);
}

void LibraryScanner::scan(const QString& folder) {
  work_.start(
      [this,
       catalog = catalog_,
       root = std::filesystem::path(folder.toStdString()),
       cache = std::filesystem::path(cacheFolder_.toStdString())](
          const Abandonable::Asker& asker) -> Abandonable::Take {
        std::vector<LibraryEntry> entries;
        QElapsedTimer told;
        const auto tell = [&] {
          if (entries.empty()) return;
          asker.tell([this, some = std::exchange(entries, {})] { emit found(some); });
          told.start();
        };
        CatalogSink sink;
        sink.listed = [&](std::size_t numFiles) {
          asker.tell([this, numFiles] { emit listed(static_cast<int>(numFiles)); });
        };
        sink.take = [&](RecordingDetails&& details) {
          LibraryEntry& entry = entries.emplace_back(LibraryEntry{std::move(details), {}});
          entry.text = searchableText(entry.details, root, caseFolded);
          if (entries.size() == kPortion || !told.isValid() || told.hasExpired(kTellAfterMs))
            tell();
        };
        const CatalogReport report = catalog(root, cache, sink, asker.progress);
        tell();
        return [this, report] { emit finished(report); };
      },
      [this](const QString& message) { emit failed(message); });
}

void LibraryScanner::cancel() {
  if (!busy()) return;
  work_.abandon();
  emit cancelled();
}

}  // namespace palpate::gui
