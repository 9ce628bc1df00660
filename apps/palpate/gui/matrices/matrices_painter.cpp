#include "gui/matrices/matrices_painter.h"

#include <QFontMetricsF>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gui/appearance/difference_map.h"
#include "gui/appearance/hand_unit.h"
#include "gui/matrices/drawn_taxels.h"
#include "gui/matrices/heat_image.h"

namespace palpate::gui {
namespace {

constexpr double kGridFrom = 5.0;        // [px] below this taxel side squares touch each other
constexpr double kGridLine = 1.0;        // [px] between squares
constexpr double kValuesFrom = 11.0;     // [px] below this side numbers can't be read
constexpr double kSmallestFontPx = 5.0;  // of values [px]
constexpr double kLargestFontPx = 15.0;
constexpr double kShortestArrow = 1.5;  // of shear that is drawn [px]
constexpr double kArrowHead = 5.0;      // [px]

QRectF squareOf(const QRectF& taxel) {
  if (taxel.width() < kGridFrom) return taxel;
  return taxel.adjusted(0.0, 0.0, -kGridLine, -kGridLine);
}

// A step of 1, 2 or 5 times a power of ten that divides `span` into about `parts`.
double niceStep(double span, double parts) {
  const double raw = span / std::max(1.0, parts);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10.0 * power;
}

QString tickText(double value) { return QString::number(value, 'g', 6); }

bool diverges(const MatricesPictureOptions& options) {
  return options.difference || options.isSigned;
}

// Taxels at rest are dark in both themes: on a light ground the weakest touch would be the darkest
// place, and look like the strongest. The diverging map is another in each theme.
const ThemeColors& cellColors(const MatricesPictureOptions& options) {
  return colorsOf(diverges(options) ? options.theme : Theme::kDark);
}

const ColorTable& tableOf(const MatricesPictureOptions& options) {
  return diverges(options) ? differenceTable(options.theme) : colorTable(options.map);
}

void paintTicks(QPainter& painter,
                const QRectF& bar,
                const ValueRange& range,
                const MatricesPictureOptions& options) {
  const ThemeColors& colors = colorsOf(options.theme);
  const QFontMetricsF metrics(pictureFont(options));
  const double span = range.maximum - range.minimum;
  const double step = niceStep(span, bar.height() / (3.6 * metrics.height()));
  const auto tick = [&](double value) {
    const double y = bar.bottom() - (value - range.minimum) / span * bar.height();
    painter.setPen(colors.muted);
    painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + 4, y));
    const QRectF text(bar.right() + 7, y - metrics.height() / 2, 60, metrics.height());
    painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter, tickText(value));
  };
  // The ends always have labels; a step too close to an end has none.
  const double clearance = span * 1.2 * metrics.height() / bar.height();
  tick(range.minimum);
  tick(range.maximum);
  for (double value = std::ceil(range.minimum / step) * step; value < range.maximum; value += step)
    if (value - range.minimum > clearance && range.maximum - value > clearance) tick(value);
}

// Paints a taxel that exists but isn't scanned: crossed out, so that it differs from one at rest.
void paintMasked(QPainter& painter, const QRectF& square, const ThemeColors& colors) {
  painter.setPen(QPen(colors.maskedLine, 1.0));
  painter.setBrush(Qt::NoBrush);
  const double inset = square.width() * 0.28;
  const QRectF cross = square.adjusted(inset, inset, -inset, -inset);
  painter.drawLine(cross.topLeft(), cross.bottomRight());
  painter.drawLine(cross.bottomLeft(), cross.topRight());
}

// Each long word as its first letters and a full stop: "0 proximal" becomes "0 prox.".
QString abbreviated(const QString& name) {
  constexpr qsizetype kLongWord = 6;
  constexpr qsizetype kKept = 4;
  QStringList words = name.split(' ');
  for (QString& word : words)
    if (word.size() > kLongWord) word = word.left(kKept) + '.';
  return words.join(' ');
}

// Each word behind the first as its first letter: "0 proximal" becomes "0 P".
QString withInitials(const QString& name) {
  QStringList words = name.split(' ', Qt::SkipEmptyParts);
  for (qsizetype i = 1; i < words.size(); ++i) words[i] = words[i].left(1).toUpper();
  return words.join(' ');
}

