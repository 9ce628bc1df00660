#include "gui/filter/filter_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

using FilterFormKind = FilterOption::Kind;

constexpr int kDecimals = 4;

QLabel* filterFormCaption(const QString& text, QWidget* parent) {
  return makeLabel(parent, {}, "muted", text);
}

QString wordOf(const FilterOption& option) {
  return QString::fromStdString(option.key).replace('_', ' ');
}

QString filterFormRangeOf(const FilterOption& option) {
  QString text = QString::fromStdString(numberText(option.minimum)) + "–" +
                 QString::fromStdString(numberText(option.maximum));
  if (option.kind == FilterFormKind::kOdd) text += ", odd";
  return text;
}

bool isFrequency(const FilterOption& option) { return option.unit == "Hz"; }

// A frequency can't be filtered at or above half of the rate of the frames [Hz].
QString frequencyRangeOf(const FilterOption& option, double rateHz) {
  if (!(rateHz > 0.0) || rateHz / 2.0 > option.maximum) return filterFormRangeOf(option);
  return QString::fromStdString(numberText(option.minimum)) + " to below " +
         figure(rateHz / 2.0, 2);
}

QString suffixOf(const FilterOption& option) {
  return option.unit.empty() ? QString() : " " + QString::fromStdString(option.unit);
}

// The start value of an option when the user switches it from automatic to manual.
double firstValue(const FilterOption& option) {
  return std::clamp(1.0, option.minimum, option.maximum);
}

}  // namespace

FilterForm::FilterForm(QWidget* parent) : QWidget(parent) {
  about_ = filterFormCaption({}, this);
  about_->setObjectName("filterAbout");
  about_->setWordWrap(true);
  setLayout(inColumn({about_}));
}

void FilterForm::setMatrixNames(const QStringList& shortNames) {
  if (shortNames == matrixNames_) return;
  matrixNames_ = shortNames;
  kind_.clear();
}

void FilterForm::setRate(double rateHz) {
  rateHz_ = rateHz;
  for (const Frequency& frequency : frequencies_) showRange(frequency);
}

void FilterForm::showRange(const Frequency& frequency) const {
  const QString range = frequencyRangeOf(frequency.option, rateHz_);
  frequency.range->setText(range);
  frequency.field->setToolTip(
      QString::fromStdString(frequency.option.purpose) + "\n" + range +
      (rateHz_ > 0.0 ? ", half of the " + figure(rateHz_, 2) + " frames/s" : QString()) +
      "; change it with the arrow keys or the wheel");
}

void FilterForm::showStep(const FilterStep* step) {
  if (step == nullptr) {
    frequencies_.clear();
    delete fields_;
    fields_ = nullptr;
    kind_.clear();
    about_->clear();
    return;
  }
  if (kind_ != step->name) build(step->kind());
  for (const auto& show : show_) show(*step);
}

