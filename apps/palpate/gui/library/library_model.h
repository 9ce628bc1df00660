// The table model of the library: one row for each recording of a folder; and the filter that
// searches and sorts its rows.
#pragma once

#include <QAbstractTableModel>
#include <QSortFilterProxyModel>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/library/library_scanner.h"

namespace palpate::gui {

class LibraryModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column {
    kName,
    kLength,
    kDate,
    kObject,
    kOperator,
    kRun,
    kLabels,
    kNotes,
    kFolder,
    kNumColumns
  };
  using QAbstractTableModel::QAbstractTableModel;

  // Empties the table; shown folder names are relative to `folder`.
  void setFolder(const QString& folder);
  // Between beginScan() and endScan(), take() replaces the entries of the same files; endScan()
  // removes the rows that were not taken again.
  void beginScan();
  void take(const std::vector<LibraryEntry>& entries);
  void endScan();
  // Marks a recording as damaged: a scan doesn't read its frames, but they were read since. It
  // counts as long as the file isn't changed.
  void setDamaged(const std::filesystem::path& path, const std::string& message);

  std::size_t numRecordings() const noexcept { return rows_.size(); }
  const LibraryEntry& entry(int row) const { return rows_.at(static_cast<std::size_t>(row)).entry; }
  QString path(int row) const;
  // Total length of all recordings [s].
  double totalS() const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  // Rows can be dragged to other programs as files.
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QModelIndexList& indexes) const override;

 private:
  struct Row {
    LibraryEntry entry;
    // Found by the running scan.
    bool seen = true;
  };
  QString text(const RecordingDetails& details, int column) const;
  QString tip(const RecordingDetails& details) const;

  struct Damage {
    std::string message;
    // RecordingDetails::changedUs of the file that was read; nothing: not known yet.
    std::optional<std::int64_t> changedUs;
  };
  // Sets the state of a row that is known to be damaged; true: it is one.
  bool applyDamage(LibraryEntry& entry);

  std::vector<Row> rows_;
  std::map<std::filesystem::path, Damage> damaged_;
  std::map<std::filesystem::path, int> rowOf_;
  std::string folder_;
};

// The rows of the model that match the search, in the chosen order.
class LibraryFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  explicit LibraryFilter(LibraryModel& model, QObject* parent = nullptr);
  void setSearch(const QString& text);
  bool searching() const noexcept { return !search_.empty(); }
  const RecordingSearch& search() const noexcept { return search_; }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;

 private:
  LibraryModel& model_;
  RecordingSearch search_;
};

// A duration as text: "4.2 s", "3 min 05 s", "2 h 07 min".
QString lengthText(double seconds);

}  // namespace palpate::gui