void matricesPainterPaintNames(QPainter& painter,
                               const MatricesGeometry& geometry,
                               const HandDescription& hand,
                               const MatricesPictureOptions& options) {
  const QFontMetricsF metrics(pictureFont(options));
  const auto fits = [&](const QString& name, const QRectF& rect) {
    return metrics.horizontalAdvance(name) <= rect.width();
  };
  painter.setPen(colorsOf(options.theme).muted);
  for (std::size_t m = 0; m < geometry.numMatrices(); ++m) {
    const QRectF rect = geometry.nameRect(m);
    if (rect.height() <= 0.0) continue;  // no room for names
    const QString name =
        matrixNameWithin(hand, m, [&](const QString& shortened) { return fits(shortened, rect); });
    painter.drawText(rect.adjusted(0, 0, 0, -3),
                     Qt::AlignHCenter | Qt::AlignBottom | Qt::TextDontClip,
                     metrics.elidedText(name, Qt::ElideRight, rect.width()));
  }
}

}  // namespace

QString matrixNameWithin(const HandDescription& hand,
                         std::size_t matrix,
                         const std::function<bool(const QString&)>& fits) {
  const QString name = QString::fromStdString(hand.matrices.at(matrix).shortName);
  const QString initials = withInitials(name);
  // Where there is no room, long words are abbreviated, then words become letters.
  for (const QString& each : {QString::fromStdString(hand.matrixName(matrix)),
                              name,
                              abbreviated(name),
                              initials,
                              QString(initials).remove(' ')})
    if (fits(each)) return each;
  QString last = abbreviated(name);
  while (last.contains(' ') && !fits(last)) last = last.section(' ', 0, -2);
  return last;
}

namespace {

// Paints two frames, one black and one white, which are visible on every colour of every map.
void paintSaturated(QPainter& painter, const QRectF& square) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(Qt::white, 1.0));
  painter.drawRect(square.adjusted(0.5, 0.5, -0.5, -0.5));
  if (square.width() < kGridFrom + 3.0) return;
  painter.setPen(QPen(Qt::black, 1.0));
  painter.drawRect(square.adjusted(1.5, 1.5, -1.5, -1.5));
}

// Black or white, whichever has more contrast to `background` (relative luminance, WCAG 2).
QColor contrasting(const QColor& background) {
  const auto linear = [](double channel) {
    return channel <= 0.03928 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
  };
  const double luminance = 0.2126 * linear(background.redF()) +
                           0.7152 * linear(background.greenF()) +
                           0.0722 * linear(background.blueF());
  return luminance > 0.179 ? Qt::black : Qt::white;
}

// The font of the values: as large as full scale, such as "4095", allows in a square.
QFont valueFont(const MatricesPictureOptions& options, const HandDescription& hand, double side) {
  QFont font = options.font;
  const auto digits = QString::number(static_cast<double>(hand.maximumCounts), 'f', 0).size() +
                      (decimalsOf(hand) > 0 ? decimalsOf(hand) + 1 : 0);
  // Four digits are about 2.6 times as wide as the font size.
  const double widthPerPx =
      (diverges(options) ? 3.3 : 2.62) * static_cast<double>(std::max<qsizetype>(4, digits)) / 4.0;
  const double px = std::clamp((side - 2.0) / widthPerPx, kSmallestFontPx, kLargestFontPx);
  font.setPixelSize(std::max(1, static_cast<int>(std::lround(px))));
  return font;
}

}  // namespace

void paintColorBar(QPainter& painter,
                   const QRectF& bar,
                   const ValueRange& range,
                   const MatricesPictureOptions& options) {
  if (bar.height() < 1.0) return;
  const ColorTable& table = tableOf(options);
  QImage ramp(1, static_cast<int>(table.size()), QImage::Format_RGB32);
  for (int i = 0; i < ramp.height(); ++i)
    ramp.setPixel(0, i, table[table.size() - 1 - static_cast<std::size_t>(i)]);
  painter.drawImage(bar, ramp);
  painter.setPen(colorsOf(options.theme).border);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(bar);
  if (!diverges(options)) {
    constexpr double kRestGapPx = 3.0, kRestHeightPx = 5.0;
    painter.setBrush(cellColors(options).taxel);
    painter.drawRect(QRectF(bar.left(), bar.bottom() + kRestGapPx, bar.width(), kRestHeightPx));
    painter.setBrush(Qt::NoBrush);
  }
  paintTicks(painter, bar, range, options);
  const QFontMetricsF metrics(pictureFont(options));
  painter.setPen(colorsOf(options.theme).muted);
  // Above the number of the highest value.
  const QRectF unit(bar.left(), bar.top() - 1.5 * metrics.height() - 2, 100, metrics.height());
  painter.drawText(unit, Qt::AlignLeft | Qt::AlignVCenter, options.unit);
}

