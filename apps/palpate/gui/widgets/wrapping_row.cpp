#include "gui/widgets/wrapping_row.h"

#include <QEvent>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr int kWrappedControlSpacing = 12;  // [px]
constexpr int kWrappedLineSpacing = 6;      // [px]

QSize wantedSize(const QWidget& control) {
  return control.sizeHint().expandedTo(control.minimumSize()).boundedTo(control.maximumSize());
}

}  // namespace

WrappingRow::WrappingRow(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Minimum);
}

void WrappingRow::add(QWidget* control) {
  control->setParent(this);
  controls_.append(control);
  updateGeometry();
}

QList<QRect> WrappingRow::places(int width) const {
  QList<QRect> places;
  qsizetype lineFrom = 0;
  int x = 0, y = 0, lineHeight = 0;
  // The controls of a line have their middle at one height.
  const auto endLine = [&] {
    for (qsizetype i = lineFrom; i < places.size(); ++i)
      places[i].translate(0, (lineHeight - places[i].height()) / 2);
    lineFrom = places.size();
  };
  for (const QWidget* control : controls_) {
    if (control->isHidden()) continue;
    const QSize size = wantedSize(*control);
    if (x > 0 && x + size.width() > width) {
      endLine();
      x = 0;
      y += lineHeight + kWrappedLineSpacing;
      lineHeight = 0;
    }
    places.append(QRect(QPoint(x, y), size));
    lineHeight = std::max(lineHeight, size.height());
    x += size.width() + kWrappedControlSpacing;
  }
  endLine();
  return places;
}

void WrappingRow::arrange() {
  const QList<QRect> places = this->places(width());
  qsizetype next = 0;
  for (QWidget* control : controls_)
    if (!control->isHidden()) control->setGeometry(places[next++]);
}

int WrappingRow::heightForWidth(int width) const {
  int height = 0;
  for (const QRect& place : places(width)) height = std::max(height, place.bottom() + 1);
  return height;
}

QSize WrappingRow::sizeHint() const {
  int width = 0;
  for (const QRect& place : places(QWIDGETSIZE_MAX)) width = std::max(width, place.right() + 1);
  return {width, heightForWidth(width)};
}

QSize WrappingRow::minimumSizeHint() const {
  int widest = 0;
  for (const QWidget* control : controls_)
    if (!control->isHidden()) widest = std::max(widest, wantedSize(*control).width());
  return {widest, heightForWidth(std::max(width(), widest))};
}

void WrappingRow::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
  // The least height is another one with another number of lines.
  if (event->oldSize().width() != width()) updateGeometry();
}

bool WrappingRow::event(QEvent* event) {
  const bool done = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest) {
    arrange();
    updateGeometry();
  }
  return done;
}

}  // namespace palpate::gui
