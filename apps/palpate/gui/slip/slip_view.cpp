#include "gui/slip/slip_view.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gui/appearance/captions.h"
#include "gui/slip/slip_indicator.h"

namespace palpate::gui {
namespace {

constexpr double kSlipViewMargin = 10.0;        // [px]
constexpr double kSlipViewLargestTaxel = 40.0;  // [px]
constexpr int kFootLines = 4;   // lines of numbers below the drawing; half of them when it is low
constexpr double kLow = 320.0;  // [px] lower is low
constexpr double kFaintest = 0.2;       // smallest opacity of the taxels
constexpr double kSlipViewFaint = 0.6;  // opacity of the taxels
constexpr double kEllipseSds = 2.0;
constexpr double kSkewSeen = 0.05;  // smaller skewness has no mark
constexpr double kMaxSkew = 1.5;    // limit for the size of a mark
constexpr double kMinArrow = 6.0;   // [px] shorter arrows become a dot
constexpr double kHead = 7.0;       // [px] head of an arrow

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

// Draws a line with a rim in the background colour, so that it is visible on every taxel.
void strokeTwice(QPainter& painter,
                 const QPainterPath& path,
                 const QColor& color,
                 double width,
                 const QColor& rim) {
  painter.strokePath(path, QPen(rim, width + 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.strokePath(path, QPen(color, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
}

QPolygonF headOf(const QPointF& tip, const QPointF& along, double length) {
  const QPointF across(-along.y(), along.x());
  const QPointF back = tip - along * length;
  return QPolygonF(
      QList<QPointF>{tip, back + across * (0.5 * length), back - across * (0.5 * length)});
}

void paintArrow(QPainter& painter,
                const QPointF& from,
                const QPointF& to,
                const QColor& color,
                const QColor& rim) {
  const QPointF way = to - from;
  const double length = std::hypot(way.x(), way.y());
  if (length < kMinArrow) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawEllipse(from, 2.5, 2.5);
    painter.setBrush(Qt::NoBrush);
    return;
  }
  const QPointF along = way / length;
  const double head = std::min(kHead + 2.0, length);
  QPainterPath shaft(from);
  shaft.lineTo(to - along * head * 0.8);
  strokeTwice(painter, shaft, color, 2.6, rim);
  QPainterPath tip;
  tip.addPolygon(headOf(to, along, head));
  tip.closeSubpath();
  painter.setPen(QPen(rim, 1.0));
  painter.setBrush(color);
  painter.drawPath(tip);
  painter.setBrush(Qt::NoBrush);
}

QString signedFigure(float value) {
  const QString size = figure(std::abs(static_cast<double>(value)), 2);
  if (size == figure(0.0, 2)) return size;
  return (value < 0.0F ? "−" : "+") + size;
}

int footLines(const QRectF& area) { return area.height() < kLow ? kFootLines / 2 : kFootLines; }

}  // namespace

struct SlipView::Place {
  QRectF matrix;
  double side = 1.0;  // [px] of a taxel, along a row
  double high = 1.0;  // along a column
  QPointF at(double x, double y) const { return matrix.topLeft() + way(x + 0.5, y + 0.5); }
  QPointF way(double dx, double dy) const { return {dx * side, dy * high}; }
};

SlipView::SlipView(QWidget* parent) : QWidget(parent) {
  setObjectName("slipDrawing");
  setAccessibleName("Shape and motion of the contact");
}

void SlipView::setScene(const SlipViewData& scene) {
  scene_ = scene;
  update();
}

void SlipView::clear() {
  scene_.reset();
  update();
}

void SlipView::setMap(ColorMapName map) {
  if (map == map_) return;
  map_ = map;
  update();
}

SlipView::Place SlipView::placeIn(const QRectF& area) const {
  const double line = fontMetrics().height();
  const QRectF room =
      area.adjusted(kSlipViewMargin, line + 10.0, -kSlipViewMargin, -footLines(area) * line - 12.0);
  const MatrixLayout& layout = scene_->layout;
  Place place;
  const double aspect = layout.pitchMm.y / layout.pitchMm.x;
  place.side = std::floor(
      std::clamp(std::min(room.width() / layout.columns, room.height() / (layout.rows * aspect)),
                 2.0,
                 kSlipViewLargestTaxel));
  place.high = place.side * aspect;
  const QSizeF size(layout.columns * place.side, layout.rows * place.high);
  place.matrix =
      QRectF(QPointF(std::floor(room.center().x() - 0.5 * size.width()),
                     std::floor(room.top() + std::max(0.0, 0.5 * (room.height() - size.height())))),
             size);
  return place;
}

QPointF SlipView::pixelOf(double x, double y) const { return placeIn(rect()).at(x, y); }

void SlipView::paint(QPainter& painter, const QRectF& area, Theme theme) const {
  const ThemeColors& colors = colorsOf(theme);
  painter.save();
  painter.fillRect(area, colors.window);
  if (!scene_) return painter.restore();
  const SlipViewData& scene = *scene_;
  const Place place = placeIn(area);
  const double line = QFontMetricsF(painter.font()).height();
  painter.setPen(colors.text);
  painter.drawText(QRectF(area.left() + kSlipViewMargin,
                          area.top() + 6.0,
                          area.width() - 2 * kSlipViewMargin,
                          line),
                   Qt::AlignHCenter | Qt::AlignVCenter,
                   QFontMetricsF(painter.font())
                       .elidedText(scene.name, Qt::ElideRight, area.width() - 2 * kSlipViewMargin));
  const ColorTable& table = colorTable(map_);
  for (int y = 0; y < scene.layout.rows; ++y)
    for (int x = 0; x < scene.layout.columns; ++x) {
      if (!scene.layout.exists(y, x)) continue;
      const QRectF square(place.at(x - 0.5, y - 0.5), QSizeF(place.side - 1.0, place.high - 1.0));
      painter.fillRect(square, colors.taxel);
      const double value = scene.values.size() > 0 ? static_cast<double>(scene.values(y, x)) : 0.0;
      if (!isTouched(value) || !scene.layout.enabled(y, x)) continue;
      QColor color = QColor::fromRgb(table[static_cast<std::size_t>(
          colorIndex(value, 0.0, std::max(1.0, scene.largestCounts)))]);
      color.setAlphaF(static_cast<float>(kFaintest + (kSlipViewFaint - kFaintest) * value /
                                                         std::max(1.0, scene.largestCounts)));
      painter.fillRect(square, color);
    }
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF foot(area.left() + kSlipViewMargin,
                    area.bottom() - footLines(area) * line - 6.0,
                    area.width() - 2 * kSlipViewMargin,
                    line);
  painter.setPen(colors.muted);
  if (!scene.sample) {
    painter.drawText(foot, Qt::AlignHCenter, "no contact");
    return painter.restore();
  }
  const SlipSample& sample = *scene.sample;
  QColor rim = colors.window;
  rim.setAlphaF(0.8F);
  const QPointF centre = place.at(static_cast<double>(sample.x), static_cast<double>(sample.y));
  // The ellipse and its axis: solid where the shape has a direction, dotted where it has none.
  const double along = kEllipseSds * static_cast<double>(sample.majorSd) * place.side;
  const double across = kEllipseSds * static_cast<double>(sample.minorSd) * place.side;
  const double angle = radians(static_cast<double>(sample.orientationDeg));
  const QPointF u(std::cos(angle), std::sin(angle)), v(-std::sin(angle), std::cos(angle));
  QPainterPath ellipse;
  QTransform turned;
  turned.translate(centre.x(), centre.y());
  turned.rotate(static_cast<double>(sample.orientationDeg));
  ellipse.addEllipse(QPointF(0.0, 0.0), along, across);
  strokeTwice(painter, turned.map(ellipse), colors.text, 1.4, rim);
  painter.setPen(QPen(colors.text, 1.2, sample.reliable ? Qt::SolidLine : Qt::DotLine));
  painter.drawLine(centre - u * along, centre + u * along);
  painter.drawLine(centre - v * (0.25 * across), centre + v * (0.25 * across));
  // Skewness: a wedge at the side of the longer tail; its size grows with the skewness.
  const double sdX = std::hypot(static_cast<double>(sample.majorSd) * u.x(),
                                static_cast<double>(sample.minorSd) * v.x());
  const double sdY = std::hypot(static_cast<double>(sample.majorSd) * u.y(),
                                static_cast<double>(sample.minorSd) * v.y());
  const auto wedge = [&](float skew, const QPointF& way, double sd) {
    const double size = std::abs(static_cast<double>(skew));
    if (size < kSkewSeen) return;
    const QPointF side = skew < 0.0F ? -way : way;
    const double length = 4.0 + 8.0 * std::min(size, kMaxSkew) / kMaxSkew;
    painter.setPen(QPen(rim, 1.0));
    painter.setBrush(colors.warning);
    painter.drawPolygon(
        headOf(centre + side * (kEllipseSds * sd * place.side + length + 3.0), side, length));
    painter.setBrush(Qt::NoBrush);
  };
  wedge(sample.skewX, {1.0, 0.0}, sdX);
  wedge(sample.skewY, {0.0, 1.0}, sdY);
  // The path since the reference.
  if (!scene.path.empty()) {
    const QPointF from = place.at(scene.path.front().x(), scene.path.front().y());
    painter.setPen(QPen(colors.muted, 1.0, Qt::DashLine));
    painter.drawEllipse(
        from, scene.referenceTaxels * place.side, scene.referenceTaxels * place.high);
    QPainterPath way(from);
    for (const QPointF& point : scene.path) way.lineTo(place.at(point.x(), point.y()));
    strokeTwice(painter, way, colors.accent, 1.8, rim);
    painter.setPen(QPen(rim, 1.0));
    painter.setBrush(colors.accent);
    painter.drawRect(QRectF(from - QPointF(3.0, 3.0), QSizeF(6.0, 6.0)));
    const QPointF to = place.at(scene.path.back().x(), scene.path.back().y());
    painter.drawEllipse(to, 3.5, 3.5);
    painter.setBrush(Qt::NoBrush);
  }
  // The motion of the last frame, enlarged, with its threshold.
  const QColor indicator = colorOf(indicatorOf(&sample), theme);
  painter.setPen(QPen(indicator, 1.0, Qt::DotLine));
  const double ring = scene.stepTaxels * kEnlarged;
  painter.drawEllipse(centre, ring * place.side, ring * place.high);
  if (sample.valid)
    paintArrow(painter,
               centre,
               centre + place.way(static_cast<double>(sample.dx), static_cast<double>(sample.dy)) *
                            kEnlarged,
               indicator,
               rim);
  const auto pair = [](bool known, float x, float y) {
    return known ? signedFigure(x) + ", " + signedFigure(y) : QString("–");
  };
  const QString lines[] = {
      "step " + pair(sample.valid, sample.dx, sample.dy),
      "in all " + pair(sample.refValid, sample.refDx, sample.refDy),
      sample.reliable ? "axis " + figure(static_cast<double>(sample.orientationDeg), 0) + "°"
                      : QString("too round for an axis"),
      "skew " + pair(true, sample.skewX, sample.skewY)};
  for (int i = 0; i < footLines(area); ++i) {
    painter.setPen(i < 2 ? colors.text : colors.muted);
    painter.drawText(foot.translated(0.0, i * line), Qt::AlignHCenter | Qt::AlignVCenter, lines[i]);
  }
  painter.restore();
}

void SlipView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paint(painter, rect(), shownTheme());
}

}  // namespace palpate::gui