void paintTitle(QPainter& painter, const QRectF& rect, const MatricesPictureOptions& options) {
  if (rect.isEmpty()) return;
  QFont bold = pictureFont(options);
  bold.setBold(true);
  const QFontMetricsF captionMetrics(pictureFont(options));
  const double captionWidth = captionMetrics.horizontalAdvance(options.caption);
  painter.setFont(bold);
  painter.setPen(colorsOf(options.theme).text);
  const double titleWidth = std::max(0.0, rect.width() - captionWidth - 16.0);
  painter.drawText(rect,
                   Qt::AlignLeft | Qt::AlignVCenter,
                   QFontMetricsF(bold).elidedText(options.title, Qt::ElideMiddle, titleWidth));
  painter.setFont(pictureFont(options));
  painter.setPen(colorsOf(options.theme).muted);
  painter.drawText(rect, Qt::AlignRight | Qt::AlignVCenter, options.caption);
}

ValueRange rangeOf(const MatricesPictureOptions& options, const TactileFrame& frame) {
  const bool given = options.rangeMax > options.rangeMin;
  if (options.isSigned) {
    const double end = given ? std::max(std::abs(options.rangeMin), std::abs(options.rangeMax))
                             : largestDrawn(frame, options.taxels);
    return end > 0.0 ? ValueRange{-end, end} : ValueRange{-1.0, 1.0};
  }
  if (given) return {options.rangeMin, options.rangeMax};
  if (const double drawn = largestDrawn(frame, options.taxels); drawn > 0.0) return {0.0, drawn};
  float largest = 0.0F;
  for (const float value : frame.allValues()) largest = std::max(largest, value);
  return {0.0, largest > 0.0F ? static_cast<double>(largest) : 1.0};
}

void paintMatricesBackground(QPainter& painter,
                             const MatricesGeometry& geometry,
                             const HandDescription& hand,
                             const ValueRange& range,
                             const MatricesPictureOptions& options) {
  const ThemeColors& colors = colorsOf(options.theme);
  painter.save();
  painter.fillRect(geometry.area(), colors.window);
  painter.setFont(pictureFont(options));
  painter.setRenderHint(QPainter::Antialiasing, false);
  paintTitle(painter, geometry.titleRect(), options);
  matricesPainterPaintNames(painter, geometry, hand, options);
  for (std::size_t m = 0; m < geometry.numMatrices(); ++m) {
    const MatrixLayout& layout = hand.layout->matrix(m);
    for (int y = 0; y < layout.rows; ++y) {
      for (int x = 0; x < layout.columns; ++x) {
        if (!layout.exists(y, x)) continue;
        const QRectF square = squareOf(geometry.taxelRect(m, y, x));
        if (layout.enabled(y, x))
          painter.fillRect(square, cellColors(options).taxel);
        else
          paintMasked(painter, square, colors);
      }
    }
  }
  if (geometry.numMatrices() > 0 && options.colorBar)
    paintColorBar(painter, geometry.colorBarRect(), range, withUnit(options, hand));
  painter.restore();
}

MatricesPictureOptions withUnit(MatricesPictureOptions options, const HandDescription& hand) {
  if (options.unit.isEmpty()) options.unit = unitOf(hand);
  return options;
}

float leastSeen(const HandDescription& hand) {
  return 0.5F * std::pow(10.0F, -static_cast<float>(decimalsOf(hand)));
}

