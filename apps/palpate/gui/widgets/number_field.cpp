#include "gui/widgets/number_field.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStyle>
#include <algorithm>
#include <cmath>
#include <optional>

#include "palpate/core/number_text.h"

namespace palpate::gui {
namespace {

std::optional<double> numberFieldNumberIn(const QString& text) {
  QString point = text;
  point.replace(',', '.');
  return parseDouble(point.toStdString());
}

// Any text is allowed while the user types; fixup() decides at the end.
template <class Field>
QValidator::State stateOf(const Field& field, const QString& text, bool whole) {
  const auto number = numberFieldNumberIn(text);
  const bool inRange = number && *number >= field.minimum() && *number <= field.maximum() &&
                       (!whole || *number == std::floor(*number));
  return inRange ? QValidator::Acceptable : QValidator::Intermediate;
}

QString written(const QSpinBox& field, double value) {
  return QString::number(std::lround(std::clamp(
      value, static_cast<double>(field.minimum()), static_cast<double>(field.maximum()))));
}

QString written(const QDoubleSpinBox& field, double value) {
  const double nearest = std::clamp(value, field.minimum(), field.maximum());
  return QString::fromStdString(fixedText(nearest, field.decimals()));
}

void setUp(QAbstractSpinBox& field) {
  field.setButtonSymbols(QAbstractSpinBox::NoButtons);
  field.setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  // Only finished input moves the playback.
  field.setKeyboardTracking(false);
  field.setFocusPolicy(Qt::ClickFocus);
}

// True for keys that belong to the field while it has the focus, although they are also shortcuts
// of the window.
bool keepsKey(QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride) return false;
  const int key = static_cast<QKeyEvent*>(event)->key();
  if (key != Qt::Key_Escape && key != Qt::Key_Up && key != Qt::Key_Down) return false;
  event->accept();
  return true;
}

}  // namespace

FrameField::FrameField(QWidget* parent) : QSpinBox(parent) { setUp(*this); }

QValidator::State FrameField::validate(QString& text, int& /*position*/) const {
  return stateOf(*this, text, true);
}

void FrameField::fixup(QString& text) const {
  text = written(*this, numberFieldNumberIn(text).value_or(value()));
}

int FrameField::valueFromText(const QString& text) const {
  return static_cast<int>(numberFieldNumberIn(text).value_or(value()));
}

bool FrameField::event(QEvent* event) { return keepsKey(event) || QSpinBox::event(event); }

void FrameField::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Escape) return QSpinBox::keyPressEvent(event);
  lineEdit()->setText(written(*this, value()));
  clearFocus();
}

SecondsField::SecondsField(QWidget* parent) : QDoubleSpinBox(parent) {
  setUp(*this);
  connect(lineEdit(), &QLineEdit::textEdited, this, [this] {
    outOfRange_.clear();
    endCorrection();
  });
  connect(this, &QDoubleSpinBox::valueChanged, this, &SecondsField::endCorrection);
  // After the value has changed.
  connect(this, &QDoubleSpinBox::editingFinished, this, &SecondsField::showCorrection);
}

void SecondsField::setPlaceholder(const QString& text) {
  placeholder_ = text;
  lineEdit()->setPlaceholderText(text);
  const QSignalBlocker quiet(lineEdit());
  lineEdit()->setText(textFromValue(value()));
}

void SecondsField::showCorrection() {
  if (outOfRange_.isEmpty()) return;
  const QString what = accessibleName() + ": " + outOfRange_ + " is out of " +
                       QString::number(minimum(), 'g', 10) + " .. " +
                       QString::number(maximum(), 'g', 10) + saidUnit_ + "; set to " +
                       QString::number(value(), 'g', 10);
  outOfRange_.clear();
  if (!corrected_) usualToolTip_ = toolTip();
  corrected_ = true;
  setToolTip(what);
  showMark(true);
  emit corrected(what);
}

void SecondsField::showMark(bool on) {
  setProperty("corrected", on);
  style()->polish(this);
  // The text is that of the line within, which would keep the bold font of the mark.
  if (!on) lineEdit()->setFont({});
}

void SecondsField::endCorrection() {
  if (!corrected_) return;
  corrected_ = false;
  setToolTip(usualToolTip_);
  showMark(false);
  emit corrected({});
}

QValidator::State SecondsField::validate(QString& text, int& /*position*/) const {
  return stateOf(*this, text, false);
}

void SecondsField::fixup(QString& text) const {
  const auto number = numberFieldNumberIn(text);
  if (number && (*number < minimum() || *number > maximum())) outOfRange_ = text.trimmed();
  text = written(*this, numberFieldNumberIn(text).value_or(value()));
}

double SecondsField::valueFromText(const QString& text) const {
  return numberFieldNumberIn(text).value_or(value());
}

QString SecondsField::textFromValue(double value) const {
  if (!placeholder_.isEmpty() && value == minimum()) return {};
  return QDoubleSpinBox::textFromValue(value);
}

bool SecondsField::event(QEvent* event) { return keepsKey(event) || QDoubleSpinBox::event(event); }

void SecondsField::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Escape) return QDoubleSpinBox::keyPressEvent(event);
  outOfRange_.clear();
  lineEdit()->setText(placeholder_.isEmpty() ? written(*this, value()) : textFromValue(value()));
  clearFocus();
}

}  // namespace palpate::gui
