#include "gui/compare/compare_painter.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>

#include "gui/appearance/difference_map.h"

namespace palpate::gui {
namespace {

// Additional width of a group with a colour bar [px] (matrices_geometry.cpp).
constexpr double kBarSpace = 86.0;
// [px] around titles, as around the matrices below them
constexpr double kComparePainterAround = 14.0;
constexpr double kSwatch = 10.0;  // [px]

std::size_t comparePainterIndexOf(CompareGroup group) { return static_cast<std::size_t>(group); }

MatricesPictureOptions comparePainterOptionsOf(CompareGroup group,
                                               const ComparePictureOptions& options) {
  MatricesPictureOptions own = options.look;
  own.title.clear();
  own.caption.clear();
  // A and B share one colour bar.
  own.colorBar = group != CompareGroup::kA;
  if (group != CompareGroup::kDifference) return own;
  own.difference = true;
  own.rangeMin = -options.largestDifference;
  own.rangeMax = options.largestDifference;
  return own;
}

ValueRange comparePainterRangeOf(const MatricesPictureOptions& options) {
  return {options.rangeMin, std::max(options.rangeMax, options.rangeMin + 1e-9)};
}

void paintSwatch(QPainter& painter, const QRectF& square, CompareGroup group, Theme theme) {
  const QColor a = sideColor(CompareSide::kA, theme), b = sideColor(CompareSide::kB, theme);
  if (group != CompareGroup::kDifference)
    return painter.fillRect(square, group == CompareGroup::kA ? a : b);
  painter.fillRect(square.adjusted(0, 0, -square.width() / 2, 0), a);
  painter.fillRect(square.adjusted(square.width() / 2, 0, 0, 0), b);
}

void paintTitle(QPainter& painter,
                const QRectF& rect,
                CompareGroup group,
                const CompareGroupContent& content,
                const MatricesPictureOptions& options) {
  const ThemeColors& colors = colorsOf(options.theme);
  const QFontMetricsF metrics(pictureFont(options));
  const double line = metrics.height();
  paintSwatch(painter,
              QRectF(rect.left(), rect.top() + (line - kSwatch) / 2, kSwatch, kSwatch),
              group,
              options.theme);
  const QRectF first(rect.left() + kSwatch + 7, rect.top(), rect.width() - kSwatch - 7, line);
  QFont bold = pictureFont(options);
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(colors.text);
  painter.drawText(first,
                   Qt::AlignLeft | Qt::AlignVCenter,
                   QFontMetricsF(bold).elidedText(content.name, Qt::ElideMiddle, first.width()));
  painter.setFont(pictureFont(options));
  painter.setPen(colors.muted);
  const QRectF second(first.left(), first.bottom() + 2, first.width(), line);
  painter.drawText(
      second,
      Qt::AlignLeft | Qt::AlignVCenter,
      metrics.elidedText(
          fittingCaption(content, second.width(), metrics), Qt::ElideRight, second.width()));
}

// Paints the notice on a card in the middle of the group, so that it is legible over taxels.
void comparePainterPaintNotice(QPainter& painter,
                               const MatricesGeometry& geometry,
                               const QString& notice,
                               const MatricesPictureOptions& options) {
  const ThemeColors& colors = colorsOf(options.theme);
  QRectF matrices;
  for (std::size_t m = 0; m < geometry.numMatrices(); ++m) matrices |= geometry.matrixRect(m);
  if (matrices.isEmpty()) return;
  const QFontMetricsF metrics(pictureFont(options));
  constexpr double kPad = 9.0;
  QRectF text = metrics.boundingRect(
      matrices.adjusted(kPad, 0, -kPad, 0), Qt::AlignCenter | Qt::TextWordWrap, notice);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colors.border, 1.0));
  painter.setBrush(colors.panel);
  painter.drawRoundedRect(text.adjusted(-kPad, -kPad / 2, kPad, kPad / 2), 5, 5);
  painter.setPen(colors.muted);
  painter.drawText(text, Qt::AlignCenter | Qt::TextWordWrap, notice);
  painter.setRenderHint(QPainter::Antialiasing, false);
}

}  // namespace

