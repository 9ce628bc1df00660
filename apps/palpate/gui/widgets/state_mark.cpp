#include "gui/widgets/state_mark.h"

#include <QPainter>
#include <QPainterPath>

#include "gui/appearance/theme.h"

namespace palpate::gui {
namespace {

// The mark is drawn in a square of 16 x 16 units.
constexpr int kStateMarkUnits = 16;
constexpr QPointF kStateMarkMiddle(8.0, 8.0);
constexpr double kStateMarkRadius = 6.5;
constexpr double kStateMarkStroke = 1.8;

QPolygonF tick() { return QPolygonF(QList<QPointF>{{5.0, 8.3}, {7.2, 10.5}, {11.2, 5.8}}); }
QPolygonF triangle() { return QPolygonF(QList<QPointF>{{8.0, 1.8}, {15.0, 14.2}, {1.0, 14.2}}); }

}  // namespace

StateMark::StateMark(QWidget* parent) : QWidget(parent) {
  setFixedSize(kStateMarkUnits, kStateMarkUnits);
}

void StateMark::setState(State state) {
  state_ = state;
  update();
}

void StateMark::paintEvent(QPaintEvent*) {
  const ThemeColors& colors = colorsOf();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPen inside(colors.panel, kStateMarkStroke, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  painter.setPen(Qt::NoPen);
  switch (state_) {
    case State::kNone:
      break;
    case State::kAtWork:
      painter.setBrush(colors.muted);
      for (const double x : {3.0, 8.0, 13.0})
        painter.drawEllipse(QPointF(x, kStateMarkMiddle.y()), 1.5, 1.5);
      break;
    case State::kGood:
      painter.setBrush(colors.accent);
      painter.drawEllipse(kStateMarkMiddle, kStateMarkRadius, kStateMarkRadius);
      painter.setPen(inside);
      painter.setBrush(Qt::NoBrush);
      painter.drawPolyline(tick());
      break;
    case State::kWarning:
      painter.setBrush(colors.warning);
      painter.drawPolygon(triangle());
      painter.setPen(inside);
      painter.drawLine(QPointF(8.0, 6.4), QPointF(8.0, 9.6));
      painter.drawPoint(QPointF(8.0, 12.2));
      break;
    case State::kBad:
      painter.setBrush(colors.danger);
      painter.drawEllipse(kStateMarkMiddle, kStateMarkRadius, kStateMarkRadius);
      painter.setPen(inside);
      painter.drawLine(QPointF(5.7, 5.7), QPointF(10.3, 10.3));
      painter.drawLine(QPointF(10.3, 5.7), QPointF(5.7, 10.3));
      break;
  }
}

}  // namespace palpate::gui
