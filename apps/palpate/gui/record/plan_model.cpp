#include "gui/record/plan_model.h"

#include <QFont>
#include <algorithm>

#include <palpate/core/error.h>
#include <palpate/core/escaped_line.h>
#include <palpate/core/number_text.h>

namespace palpate::gui {
namespace {

QString planText(const std::string& text) { return QString::fromStdString(text); }

// What is to be done about the newest take, and its name: the end of a long text may be cut.
QString stateOfRow(const PlanRow& row) {
  if (row.takes.empty()) return {};
  const PlannedTake& newest = row.takes.back();
  const QString name = planText(newest.file.filename().string());
  const QString of = " · " + name;
  if (newest.rejected)
    return (row.numDone() < row.repetitions ? "to be repeated" : "rejected") + of;
  if (!newest.problem.empty())
    return (newest.undecided() ? "to be decided: " : "") + planText(newest.problem) + of;
  return row.numUndecided() > 0 ? "decide on an earlier take first" + of : name;
}

}  // namespace

PlanModel::PlanModel(PlanController& controller, QObject* parent)
    : QAbstractTableModel(parent), controller_(controller) {
  follow();
  connect(&controller, &PlanController::changed, this, &PlanModel::follow);
}

// Keeps the selection and an open editor where the number of rows stays.
void PlanModel::follow() {
  const int now = static_cast<int>(controller_.plan().rows().size());
  if (now == numRows_) {
    if (now > 0) emit dataChanged(index(0, 0), index(now - 1, kNumColumns - 1));
    return;
  }
  beginResetModel();
  numRows_ = now;
  endResetModel();
}

int PlanModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : numRows_; }

int PlanModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : kNumColumns;
}

QVariant PlanModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const auto at = static_cast<std::size_t>(index.row());
  const PlanRow& row = controller_.plan().rows().at(at);
  if (role == Qt::FontRole) {
    const auto next = controller_.plan().next();
    QFont font;
    font.setBold(next && next->row == at);
    return font;
  }
  if (role != Qt::DisplayRole && role != Qt::EditRole && role != Qt::ToolTipRole) return {};
  switch (index.column()) {
    case kObject:
      return planText(row.object);
    case kRun:
      return planText(row.run);
    case kRepetitions:
      return QString::number(row.repetitions);
    case kNotes:
      return planText(row.notes);
    case kDone:
      return QString("%1 of %2").arg(row.numDone()).arg(row.repetitions);
    default:
      return stateOfRow(row);
  }
}

QVariant PlanModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  static const QStringList names = {"Object", "Run", "Repetitions", "Notes", "Done", "Last take"};
  return names.value(section);
}

Qt::ItemFlags PlanModel::flags(const QModelIndex& index) const {
  const Qt::ItemFlags usual = QAbstractTableModel::flags(index);
  return index.column() <= kNotes && !controller_.importing() ? usual | Qt::ItemIsEditable : usual;
}

bool PlanModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid() || role != Qt::EditRole || index.column() > kNotes) return false;
  if (controller_.importing()) {
    emit refused("a table is being read in place of the plan");
    return false;
  }
  const auto at = static_cast<std::size_t>(index.row());
  PlanRow row = controller_.plan().rows().at(at);
  const std::string text = value.toString().trimmed().toStdString();
  try {
    switch (index.column()) {
      case kObject:
        row.object = text;
        break;
      case kRun:
        row.run = text;
        break;
      case kNotes:
        row.notes = text;
        break;
      default: {
        const auto number = parseInteger(text);
        if (!number) throw Error("repetitions: '" + escapedLine(text) + "' is not a whole number");
        row.repetitions = static_cast<int>(
            std::clamp<std::int64_t>(*number, 0, RecordingPlan::kMaxRepetitions + 1));
      }
    }
    controller_.setRow(at, row);
    emit refused({});
    return true;
  } catch (const Error& error) {
    emit refused(QString("row %1, ").arg(index.row() + 1) + QString::fromUtf8(error.what()));
    return false;
  }
}

}  // namespace palpate::gui
