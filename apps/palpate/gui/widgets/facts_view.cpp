#include "gui/widgets/facts_view.h"

#include <QHelpEvent>
#include <QPaintEvent>
#include <QPainter>
#include <QRegularExpression>
#include <QToolTip>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr int kFactsViewPadding = 8;  // [px] above and below a row's text, together
constexpr int kSpacing = 12;          // [px] between name and value

// Whether a value is a number, with or without a unit.
bool isNumber(const QString& value) {
  static const QRegularExpression number("^[-+−]?\\d[\\d.]*( ?[^\\s\\d.]{1,6})?$");
  return number.match(value).hasMatch();
}

}  // namespace

FactsView::FactsView(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void FactsView::setFacts(std::vector<Fact> facts) {
  facts_ = std::move(facts);
  measure();
}

void FactsView::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) measure();
}

void FactsView::measure() {
  numberWidth_ = 0;
  for (const Fact& fact : facts_)
    if (isNumber(fact.value)) numberWidth_ = std::max(numberWidth_, textWidth(fact.value));
  describe();
  updateGeometry();
  update();
}

void FactsView::describe() {
  QStringList rows;
  for (const Fact& fact : facts_) rows << fact.name + ": " + fact.value;
  setAccessibleDescription(rows.join("\n"));
}

void FactsView::setValue(std::size_t row, const QString& value) {
  if (row >= facts_.size() || facts_[row].value == value) return;
  facts_[row].value = value;
  describe();
  if (const int needed = textWidth(value); needed > numberWidth_ && isNumber(value)) {
    numberWidth_ = needed;
    updateGeometry();
  }
  update(0, static_cast<int>(row) * rowHeight(), width(), rowHeight());
}

void FactsView::setStale(bool old) {
  if (old == stale_) return;
  stale_ = old;
  update();
}

int FactsView::rowHeight() const { return fontMetrics().height() + kFactsViewPadding; }

int FactsView::nameWidth() const {
  int widest = 0;
  for (const Fact& fact : facts_) widest = std::max(widest, textWidth(fact.name));
  return widest;
}

int FactsView::textWidth(const QString& text) const {
  return fontMetrics().horizontalAdvance(text);
}

int FactsView::wholeWidth() const { return nameWidth() + kSpacing + numberWidth_; }

Fact FactsView::shown(std::size_t row) const {
  Fact fact = facts_.at(row);
  const QFontMetrics metrics = fontMetrics();
  if (isNumber(fact.value)) {
    const int room = width() - kSpacing - textWidth(fact.value);
    fact.name = metrics.elidedText(fact.name, Qt::ElideRight, std::max(0, room));
  } else {
    const int room = width() - kSpacing - textWidth(fact.name);
    fact.value = metrics.elidedText(fact.value, Qt::ElideMiddle, room);
  }
  return fact;
}

QSize FactsView::sizeHint() const {
  return {nameWidth() + 140, rowHeight() * static_cast<int>(facts_.size())};
}

QSize FactsView::minimumSizeHint() const {
  return {nameWidth() + 50, rowHeight() * static_cast<int>(facts_.size())};
}

void FactsView::paintEvent(QPaintEvent* event) {
  const ThemeColors& colors = colorsOf();
  QPainter painter(this);
  const int height = rowHeight();
  for (std::size_t i = 0; i < facts_.size(); ++i) {
    const QRect row(0, static_cast<int>(i) * height, width(), height);
    if (!row.intersects(event->rect())) continue;
    const Fact fact = shown(i);
    painter.setPen(colors.muted);
    painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter, fact.name);
    painter.setPen(stale_ ? colors.muted : fact.warning ? colors.warning : colors.text);
    painter.drawText(row, Qt::AlignRight | Qt::AlignVCenter, fact.value);
    painter.setPen(colors.border);
    if (i + 1 < facts_.size()) painter.drawLine(row.bottomLeft(), row.bottomRight());
  }
}

bool FactsView::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const auto row = static_cast<std::size_t>(std::max(0, help->pos().y() / rowHeight()));
    if (row < facts_.size())
      QToolTip::showText(help->globalPos(), facts_[row].name + ": " + facts_[row].value, this);
    return true;
  }
  return QWidget::event(event);
}

}  // namespace palpate::gui
