#include "gui/widgets/value_slider.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"

namespace palpate::gui {
namespace {
// All fields are as wide as with this unit, because several sliders are arranged below each other.
constexpr const char* kWidestUnit = "counts";

class UnitLabel : public QLabel {
 public:
  UnitLabel(const QString& unit, QWidget* parent) : QLabel(unit, parent) {
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  }
  QSize sizeHint() const override {
    return {fontMetrics().horizontalAdvance(kWidestUnit), QLabel::sizeHint().height()};
  }
  QSize minimumSizeHint() const override { return sizeHint(); }
};
}  // namespace

ValueSlider::ValueSlider(const QString& name, const SliderRange& range, QWidget* parent)
    : QWidget(parent), range_(range) {
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setAccessibleName(name);
  slider_->setRange(ticksOf(range.least), ticksOf(range.sliderMost));
  slider_->setPageStep(5);
  slider_->setMinimumWidth(48);
  field_ = new SecondsField(this);
  field_->setAccessibleName(name);
  field_->setDecimals(range.decimals);
  field_->setRange(range.least, range.most);
  field_->setSingleStep(range.step);
  field_->setFocusPolicy(Qt::StrongFocus);
  if (!range.saidUnit.isEmpty())
    field_->refused().setSaidUnit(range.saidUnit);
  else if (!range.unit.trimmed().isEmpty())
    field_->refused().setSaidUnit(" " + range.unit);
  auto* row = inRow({{slider_, 1}, field_});
  setLayout(row);
  if (!range.unit.isEmpty()) {
    auto* unit = new UnitLabel(range.unit, this);
    unit->setProperty("role", "muted");
    row->addWidget(unit);
  }
  connect(slider_, &QSlider::valueChanged, this, [this](int ticks) {
    field_->refused().end();
    const QSignalBlocker quiet(field_);
    field_->setValue(range_.least + ticks * range_.step - ticksOf(range_.least) * range_.step);
    // Changed by keys.
    if (!slider_->isSliderDown()) choose();
  });
  connect(slider_, &QSlider::sliderReleased, this, &ValueSlider::choose);
  connect(field_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    const QSignalBlocker quiet(slider_);
    slider_->setValue(ticksOf(value));
    choose();
  });
  auto* line = field_->findChild<QLineEdit*>();
  connect(line, &QLineEdit::textEdited, this, [this](QString text) {
    bool isNumber = false;
    text.replace(',', '.').toDouble(&isNumber);
    edited_ = differing_ && isNumber;
  });
  // Escape discards it.
  connect(line, &QLineEdit::textChanged, this, [this](const QString& text) {
    if (text.isEmpty()) edited_ = false;
  });
  connect(field_, &QDoubleSpinBox::editingFinished, this, [this] {
    if (!std::exchange(edited_, false) || field_->refused().marked()) return;
    // The least value was typed: for the field that is no change.
    if (field_->value() != range_.least || shown_ != range_.least) return;
    differing_ = false;
    field_->setPlaceholder({});
    emit chosen(shown_);
  });
  shown_ = range.least;
}

QDoubleSpinBox* ValueSlider::field() const noexcept { return field_; }

int ValueSlider::ticksOf(double value) const {
  return static_cast<int>(std::lround(value / range_.step));
}

double ValueSlider::value() const { return field_->value(); }

void ValueSlider::showValue(double value) {
  if (slider_->isSliderDown() || field_->hasFocus()) return;
  // Nothing new is shown: the field would paint itself nevertheless.
  const double rounded = QString::number(value, 'f', field_->decimals()).toDouble();
  if (rounded == field_->value() && field_->value() == shown_ &&
      slider_->value() == std::clamp(ticksOf(value), slider_->minimum(), slider_->maximum()) &&
      field_->specialValueText().isEmpty() && !differing_)
    return;
  const QSignalBlocker quietField(field_);
  const QSignalBlocker quietSlider(slider_);
  if (!field_->specialValueText().isEmpty()) field_->setSpecialValueText({});
  if (differing_) field_->setPlaceholder({});
  differing_ = false;
  field_->setValue(value);
  slider_->setValue(ticksOf(value));
  shown_ = field_->value();
}

void ValueSlider::showUnknown() {
  showValue(range_.least);
  // Shown in place of the least value.
  field_->setSpecialValueText("–");
}

void ValueSlider::showDiffering() {
  if (slider_->isSliderDown() || field_->hasFocus()) return;
  if (differing_ && field_->value() == range_.least && slider_->value() == slider_->minimum())
    return;
  showValue(range_.least);
  differing_ = true;
  edited_ = false;
  field_->setPlaceholder("differ");
}

void ValueSlider::choose() {
  if (field_->value() == shown_) return;
  shown_ = field_->value();
  emit chosen(shown_);
}

}  // namespace palpate::gui
