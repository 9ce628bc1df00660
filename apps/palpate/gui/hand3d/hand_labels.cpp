// Paints the labels of a scene, each beside its place where no other label is yet, with an outline
// in the background colour so that they are readable on any surface.
#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <QStringList>
#include <algorithm>
#include <array>
#include <vector>

#include "gui/hand3d/hand_scene.h"

namespace palpate::gui {

namespace {

constexpr double kGapPx = 6.0;  // [px] between the place and its text
constexpr double kRimPx = 3.0;

struct Placed {
  const SceneLabel* label;
  HandCamera::Projected place;
};

// The positions for a label: right of the place, left, above, below.
std::array<QRectF, 4> placesAround(const QPointF& at, const QSizeF& text) {
  const double w = text.width(), h = text.height();
  return {QRectF(at.x() + kGapPx, at.y() - 0.5 * h, w, h),
          QRectF(at.x() - kGapPx - w, at.y() - 0.5 * h, w, h),
          QRectF(at.x() - 0.5 * w, at.y() - kGapPx - h, w, h),
          QRectF(at.x() - 0.5 * w, at.y() + kGapPx, w, h)};
}

QRectF movedInside(QRectF rect, const QRectF& picture) {
  rect.moveLeft(std::max(picture.left(), std::min(rect.left(), picture.right() - rect.width())));
  rect.moveTop(std::max(picture.top(), std::min(rect.top(), picture.bottom() - rect.height())));
  return rect;
}

QRectF handLabelsFreePlace(const QPointF& at,
                           const QSizeF& text,
                           const QRectF& picture,
                           const std::vector<QRectF>& taken) {
  const auto isFree = [&](const QRectF& place) {
    return picture.contains(place) &&
           std::none_of(taken.begin(), taken.end(), [&](const QRectF& other) {
             return other.intersects(place);
           });
  };
  const auto places = placesAround(at, text);
  for (const QRectF& place : places)
    if (isFree(place)) return place;
  // The nearest free row above or below.
  const QRectF beside = movedInside(places.front(), picture);
  for (int step = 1; step * text.height() < picture.height(); ++step)
    for (const double way : {-1.0, 1.0})
      if (const QRectF row = beside.translated(0.0, way * step * text.height()); isFree(row))
        return row;
  return beside;
}

// A text that is wider than the picture has a line for each of its parts.
QStringList linesOf(const QString& text, const QFontMetricsF& metrics, double widthPx) {
  if (metrics.horizontalAdvance(text) <= widthPx) return {text};
  QStringList lines = text.split(", ");
  for (qsizetype i = 0; i + 1 < lines.size(); ++i) lines[i] += ',';
  return lines;
}

}  // namespace

void paintLabels(QPainter& painter,
                 const HandScene& scene,
                 const HandCamera& camera,
                 const QSizeF& size) {
  const QRectF picture(QPointF(0.0, 0.0), size);
  std::vector<Placed> shown;
  for (const SceneLabel& label : scene.labels) {
    const auto place = camera.project(label.atMm, size);
    if (place && picture.contains(place->at) && !label.text.isEmpty())
      shown.push_back({.label = &label, .place = *place});
  }
  // The nearest label comes first: it has the free choice of positions.
  std::stable_sort(shown.begin(), shown.end(), [](const Placed& a, const Placed& b) {
    return a.place.depthMm < b.place.depthMm;
  });
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QFontMetricsF metrics(painter.font(), painter.device());
  QColor rim = QColor::fromRgb(scene.background);
  rim.setAlphaF(0.85F);
  std::vector<QRectF> taken;
  for (const Placed& word : shown) {
    const QStringList lines = linesOf(word.label->text, metrics, picture.width());
    double widest = 0.0;
    for (const QString& line : lines) widest = std::max(widest, metrics.horizontalAdvance(line));
    const QSizeF text(widest, metrics.height() * static_cast<double>(lines.size()));
    const QRectF at = handLabelsFreePlace(word.place.at, text, picture, taken);
    taken.push_back(at);
    QPainterPath path;
    for (qsizetype i = 0; i < lines.size(); ++i)
      path.addText(at.topLeft() + QPointF(0.0, metrics.ascent() + i * metrics.height()),
                   painter.font(),
                   lines[i]);
    painter.strokePath(path, QPen(rim, kRimPx, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.fillPath(path, word.label->color);
  }
  painter.restore();
}

}  // namespace palpate::gui
