// The page of the Batch dialog with what became of each recording: what failed and why, or all.
#pragma once

#include <QAbstractTableModel>
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "gui/batch/batch_controller.h"

class QCheckBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class Ask;
class RowsTable;

class BatchResultsModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  using QAbstractTableModel::QAbstractTableModel;
  // Shows the recordings that failed or were done in part, or all.
  void show(std::shared_ptr<const BatchOutcome> outcome, bool all);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  // The recording of a row.
  QString source(int row) const;

 private:
  std::shared_ptr<const BatchOutcome> outcome_;
  std::vector<std::size_t> rows_;
};

class BatchResults : public QWidget {
  Q_OBJECT
 public:
  explicit BatchResults(Ask& ask, QWidget* parent = nullptr);
  // A batch begins: the table keeps what the one before has made, and says so.
  void begin();
  void show(const std::shared_ptr<const BatchOutcome>& outcome);
  // Copies the selected rows, or all when none is selected, for a spreadsheet.
  void copyRows();
  // Writes the report of all recordings, as --report of the commands.
  void saveReport();

  // Shows a file in the file manager.
  std::function<void(const QString& path)> reveal;

 signals:
  // What was copied or saved, or why not.
  void said(const QString& text);

 private:
  void fill();

  Ask& ask_;
  std::shared_ptr<const BatchOutcome> outcome_;
  bool running_ = false;
  BatchResultsModel* model_;
  QLabel* summary_;
  RowsTable* table_;
  QCheckBox* all_;
  QPushButton* copy_;
  QPushButton* save_;
  QPushButton* show_;
};

}  // namespace palpate::gui
