#include "gui/recognise/grasp_table_model.h"

#include <QDateTime>
#include <QFont>
#include <utility>

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

struct GraspColumn {
  const char* name;
  const char* tip;
};
constexpr GraspColumn kGraspColumns[] = {
    {"object", "The folder of the recording. The mark: the grasp trains and tests"},
    {"recording", "Name of the file"},
    {"grasp", "Number of the grasp in its recording"},
    {"time", "When the grasp began, local time"},
    {"quality", "0..1: held steadily, complete, not saturated"}};

constexpr int kFeatureDigits = 4;

std::size_t featureOf(int column) {
  return static_cast<std::size_t>(column - GraspTableModel::kFirstFeature);
}

}  // namespace

QString featureLabel(FeatureSet set, const std::string& name) {
  const std::string_view unit = featureUnit(set, name);
  return QString::fromStdString(unit.empty() ? name : name + " in " + std::string(unit));
}

void GraspTableModel::setTable(const std::shared_ptr<const FeatureTable>& table,
                               std::vector<bool> leftOut) {
  beginResetModel();
  table_ = table;
  leftOut_ = std::move(leftOut);
  endResetModel();
}

void GraspTableModel::setLeftOut(std::vector<bool> leftOut) {
  leftOut_ = std::move(leftOut);
  if (rowCount() > 0) emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
}

int GraspTableModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() || !table_ ? 0 : static_cast<int>(table_->rows.size());
}

int GraspTableModel::columnCount(const QModelIndex& parent) const {
  if (parent.isValid()) return 0;
  return kFirstFeature + (table_ ? static_cast<int>(table_->names.size()) : 0);
}

QString GraspTableModel::text(const FeatureRow& row, int column) const {
  switch (column) {
    case kObject:
      return QString::fromStdString(row.className);
    case kRecording:
      return pathText(row.file.filename());
    case kNumber:
      return QString::number(row.number);
    case kTime:
      return QDateTime::fromMSecsSinceEpoch(row.timeUs / 1000).toString("yyyy-MM-dd HH:mm:ss");
    case kQuality:
      return figure(row.quality, 2);
    default:
      return QString::number(row.values.at(featureOf(column)), 'g', kFeatureDigits);
  }
}

QVariant GraspTableModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || !table_) return {};
  const FeatureRow& row = table_->rows.at(static_cast<std::size_t>(index.row()));
  const int column = index.column();
  const bool out = isLeftOut(index.row());
  const bool isText = column == kObject || column == kRecording || column == kTime;
  switch (role) {
    case Qt::DisplayRole:
      return text(row, column);
    case kSortRole:
      if (column == kNumber) return static_cast<qulonglong>(row.number);
      if (column == kTime) return static_cast<qlonglong>(row.timeUs);
      if (column == kQuality) return row.quality;
      if (isText) return text(row, column);
      return row.values.at(featureOf(column));
    case Qt::CheckStateRole:
      if (column != kObject) return {};
      return out ? Qt::Unchecked : Qt::Checked;
    case Qt::TextAlignmentRole:
      return QVariant((isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    case Qt::ForegroundRole:
      return out ? QVariant(colorsOf().muted) : QVariant();
    case Qt::ToolTipRole:
      return (column == kObject ? text(row, kObject) + "\n" : QString()) + pathText(row.file) +
             ", frames " + QString::number(row.begin) + "–" + QString::number(row.end) +
             (out ? "\nleft out: it neither trains nor tests" : "");
    default:
      return {};
  }
}

QVariant GraspTableModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (section < kFirstFeature) {
    const GraspColumn& column = kGraspColumns[section];
    if (role == Qt::DisplayRole) return QString(column.name);
    if (role == Qt::ToolTipRole) return QString(column.tip);
  } else if (table_ && featureOf(section) < table_->names.size() &&
             (role == Qt::DisplayRole || role == Qt::ToolTipRole)) {
    return featureLabel(table_->set, table_->names[featureOf(section)]);
  }
  if (role == Qt::TextAlignmentRole)
    return QVariant((section == kObject || section == kRecording || section == kTime
                         ? Qt::AlignLeft
                         : Qt::AlignRight) |
                    Qt::AlignVCenter);
  return {};
}

Qt::ItemFlags GraspTableModel::flags(const QModelIndex& index) const {
  const Qt::ItemFlags plain = QAbstractTableModel::flags(index);
  return index.column() == kObject ? plain | Qt::ItemIsUserCheckable : plain;
}

bool GraspTableModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (role != Qt::CheckStateRole || index.column() != kObject) return false;
  emit leavingOutAsked(index.row(), value.toInt() == Qt::Unchecked);
  return true;
}

TextTable graspTextTable(const std::shared_ptr<const FeatureTable>& table,
                         const std::vector<bool>& leftOut,
                         const std::vector<int>& rows) {
  TextTable text;
  if (!table) return text;
  text.header = {"object", "recording", "grasp", "begin", "end", "time", "quality", "trains"};
  for (const std::string& name : table->names) {
    const std::string_view unit = featureUnit(table->set, name);
    text.header.push_back(unit.empty() ? name : name + " [" + std::string(unit) + "]");
  }
  text.numRows = rows.size();
  text.row = [table, leftOut, rows](std::size_t i) {
    const auto at = static_cast<std::size_t>(rows.at(i));
    const FeatureRow& row = table->rows.at(at);
    std::vector<std::string> cells = {row.className,
                                      row.file.string(),
                                      std::to_string(row.number),
                                      std::to_string(row.begin),
                                      std::to_string(row.end),
                                      utcText(row.timeUs),
                                      numberText(row.quality),
                                      leftOut.at(at) ? "no" : "yes"};
    for (const double value : row.values) cells.push_back(numberText(value));
    return cells;
  };
  return text;
}

}  // namespace palpate::gui
