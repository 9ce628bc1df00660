// The grasps of the training folder as a table: object, recording, number, time and quality of
// each, and its features. A check mark says whether a grasp trains. Rows are those of the feature
// table.
#pragma once

#include <QAbstractTableModel>
#include <QStringList>
#include <memory>
#include <vector>

#include <palpate/core/text_table.h>
#include <palpate/recognition/feature_table.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

// "closing_mm in mm", or the name alone of a feature without unit.
QString featureLabel(FeatureSet set, const std::string& name);

class GraspTableModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { kObject, kRecording, kNumber, kTime, kQuality, kFirstFeature };
  // The value of a cell to sort by.
  static constexpr int kSortRole = Qt::UserRole + 1;

  using QAbstractTableModel::QAbstractTableModel;
  // Null: no table. `leftOut`: for each row, whether it is left out.
  void setTable(const std::shared_ptr<const FeatureTable>& table, std::vector<bool> leftOut);
  void setLeftOut(std::vector<bool> leftOut);
  const std::shared_ptr<const FeatureTable>& table() const noexcept { return table_; }
  bool isLeftOut(int row) const { return leftOut_.at(static_cast<std::size_t>(row)); }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
  // The user wants a grasp left out, or taken in again.
  void leavingOutAsked(int row, bool out);

 private:
  QString text(const FeatureRow& row, int column) const;

  std::shared_ptr<const FeatureTable> table_;
  std::vector<bool> leftOut_;
};

// These rows of a feature table with all their columns, times in UTC.
TextTable graspTextTable(const std::shared_ptr<const FeatureTable>& table,
                         const std::vector<bool>& leftOut,
                         const std::vector<int>& rows);

}  // namespace palpate::gui
