#include "gui/appearance/icons.h"

#include <QIconEngine>
#include <QPainter>
#include <QPainterPath>
#include <QPixmap>

namespace palpate::gui {
namespace {

// All shapes are drawn in a square of 16 x 16 units.
constexpr double kIconsUnits = 16.0;
constexpr double kIconsStroke = 1.6;

QPainterPath iconsPolygon(std::initializer_list<QPointF> points) {
  QPainterPath path;
  path.addPolygon(QPolygonF(QList<QPointF>(points)));
  path.closeSubpath();
  return path;
}

QPainterPath lines(std::initializer_list<QPointF> points) {
  QPainterPath path;
  path.addPolygon(QPolygonF(QList<QPointF>(points)));
  return path;
}

QPainterPath bar(double x, double width) {
  QPainterPath path;
  path.addRect(x, 3, width, 10);
  return path;
}

QPainterPath filledPart(IconShape shape) {
  switch (shape) {
    case IconShape::kToStart:
      return bar(2, 2) + iconsPolygon({{13.5, 3}, {13.5, 13}, {5, 8}});
    case IconShape::kStepBack:
      return bar(11.5, 2) + iconsPolygon({{10, 3}, {10, 13}, {2.5, 8}});
    case IconShape::kPlay:
      return iconsPolygon({{4, 2.5}, {13.5, 8}, {4, 13.5}});
    case IconShape::kPause:
      return bar(4, 3) + bar(9, 3);
    case IconShape::kStepForward:
      return bar(2.5, 2) + iconsPolygon({{6, 3}, {6, 13}, {13.5, 8}});
    case IconShape::kLoop:
      return iconsPolygon({{9.5, 0.6}, {13.6, 3.4}, {9.5, 6.2}}) +
             iconsPolygon({{6.5, 9.8}, {6.5, 15.4}, {2.4, 12.6}});
    case IconShape::kSkipGaps:
      return iconsPolygon({{8.6, 4.6}, {14.4, 4.6}, {11.5, 9}});
    case IconShape::kHelp: {
      QPainterPath dot;
      dot.addEllipse(QPointF(8, 13.2), 1.1, 1.1);
      return dot;
    }
    case IconShape::kValues: {
      QPainterPath squares;
      for (const double x : {2.0, 8.6})
        for (const double y : {2.0, 8.6}) squares.addRect(x, y, 5.4, 5.4);
      return squares;
    }
    case IconShape::kRecord: {
      QPainterPath dot;
      dot.addEllipse(QPointF(8, 8), 5.0, 5.0);
      return dot;
    }
    case IconShape::kStopRecording: {
      QPainterPath square;
      square.addRoundedRect(QRectF(3.5, 3.5, 9, 9), 1.5, 1.5);
      return square;
    }
    case IconShape::kLive: {
      QPainterPath dot;
      dot.addEllipse(QPointF(8, 8), 2.4, 2.4);
      return dot;
    }
    default:
      return {};
  }
}

QPainterPath strokedPart(IconShape shape) {
  QPainterPath path;
  switch (shape) {
    case IconShape::kOpen:
      path = lines({{2, 13}, {2, 3.5}, {6, 3.5}, {7.5, 5.5}, {13, 5.5}, {13, 7.5}});
      path.addPath(iconsPolygon({{2, 13}, {4.5, 7.5}, {15, 7.5}, {12.5, 13}}));
      return path;
    case IconShape::kExport:
      path = lines({{2.5, 9.5}, {2.5, 13.5}, {13.5, 13.5}, {13.5, 9.5}});
      path.addPath(lines({{8, 10.5}, {8, 2.5}}));
      path.addPath(lines({{4.8, 5.5}, {8, 2.3}, {11.2, 5.5}}));
      return path;
    case IconShape::kLoop:
      path = lines({{2.5, 8.5}, {2.5, 3.4}, {10, 3.4}});
      path.addPath(lines({{13.5, 7.5}, {13.5, 12.6}, {6, 12.6}}));
      return path;
    case IconShape::kSkipGaps:
      path.moveTo(4.5, 9.5);
      path.cubicTo(4.5, 1, 11.5, 1, 11.5, 6);
      path.addPath(lines({{1, 13}, {6, 13}}));
      path.addPath(lines({{10, 13}, {15, 13}}));
      return path;
    case IconShape::kHelp:
      path.moveTo(4.8, 5.2);
      path.cubicTo(4.8, 0.6, 11.4, 0.6, 11.4, 5);
      path.cubicTo(11.4, 7.8, 8, 7.4, 8, 10.6);
      return path;
    case IconShape::kClose:
      path = lines({{4, 4}, {12, 12}});
      path.addPath(lines({{12, 4}, {4, 12}}));
      return path;
    case IconShape::kConnect:  // a plug in front of its socket
      path = lines({{1, 8}, {4.5, 8}});
      path.addPath(iconsPolygon({{4.5, 4.5}, {8, 4.5}, {8, 11.5}, {4.5, 11.5}}));
      path.addPath(lines({{8, 6.2}, {10.6, 6.2}}));
      path.addPath(lines({{8, 9.8}, {10.6, 9.8}}));
      path.addPath(lines({{12.5, 4}, {12.5, 12}}));
      path.addPath(lines({{12.5, 8}, {15, 8}}));
      return path;
    case IconShape::kLive:
      for (const double radius : {4.2, 6.6}) {
        const QRectF around(8 - radius, 8 - radius, 2 * radius, 2 * radius);
        for (const double from : {-40.0, 140.0}) {
          path.arcMoveTo(around, from);
          path.arcTo(around, from, 80.0);
        }
      }
      return path;
    case IconShape::kInterpolated:
      path.moveTo(1.5, 12.5);
      path.cubicTo(6, 12.5, 5, 3.5, 8, 3.5);
      path.cubicTo(11, 3.5, 10, 12.5, 14.5, 12.5);
      return path;
    default:
      return {};
  }
}

class PathIconEngine : public QIconEngine {
 public:
  explicit PathIconEngine(IconShape shape) : shape_(shape) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    const ThemeColors& colors = colorsOf();
    QColor color = state == QIcon::On ? colors.accent : colors.text;
    if (shape_ == IconShape::kRecord || shape_ == IconShape::kStopRecording) color = colors.danger;
    constexpr float kFaded = 0.45F;
    if (mode == QIcon::Disabled) {
      color = colors.muted;
      color.setAlphaF(kFaded);
    }
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->translate(rect.topLeft());
    painter->scale(rect.width() / kIconsUnits, rect.height() / kIconsUnits);
    painter->fillPath(filledPart(shape_), color);
    painter->strokePath(strokedPart(shape_),
                        QPen(color, kIconsStroke, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter->restore();
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap pixmap(size);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return pixmap;
  }

  QIconEngine* clone() const override { return new PathIconEngine(*this); }

 private:
  IconShape shape_;
};

}  // namespace

QIcon makeIcon(IconShape shape) { return QIcon(new PathIconEngine(shape)); }

}  // namespace palpate::gui
