// The recordings of a folder as a table, a row each, and the part of it that a search leaves, in an
// order.
#pragma once

#include <QAbstractTableModel>
#include <QSortFilterProxyModel>
#include <filesystem>
#include <map>
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

  // Empties the table; names of folders count from `folder` on.
  void setFolder(const QString& folder);
  // What comes until endScan() replaces what was known of the same file; what doesn't come again
  // goes.
  void beginScan();
  void take(const std::vector<LibraryEntry>& entries);
  void endScan();
  void setTheme(Theme theme);

  std::size_t numRecordings() const noexcept { return rows_.size(); }
  const LibraryEntry& entry(int row) const { return rows_.at(static_cast<std::size_t>(row)).entry; }
  QString path(int row) const;
  double totalS() const;  // of all recordings

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  // Rows can be dragged away as files.
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QModelIndexList& indexes) const override;

 private:
  struct Row {
    LibraryEntry entry;
    bool seen = true;  // in the scan that runs
  };
  QString text(const RecordingDetails& details, int column) const;
  QString tip(const RecordingDetails& details) const;

  std::vector<Row> rows_;
  std::map<std::filesystem::path, int> rowOf_;
  std::string folder_;
  Theme theme_ = Theme::kDark;
};

class LibraryFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  explicit LibraryFilter(LibraryModel& model, QObject* parent = nullptr);
  void setSearch(const QString& text);
  bool searching() const noexcept { return !search_.empty(); }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;

 private:
  LibraryModel& model_;
  RecordingSearch search_;
};

// "4.2 s", "3 min 05 s", "2 h 07 min"
QString lengthText(double seconds);

}  // namespace palpate::gui
