#include "gui/import/import_fields.h"

#include <QHeaderView>
#include <QSignalBlocker>

#include <palpate/core/number_text.h>

namespace palpate::gui {
namespace {

enum FieldColumn { kColumns, kScale, kOffset, kUnit, kNumFieldColumns };

QString numberOr(double value, double usual) {
  return value == usual ? QString() : QString::fromStdString(numberText(value));
}

}  // namespace

ImportFields::ImportFields(QWidget* parent) : QTableWidget(0, kNumFieldColumns, parent) {
  setObjectName("importFields");
  setHorizontalHeaderLabels({"Columns", "Scale", "Offset", "Unit"});
  horizontalHeader()->setSectionResizeMode(kColumns, QHeaderView::Stretch);
  setTabKeyNavigation(false);
  horizontalHeaderItem(kColumns)->setToolTip(
      "Empty: found by names. Otherwise NAME, A..B, #3..#86 (by position), left*, m{m}[{y}][{x}], "
      "or none");
  connect(this, &QTableWidget::cellChanged, this, [this] { emit edited(); });
}

void ImportFields::setHand(const HandDescription& hand) {
  ImportMapping now = mapping_;
  if (hand_.layout) readInto(now);
  hand_ = hand;
  mapping_ = now;
  fill();
}

void ImportFields::setMapping(const ImportMapping& mapping) {
  mapping_ = mapping;
  if (hand_.layout) fill();
}

void ImportFields::fill() {
  const QSignalBlocker blocked(this);
  const std::size_t numMatrices = hand_.layout->numMatrices();
  QStringList names{"All matrices"};
  for (std::size_t m = 0; m < numMatrices; ++m)
    names << QString::fromStdString(hand_.matrixName(m));
  names << "Joint angles"
        << "Temperatures";
  setRowCount(static_cast<int>(names.size()));
  setVerticalHeaderLabels(names);
  for (int row = 0; row < rowCount(); ++row)
    for (int column = 0; column < kNumFieldColumns; ++column)
      setItem(row, column, new QTableWidgetItem);
  const auto show = [this](int row, const QString& columns, const ValueMapping& values) {
    item(row, kColumns)->setText(columns);
    item(row, kScale)->setText(numberOr(values.scale, 1.0));
    item(row, kOffset)->setText(numberOr(values.offset, 0.0));
    item(row, kUnit)->setText(QString::fromStdString(values.unit));
  };
  for (const MatrixMapping& each : mapping_.matrices) {
    const std::size_t row = each.matrix ? *each.matrix + 1 : 0;
    if (row <= numMatrices)
      show(static_cast<int>(row), QString::fromStdString(each.columns), each.values);
  }
  const int angles = static_cast<int>(numMatrices) + 1;
  show(angles, QString::fromStdString(mapping_.angles.columns), mapping_.angles.values);
  show(angles + 1,
       QString::fromStdString(mapping_.temperatures.columns),
       mapping_.temperatures.values);
  // What the hand lacks is absent; with one matrix a row for all would say the same.
  for (int row = 0; row < rowCount(); ++row) setRowHidden(row, false);
  setRowHidden(1, numMatrices == 1);
  setRowHidden(angles, hand_.axes.empty());
  setRowHidden(angles + 1, hand_.temperatureSensors.empty());
}

QString ImportFields::cellText(int row, int column) const {
  const QTableWidgetItem* cell = item(row, column);
  return cell ? cell->text().trimmed() : QString();
}

void ImportFields::readInto(ImportMapping& mapping) const {
  if (!hand_.layout) return;
  const auto numMatrices = static_cast<int>(hand_.layout->numMatrices());
  const auto valuesOf = [this](int row) {
    ValueMapping values;
    values.scale = parseDouble(cellText(row, kScale).toStdString()).value_or(1.0);
    values.offset = parseDouble(cellText(row, kOffset).toStdString()).value_or(0.0);
    values.unit = cellText(row, kUnit).toStdString();
    return values;
  };
  const std::vector<MatrixMapping> before = std::move(mapping.matrices);
  mapping.matrices.clear();
  for (int row = 0; row <= numMatrices; ++row) {
    MatrixMapping each;
    each.columns = cellText(row, kColumns).toStdString();
    if (each.columns.empty() || (numMatrices == 1 && row == 1)) continue;
    if (row > 0) each.matrix = static_cast<std::size_t>(row - 1);
    each.values = valuesOf(row);
    // The order of a preset is kept; the table does not show it.
    for (const MatrixMapping& old : before)
      if (old.matrix == each.matrix && old.columns == each.columns)
        each.columnByColumn = old.columnByColumn;
    mapping.matrices.push_back(each);
  }
  mapping.angles.columns = cellText(numMatrices + 1, kColumns).toStdString();
  mapping.angles.values = valuesOf(numMatrices + 1);
  mapping.temperatures.columns = cellText(numMatrices + 2, kColumns).toStdString();
  mapping.temperatures.values = valuesOf(numMatrices + 2);
}

QString ImportFields::problem() const {
  for (int row = 0; row < rowCount(); ++row)
    for (const int column : {kScale, kOffset}) {
      const QString text = cellText(row, column);
      const auto value = parseDouble(text.toStdString());
      const QString what = verticalHeaderItem(row)->text() + ": \"" + text + "\"";
      if (!text.isEmpty() && !value) return what + " is not a number";
      if (column == kScale && value == 0.0) return what + " would make every value the same";
    }
  return {};
}

}  // namespace palpate::gui
