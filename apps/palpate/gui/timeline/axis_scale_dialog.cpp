#include "gui/timeline/axis_scale_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace palpate::gui {
namespace {

constexpr double kLargestOnAxis = 1e9;

QDoubleSpinBox* axisField(const QString& name, const QString& unit, double value, QWidget* parent) {
  auto* field = new QDoubleSpinBox(parent);
  field->setObjectName(name + "_" + unit);
  field->setAccessibleName((name == "low" ? "Lower end in " : "Upper end in ") + unit);
  field->setDecimals(3);
  field->setRange(-kLargestOnAxis, kLargestOnAxis);
  field->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  field->setKeyboardTracking(false);
  field->setMaximumWidth(field->fontMetrics().horizontalAdvance("-00000000.000") + 40);
  field->setValue(value);
  return field;
}

}  // namespace

AxisScaleDialog::AxisScaleDialog(const QStringList& units,
                                 const AxisScales& scales,
                                 const std::map<QString, std::pair<double, double>>& seen,
                                 QWidget* parent)
    : QDialog(parent), scales_(scales) {
  setWindowTitle("Vertical axes of the timeline");
  auto* grid = new QGridLayout;
  int row = 0;
  const QStringList headings = {"unit", "", "from", "to", ""};
  for (int i = 0; i < headings.size(); ++i) grid->addWidget(new QLabel(headings[i], this), row, i);
  for (const QString& unit : units) {
    ++row;
    AxisScale start = scales_.contains(unit) ? scales_.at(unit) : AxisScale{};
    if (const auto found = seen.find(unit); start.automatic && found != seen.end()) {
      start.low = found->second.first;
      start.high = found->second.second;
    }
    grid->addWidget(new QLabel(unit, this), row, 0);
    auto* automatic = new QCheckBox("automatic", this);
    automatic->setObjectName("automatic_" + unit);
    automatic->setToolTip("The axis fits its curves");
    automatic->setChecked(start.automatic);
    QDoubleSpinBox* low = axisField("low", unit, start.low, this);
    QDoubleSpinBox* high = axisField("high", unit, start.high, this);
    auto* log = new QCheckBox("logarithmic", this);
    log->setObjectName("log_" + unit);
    log->setToolTip("Values of 0 and below lie under the axis");
    log->setChecked(start.logarithmic);
    grid->addWidget(automatic, row, 1);
    grid->addWidget(low, row, 2);
    grid->addWidget(high, row, 3);
    grid->addWidget(log, row, 4);
    const auto take = [=, this] {
      for (QDoubleSpinBox* field : {low, high}) field->setEnabled(!automatic->isChecked());
      // The field that was changed last keeps its value.
      if (!(low->value() < high->value())) {
        const bool lowChanged = low->hasFocus();
        const QSignalBlocker one(low), other(high);
        if (lowChanged)
          high->setValue(low->value() + 1.0);
        else
          low->setValue(high->value() - 1.0);
      }
      put(unit, {automatic->isChecked(), low->value(), high->value(), log->isChecked()});
    };
    for (QDoubleSpinBox* field : {low, high}) {
      field->setEnabled(!start.automatic);
      connect(field, &QDoubleSpinBox::valueChanged, this, take);
    }
    for (QCheckBox* box : {automatic, log}) connect(box, &QCheckBox::toggled, this, take);
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* page = new QVBoxLayout(this);
  page->addLayout(grid);
  page->addStretch(1);
  page->addWidget(buttons);
}

void AxisScaleDialog::put(const QString& unit, const AxisScale& scale) {
  if (scale.automatic && !scale.logarithmic)
    scales_.erase(unit);
  else
    scales_[unit] = scale;
  emit changed();
}

}  // namespace palpate::gui