void paintMatrixValues(QPainter& painter,
                       const MatricesGeometry& geometry,
                       std::size_t matrix,
                       const TactileFrame& frame,
                       const HandDescription& hand,
                       const ValueRange& range,
                       const MatricesPictureOptions& options) {
  const MatrixLayout& layout = hand.layout->matrix(matrix);
  const bool ofReadings =
      !options.difference && (options.isSigned || options.taxels == TaxelView::kMagnitude);
  const MatrixValues drawn =
      ofReadings ? drawnValues(frame, matrix, options.taxels) : MatrixValues();
  const ConstMatrixMap all = frame.allValues(matrix);
  const ConstMatrixMap values =
      drawn.size() > 0 ? ConstMatrixMap(drawn.data(), drawn.rows(), drawn.cols()) : all;
  const ConstMatrixMap contact = frame.matrix(matrix);
  const ColorTable& table = tableOf(options);
  const double side = geometry.taxelSide(matrix);
  const auto saturation = hand.saturationOf(matrix);
  HeatImageOptions image{options.map, range.minimum, range.maximum};
  image.least = static_cast<double>(leastSeen(hand));
  if (diverges(options)) image.difference = &table;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing, false);
  const bool asImage = options.interpolated || side < kGridFrom;
  if (asImage) {
    painter.setRenderHint(QPainter::SmoothPixmapTransform, options.interpolated);
    painter.drawImage(geometry.matrixRect(matrix),
                      options.interpolated ? smoothHeatImage(values, layout, image)
                                           : plainHeatImage(values, layout, image));
  }
  const bool withText = options.values && side >= kValuesFrom;
  const int decimals = decimalsOf(hand);
  const float least = leastSeen(hand);
  if (withText) painter.setFont(valueFont(options, hand, side));
  for (int y = 0; y < layout.rows; ++y) {
    for (int x = 0; x < layout.columns; ++x) {
      const float value = values(y, x);
      const float size = options.isSigned ? std::abs(value) : value;
      const bool seen = options.difference ? value != 0.0F : isSeen(contact(y, x), size, least);
      if (!seen || !layout.enabled(y, x)) continue;
      const int index = colorIndex(static_cast<double>(value), range.minimum, range.maximum);
      const QColor color = QColor::fromRgb(table[static_cast<std::size_t>(index)]);
      const QRectF square = squareOf(geometry.taxelRect(matrix, y, x));
      if (!asImage) painter.fillRect(square, color);
      // As numSaturated(): a magnitude may be larger than the full scale of its components.
      if (all(y, x) >= saturation && !options.difference) paintSaturated(painter, square);
      if (!withText) continue;
      painter.setPen(contrasting(color));
      painter.drawText(square,
                       Qt::AlignCenter | Qt::TextDontClip,
                       diverges(options) ? signedText(static_cast<double>(value), decimals)
                       : decimals == 0
                           ? QString::number(std::lround(value))
                           : QString::number(static_cast<double>(value), 'f', decimals));
    }
  }
  painter.restore();
}

double arrowScale(const ValueRange& range, double arrows) {
  return range.maximum > 0.0 ? arrows / range.maximum : 0.0;
}

void paintShear(QPainter& painter,
                const MatricesGeometry& geometry,
                std::size_t matrix,
                const TactileFrame& frame,
                const ValueRange& range,
                const MatricesPictureOptions& options) {
  const MatrixLayout& layout = frame.layout->matrix(matrix);
  const double scale = arrowScale(range, options.arrows) * geometry.taxelSide(matrix);
  if (options.difference || layout.touch.components != 3 || !(scale > 0.0)) return;
  QPainterPath arrows;
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      const QPointF way = scale * shearAt(frame, {matrix, y, x});
      const double length = std::hypot(way.x(), way.y());
      if (!(length >= kShortestArrow)) continue;
      const QPointF tip = squareOf(geometry.taxelRect(matrix, y, x)).center() + way;
      const QPointF back = std::min(kArrowHead, length / 2.0) / length * way;
      const QPointF aside = 0.6 * QPointF(-back.y(), back.x());
      arrows.moveTo(tip - way);
      arrows.lineTo(tip);
      arrows.moveTo(tip - back + aside);
      arrows.lineTo(tip);
      arrows.lineTo(tip - back - aside);
    }
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  // What lies around the matrix, such as the bar of colours, stays readable.
  painter.setClipRect(QRectF(geometry.taxelRect(matrix, 0, 0))
                          .united(geometry.taxelRect(matrix, layout.rows - 1, layout.columns - 1)));
  // White on black is visible on every colour of every map.
  painter.strokePath(arrows, QPen(Qt::black, 3.5));
  painter.strokePath(arrows, QPen(Qt::white, 1.5));
  painter.restore();
}

void paintMatricesPicture(QPainter& painter,
                          const QRectF& area,
                          const TactileFrame& frame,
                          const HandDescription& hand,
                          const MatricesPictureOptions& given) {
  if (!frame.layout || !hand.layout || !(*frame.layout == *hand.layout) ||
      frame.values.size() != hand.layout->numCells())
    throw std::invalid_argument("paintMatricesPicture: the frame is not of this hand");
  MatricesPictureOptions options = given;
  options.isSigned = !options.difference && isDrawnSigned(frame, options.taxels);
  const MatricesGeometry geometry(area, hand, options);
  const ValueRange range = rangeOf(options, frame);
  paintMatricesBackground(painter, geometry, hand, range, options);
  for (std::size_t m = 0; m < geometry.numMatrices(); ++m)
    paintMatrixValues(painter, geometry, m, frame, hand, range, options);
  for (std::size_t m = 0; m < geometry.numMatrices(); ++m)
    paintShear(painter, geometry, m, frame, range, options);
}

}  // namespace palpate::gui
