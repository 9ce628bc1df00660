#include "gui/widgets/number_field.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStyle>
#include <QToolTip>
#include <cmath>
#include <optional>
#include <utility>

#include "palpate/core/number_text.h"

#include "gui/widgets/keep_keys.h"

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

QString written(const QSpinBox& field) { return QString::number(field.value()); }

QString written(const QDoubleSpinBox& field) {
  return QString::fromStdString(fixedText(field.value(), field.decimals()));
}

template <class Field>
RefusedNumber* refusedBy(Field& field) {
  auto* refused = new RefusedNumber(field);
  QObject::connect(&field, &Field::valueChanged, refused, &RefusedNumber::end);
  return refused;
}

void setUp(QAbstractSpinBox& field) {
  field.setButtonSymbols(QAbstractSpinBox::NoButtons);
  field.setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  // Only finished input moves the playback.
  field.setKeyboardTracking(false);
  field.setFocusPolicy(Qt::ClickFocus);
  // With Ctrl in larger steps.
  keepKeys(
      field,
      {Qt::Key_Escape, Qt::Key_Up, Qt::Key_Down, Qt::CTRL | Qt::Key_Up, Qt::CTRL | Qt::Key_Down});
}

}  // namespace

RefusedNumber::RefusedNumber(QAbstractSpinBox& field) : QObject(&field), field_(field) {
  connect(field.findChild<QLineEdit*>(), &QLineEdit::textEdited, this, &RefusedNumber::end);
  // After the value has changed.
  connect(&field, &QAbstractSpinBox::editingFinished, this, &RefusedNumber::tell);
  constexpr int kMarkedMs = 10'000;
  timer_.setSingleShot(true);
  timer_.setInterval(kMarkedMs);
  connect(&timer_, &QTimer::timeout, this, &RefusedNumber::end);
}

void RefusedNumber::keep(const QString& typed, double least, double most) {
  const QString text = typed.trimmed();
  const auto number = numberFieldNumberIn(text);
  constexpr int kDigits = 10;
  if (text.isEmpty())
    why_ = "no number";
  else if (!number)
    why_ = text + " is not a number";
  else if (*number >= least && *number <= most)
    why_ = text + " is not a whole number";
  else
    why_ = text + " is out of " + QString::number(least, 'g', kDigits) + " .. " +
           QString::number(most, 'g', kDigits) + saidUnit_;
}

void RefusedNumber::tell() {
  if (why_.isEmpty()) return;
  const QString name = field_.accessibleName();
  const QString stays = field_.text().isEmpty() ? "nothing changes" : field_.text() + " stays";
  const QString what = (name.isEmpty() ? "" : name + ": ") + std::exchange(why_, {}) + "; " + stays;
  if (!marked_) usualToolTip_ = field_.toolTip();
  marked_ = true;
  timer_.start();
  field_.setToolTip(what);
  showMark(true);
  if (receivers(SIGNAL(changed(QString))) > 0)
    emit changed(what);
  else if (field_.isVisible())
    QToolTip::showText(field_.mapToGlobal(QPoint(0, field_.height() / 2)), what, &field_);
}

void RefusedNumber::showMark(bool on) {
  field_.setProperty("refused", on);
  field_.style()->polish(&field_);
  // The text is that of the line within, which would keep the bold font of the mark.
  if (!on) field_.findChild<QLineEdit*>()->setFont({});
}

void RefusedNumber::end() {
  why_.clear();
  if (!marked_) return;
  marked_ = false;
  timer_.stop();
  field_.setToolTip(usualToolTip_);
  showMark(false);
  emit changed({});
}

FrameField::FrameField(QWidget* parent) : QSpinBox(parent), refused_(refusedBy(*this)) {
  setUp(*this);
}

QValidator::State FrameField::validate(QString& text, int& /*position*/) const {
  return stateOf(*this, text, true);
}

void FrameField::fixup(QString& text) const {
  refused_->keep(text, minimum(), maximum());
  text = written(*this);
}

int FrameField::valueFromText(const QString& text) const {
  return static_cast<int>(numberFieldNumberIn(text).value_or(value()));
}

void FrameField::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Escape) return QSpinBox::keyPressEvent(event);
  refused_->end();
  lineEdit()->setText(written(*this));
  clearFocus();
}

SecondsField::SecondsField(QWidget* parent) : QDoubleSpinBox(parent), refused_(refusedBy(*this)) {
  setUp(*this);
}

void SecondsField::setPlaceholder(const QString& text) {
  placeholder_ = text;
  lineEdit()->setPlaceholderText(text);
  const QSignalBlocker quiet(lineEdit());
  lineEdit()->setText(textFromValue(value()));
}

QValidator::State SecondsField::validate(QString& text, int& /*position*/) const {
  return stateOf(*this, text, false);
}

void SecondsField::fixup(QString& text) const {
  // What the field shows in place of the least value was not typed.
  const bool typed =
      value() != minimum() || (text != textFromValue(value()) && text != specialValueText());
  if (typed) refused_->keep(text, minimum(), maximum());
  text = written(*this);
}

double SecondsField::valueFromText(const QString& text) const {
  return numberFieldNumberIn(text).value_or(value());
}

QString SecondsField::textFromValue(double value) const {
  if (!placeholder_.isEmpty() && value == minimum()) return {};
  return QDoubleSpinBox::textFromValue(value);
}

void SecondsField::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Escape) return QDoubleSpinBox::keyPressEvent(event);
  refused_->end();
  lineEdit()->setText(placeholder_.isEmpty() ? written(*this) : textFromValue(value()));
  clearFocus();
}

}  // namespace palpate::gui