void FilterForm::build(const FilterKind& kind) {
  frequencies_.clear();
  delete fields_;
  show_.clear();
  matrices_.clear();
  kind_ = kind.name;
  fields_ = new QWidget(this);
  auto* grid = new QGridLayout(fields_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(2, 1);
  int row = 0;
  for (const FilterOption& option : kind.options) addField(*grid, row++, option);
  addMatrices(*grid, row);
  static_cast<QBoxLayout*>(layout())->insertWidget(0, fields_);
  about_->setText(QString::fromStdString(kind.purpose) +
                  "\nBorder: " + QString::fromStdString(kind.border) +
                  ".\nSource: " + QString::fromStdString(kind.source) + ".");
}

void FilterForm::addField(QGridLayout& grid, int row, const FilterOption& option) {
  const QString tip = QString::fromStdString(option.purpose);
  const QString rangeTip =
      option.kind == FilterFormKind::kFlag || option.kind == FilterFormKind::kChoice
          ? QString()
          : filterFormRangeOf(option) + "; change it with the arrow keys or the wheel";
  const std::string key = option.key;
  auto* name = new QLabel(wordOf(option), fields_);
  name->setToolTip(tip);
  grid.addWidget(name, row, 0);
  QWidget* field = nullptr;
  switch (option.kind) {
    case FilterFormKind::kFlag: {
      auto* box = new QCheckBox(fields_);
      connect(box, &QCheckBox::toggled, this, [this, key](bool on) {
        emit optionChosen(key, on ? 1.0 : 0.0);
      });
      show_.push_back([box, key](const FilterStep& step) {
        const QSignalBlocker blocker(box);
        box->setChecked(step.flag(key));
      });
      auto* words = filterFormCaption(tip, fields_);
      words->setWordWrap(true);
      words->setMinimumWidth(0);
      grid.addWidget(words, row, 1, 1, 2);
      // A check box is in front of its text, so that the separate label is not needed.
      name->hide();
      box->setText(wordOf(option));
      grid.addWidget(box, row, 0);
      field = box;
      break;
    }
    case FilterFormKind::kChoice: {
      auto* box = new QComboBox(fields_);
      for (const std::string& choice : option.choices) box->addItem(QString::fromStdString(choice));
      connect(box, &QComboBox::activated, this, [this, key](int index) {
        emit optionChosen(key, index);
      });
      show_.push_back([box, key](const FilterStep& step) {
        const QSignalBlocker blocker(box);
        box->setCurrentIndex(step.integer(key));
      });
      grid.addWidget(box, row, 1);
      field = box;
      break;
    }
    case FilterFormKind::kInteger:
    case FilterFormKind::kOdd: {
      auto* box = new QSpinBox(fields_);
      const bool odd = option.kind == FilterFormKind::kOdd;
      box->setRange(static_cast<int>(option.minimum), static_cast<int>(option.maximum));
      box->setSingleStep(odd ? 2 : 1);
      box->setButtonSymbols(QAbstractSpinBox::NoButtons);
      box->setSuffix(suffixOf(option));
      box->setKeyboardTracking(false);
      connect(
          box, &QSpinBox::valueChanged, this, [this, key, odd, most = box->maximum()](int value) {
            emit optionChosen(key, odd && value % 2 == 0 ? std::min(value + 1, most) : value);
          });
      show_.push_back([box, key](const FilterStep& step) {
        const QSignalBlocker blocker(box);
        box->setValue(step.integer(key));
      });
      grid.addWidget(box, row, 1);
      grid.addWidget(filterFormCaption(filterFormRangeOf(option), fields_), row, 2);
      field = box;
      break;
    }
    case FilterFormKind::kReal: {
      auto* box = new QDoubleSpinBox(fields_);
      box->setDecimals(kDecimals);
      box->setButtonSymbols(QAbstractSpinBox::NoButtons);
      box->setRange(option.minimum, option.maximum);
      box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
      box->setSuffix(suffixOf(option));
      box->setKeyboardTracking(false);
      connect(box, &QDoubleSpinBox::valueChanged, this, [this, key](double value) {
        emit optionChosen(key, value);
      });
      QCheckBox* automatic = nullptr;
      if (option.automatic()) {
        automatic = new QCheckBox("automatic", fields_);
        automatic->setToolTip(tip);
        connect(
            automatic, &QCheckBox::toggled, this, [this, key, first = firstValue(option)](bool on) {
              emit optionChosen(key, on ? std::numeric_limits<double>::quiet_NaN() : first);
            });
        grid.addWidget(automatic, row, 2);
      } else {
        auto* range = filterFormCaption(filterFormRangeOf(option), fields_);
        grid.addWidget(range, row, 2);
        if (isFrequency(option)) frequencies_.push_back({option, range, box});
      }
      show_.push_back([box, automatic, key, option](const FilterStep& step) {
        const QSignalBlocker blocker(box);
        const double value = step.value(key);
        box->setEnabled(!std::isnan(value) && step.uses(option));
        box->setValue(std::isnan(value) ? box->minimum() : value);
        box->setSpecialValueText(std::isnan(value) ? "automatic" : QString());
        if (automatic == nullptr) return;
        const QSignalBlocker also(automatic);
        automatic->setChecked(std::isnan(value));
      });
      grid.addWidget(box, row, 1);
      field = box;
      break;
    }
  }
  field->setObjectName("option_" + QString::fromStdString(key));
  field->setToolTip(tip + "\n" + rangeTip);
  if (!frequencies_.empty() && frequencies_.back().field == field) showRange(frequencies_.back());
  field->setAccessibleName(wordOf(option));
}

void FilterForm::addMatrices(QGridLayout& grid, int row) {
  if (matrixNames_.size() < 2) return;
  grid.addWidget(new QLabel("matrices", fields_), row, 0);
  auto* line = new QWidget(fields_);
  auto* across = new QHBoxLayout(line);
  across->setContentsMargins(0, 0, 0, 0);
  across->setSpacing(2);
  for (const QString& name : matrixNames_) {
    auto* button = new QToolButton(line);
    button->setText(name);
    button->setCheckable(true);
    button->setToolTip("Filter this matrix");
    connect(button, &QToolButton::clicked, this, [this] {
      std::vector<std::size_t> chosen;
      for (std::size_t m = 0; m < matrices_.size(); ++m)
        if (matrices_[m]->isChecked()) chosen.push_back(m);
      // An empty list means all matrices. A filter for no matrix makes no sense, so that is stored
      // as all, too.
      if (chosen.size() == matrices_.size() || chosen.empty()) chosen.clear();
      showMatrices(chosen);
      emit matricesChosen(chosen);
    });
    across->addWidget(button);
    matrices_.push_back(button);
  }
  across->addStretch(1);
  grid.addWidget(line, row, 1, 1, 2);
  show_.push_back([this](const FilterStep& step) { showMatrices(step.matrices); });
}

void FilterForm::showMatrices(const std::vector<std::size_t>& matrices) {
  for (std::size_t m = 0; m < matrices_.size(); ++m)
    matrices_[m]->setChecked(matrices.empty() ||
                             std::binary_search(matrices.begin(), matrices.end(), m));
}

}  // namespace palpate::gui