const QString& fittingCaption(const CompareGroupContent& content,
                              double width,
                              const QFontMetricsF& metrics) {
  if (content.shorterCaptions.empty() || metrics.horizontalAdvance(content.caption) <= width)
    return content.caption;
  for (const QString& shorter : content.shorterCaptions)
    if (metrics.horizontalAdvance(shorter) <= width) return shorter;
  return content.shorterCaptions.back();
}

const HandDescription& ComparedHands::of(CompareGroup group) const {
  if (group == CompareGroup::kA) return a;
  return group == CompareGroup::kB ? b : difference;
}

CompareGeometry::CompareGeometry(const QRectF& area,
                                 const ComparedHands& hands,
                                 const ComparePictureOptions& options)
    : area_(area) {
  const double line = QFontMetricsF(pictureFont(options.look)).height();
  const double titleHeight = 2 * line + 2;
  const double top = area.top() + kComparePainterAround * 0.6;
  // Two groups have a colour bar; the remaining width is shared equally, so that all have the same
  // scale.
  const double share = std::max(0.0, (area.width() - 2 * kBarSpace) / 3);
  double left = area.left();
  for (const CompareGroup group : kAllCompareGroups) {
    const double width = share + (group == CompareGroup::kA ? 0.0 : kBarSpace);
    const double below = top + titleHeight;
    groups_[comparePainterIndexOf(group)] =
        MatricesGeometry(QRectF(left, below, width, area.bottom() - below),
                         hands.of(group),
                         comparePainterOptionsOf(group, options));
    titles_[comparePainterIndexOf(group)] =
        QRectF(left + kComparePainterAround, top, width - kComparePainterAround - 6, titleHeight);
    left += width;
  }
}

const MatricesGeometry& CompareGeometry::group(CompareGroup which) const {
  return groups_[comparePainterIndexOf(which)];
}

QRectF CompareGeometry::titleRect(CompareGroup which) const {
  return titles_[comparePainterIndexOf(which)];
}

std::optional<CompareGeometry::Place> CompareGeometry::placeAt(const QPointF& point) const {
  for (const CompareGroup each : kAllCompareGroups)
    if (const auto taxel = group(each).placeAt(point)) return Place{each, *taxel};
  return std::nullopt;
}

void paintCompareBackground(QPainter& painter,
                            const CompareGeometry& geometry,
                            const ComparedHands& hands,
                            const ComparePictureOptions& options) {
  painter.fillRect(geometry.area(), colorsOf(options.look.theme).window);
  for (const CompareGroup group : kAllCompareGroups) {
    const MatricesPictureOptions own = comparePainterOptionsOf(group, options);
    paintMatricesBackground(
        painter, geometry.group(group), hands.of(group), comparePainterRangeOf(own), own);
  }
}

void paintCompareValues(QPainter& painter,
                        const CompareGeometry& geometry,
                        const ComparedHands& hands,
                        const ComparedFrames& frames,
                        const ComparePictureOptions& options) {
  for (const CompareGroup group : kAllCompareGroups) {
    const CompareGroupContent& content = frames[comparePainterIndexOf(group)];
    const MatricesPictureOptions own = comparePainterOptionsOf(group, options);
    const MatricesGeometry& place = geometry.group(group);
    painter.save();
    paintTitle(painter, geometry.titleRect(group), group, content, own);
    if (content.frame.values.size() == hands.of(group).layout->numCells())
      for (std::size_t m = 0; m < place.numMatrices(); ++m)
        paintMatrixValues(
            painter, place, m, content.frame, hands.of(group), comparePainterRangeOf(own), own);
    if (!content.notice.isEmpty()) comparePainterPaintNotice(painter, place, content.notice, own);
    painter.restore();
  }
}

void paintComparison(QPainter& painter,
                     const QRectF& area,
                     const ComparedHands& hands,
                     const ComparedFrames& frames,
                     const ComparePictureOptions& options) {
  const CompareGeometry geometry(area, hands, options);
  paintCompareBackground(painter, geometry, hands, options);
  paintCompareValues(painter, geometry, hands, frames, options);
}

}  // namespace palpate::gui
