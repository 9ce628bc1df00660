#include "gui/chart/chart_picture.h"

#include <QFontInfo>
#include <QFontMetricsF>
#include <QPicture>
#include <algorithm>
#include <cmath>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/chart/chart_style.h"
#include "gui/picture/picture_export.h"

namespace palpate::gui {
namespace {

constexpr double kChartPictureMargin = 12.0;  // [units] around the words
constexpr double kChartPictureLine = 18.0;    // [units] length of a line in the legend
constexpr double kChartPictureGap = 6.0;      // [units] between a line and its name
constexpr double kEntryGap = 18.0;            // [units] between entries
// Line spacing of the legend.
constexpr double kLineSpacing = 1.3;
constexpr double kMinContrast = 3.0;
constexpr double kMinAxisLines = 3.0;  // shortest axis [lines of text]

double luminance(const QColor& color) {
  const auto linear = [](double channel) {
    return channel <= 0.03928 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

double contrastOnWhite(const QColor& color) { return 1.05 / (luminance(color) + 0.05); }

// Reads the background brush, for which QCustomPlot has no public getter.
QBrush groundOf(const QCustomPlot& plot) {
  struct Opened : QCustomPlot {
    static QBrush of(const QCustomPlot& whose) { return whose.*(&Opened::mBackgroundBrush); }
  };
  return Opened::of(plot);
}

// Changes the look of a chart and restores it in the destructor.
class Restyled {
 public:
  // `height`: that of the axes and what is around them.
  Restyled(QCustomPlot& plot, const PictureLook& look, const QFont& font, double height)
      : plot_(plot), height_(height) {
    look_ = look;
    font_ = font;
    background_ = groundOf(plot);
    if (look.forPrint) plot.setBackground(QBrush(Qt::white));
    for (QCPAxisRect* rect : plot.axisRects())
      for (QCPAxis* axis : rect->axes()) style(*axis);
    for (int i = 0; i < plot.plottableCount(); ++i) style(*plot.plottable(i));
    for (int i = 0; i < plot.itemCount(); ++i) style(*plot.item(i));
  }
  ~Restyled() {
    for (auto at = undo_.rbegin(); at != undo_.rend(); ++at) (*at)();
    plot_.setBackground(background_);
  }
  Restyled(const Restyled&) = delete;
  Restyled& operator=(const Restyled&) = delete;

 private:
  QPen ink(QPen pen) const {
    if (look_.forPrint && pen.style() != Qt::NoPen) pen.setColor(inkOf(pen.color()));
    return pen;
  }
  QBrush ink(QBrush brush) const {
    if (look_.forPrint && brush.style() != Qt::NoBrush) brush.setColor(inkOf(brush.color()));
    return brush;
  }
  QColor ink(const QColor& color) const { return look_.forPrint ? inkOf(color) : color; }

  // Sets the property that `get` reads to `value`, and stores how to undo it.
  template <class Object, class Get, class Set, class Value>
  void change(Object& object, Get get, Set set, const Value& value) {
    const auto before = (object.*get)();
    (object.*set)(value);
    undo_.emplace_back([&object, set, before] { (object.*set)(before); });
  }

  QCPScatterStyle ink(QCPScatterStyle points) const {
    if (points.isPenDefined()) points.setPen(ink(points.pen()));
    points.setBrush(ink(points.brush()));
    return points;
  }

  void style(QCPAxis& axis) {
    change(axis, &QCPAxis::basePen, &QCPAxis::setBasePen, ink(axis.basePen()));
    change(axis, &QCPAxis::tickPen, &QCPAxis::setTickPen, ink(axis.tickPen()));
    change(axis, &QCPAxis::subTickPen, &QCPAxis::setSubTickPen, ink(axis.subTickPen()));
    change(axis, &QCPAxis::labelColor, &QCPAxis::setLabelColor, ink(axis.labelColor()));
    change(axis, &QCPAxis::tickLabelColor, &QCPAxis::setTickLabelColor, ink(axis.tickLabelColor()));
    change(axis, &QCPAxis::labelFont, &QCPAxis::setLabelFont, font_);
    change(axis, &QCPAxis::tickLabelFont, &QCPAxis::setTickLabelFont, font_);
    // On the screen the chart may have been lower than in the picture.
    constexpr double kAroundAxis = 0.25;  // share of the height that the other axis may take
    const QString whole = axis.property(kWholeNameProperty).toString();
    if (!whole.isEmpty() && !axis.label().isEmpty() &&
        QFontMetricsF(font_).horizontalAdvance(whole) < (1.0 - kAroundAxis) * height_)
      change(axis, &QCPAxis::label, &QCPAxis::setLabel, whole);
    QCPGrid& grid = *axis.grid();
    change(grid, &QCPGrid::pen, &QCPGrid::setPen, ink(grid.pen()));
    change(grid, &QCPGrid::subGridPen, &QCPGrid::setSubGridPen, ink(grid.subGridPen()));
    change(grid, &QCPGrid::zeroLinePen, &QCPGrid::setZeroLinePen, ink(grid.zeroLinePen()));
  }

  void style(QCPAbstractPlottable& curve) {
    change(curve, &QCPAbstractPlottable::pen, &QCPAbstractPlottable::setPen, ink(curve.pen()));
    change(
        curve, &QCPAbstractPlottable::brush, &QCPAbstractPlottable::setBrush, ink(curve.brush()));
    if (auto* graph = qobject_cast<QCPGraph*>(&curve))
      change(
          *graph, &QCPGraph::scatterStyle, &QCPGraph::setScatterStyle, ink(graph->scatterStyle()));
  }

  void style(QCPAbstractItem& item) {
    if (auto* word = qobject_cast<QCPItemText*>(&item)) {
      change(*word, &QCPItemText::color, &QCPItemText::setColor, ink(word->color()));
      change(*word, &QCPItemText::font, &QCPItemText::setFont, font_);
      change(*word, &QCPItemText::pen, &QCPItemText::setPen, ink(word->pen()));
      change(*word, &QCPItemText::brush, &QCPItemText::setBrush, ink(word->brush()));
    } else if (auto* mark = qobject_cast<QCPItemTracer*>(&item)) {
      change(*mark, &QCPItemTracer::pen, &QCPItemTracer::setPen, ink(mark->pen()));
    } else if (auto* rect = qobject_cast<QCPItemRect*>(&item)) {
      change(*rect, &QCPItemRect::pen, &QCPItemRect::setPen, ink(rect->pen()));
      change(*rect, &QCPItemRect::brush, &QCPItemRect::setBrush, ink(rect->brush()));
    } else if (auto* line = qobject_cast<QCPItemLine*>(&item)) {
      change(*line, &QCPItemLine::pen, &QCPItemLine::setPen, ink(line->pen()));
    } else if (auto* straight = qobject_cast<QCPItemStraightLine*>(&item)) {
      change(
          *straight, &QCPItemStraightLine::pen, &QCPItemStraightLine::setPen, ink(straight->pen()));
    }
  }

  QCustomPlot& plot_;
  double height_;
  PictureLook look_;
  QFont font_;
  QBrush background_;
  std::vector<std::function<void()>> undo_;
};

std::vector<ChartLegendEntry> ownNames(const QCustomPlot& plot) {
  std::vector<ChartLegendEntry> entries;
  for (int i = 0; i < plot.graphCount(); ++i)
    if (const QString name = plot.graph(i)->name(); !name.startsWith("Graph "))
      entries.push_back({name, plot.graph(i)->pen()});
  return entries;
}

// QCustomPlot draws points with a painter of its own.
void paintLegendPoint(QPainter& painter,
                      QCPScatterStyle points,
                      const PictureLook& look,
                      const QPointF& at) {
  if (look.forPrint) {
    QPen pen = points.pen();
    pen.setColor(inkOf(pen.color()));
    points.setPen(pen);
    if (points.brush().style() != Qt::NoBrush)
      points.setBrush(QBrush(inkOf(points.brush().color())));
  }
  QPicture picture;
  QCPPainter point(&picture);
  point.setMode(QCPPainter::pmVectorized);
  point.setMode(QCPPainter::pmNonCosmetic);
  points.applyTo(&point, points.pen());
  points.drawShape(&point, at);
  point.end();
  replay(painter, picture);
}

// Paints the legend from `top` downwards, in as many rows as it needs; returns its lower end.
double paintLegend(QPainter& painter,
                   const std::vector<ChartLegendEntry>& entries,
                   const PictureLook& look,
                   const QFont& font,
                   double top,
                   const QColor& text) {
  if (entries.empty()) return top;
  const QFontMetricsF metrics(font);
  const double row = metrics.height() * kLineSpacing;
  double x = kChartPictureMargin;
  painter.setFont(font);
  for (const ChartLegendEntry& entry : entries) {
    const double width =
        kChartPictureLine + kChartPictureGap + metrics.horizontalAdvance(entry.name);
    if (x > kChartPictureMargin && x + width > look.size.width() - kChartPictureMargin) {
      x = kChartPictureMargin;
      top += row;
    }
    if (entry.points) {
      paintLegendPoint(
          painter, *entry.points, look, QPointF(x + kChartPictureLine / 2, top + row / 2));
    } else {
      QPen pen = legendPen(entry.pen, kChartPictureLine);
      if (look.forPrint) pen.setColor(inkOf(pen.color()));
      painter.setPen(pen);
      painter.drawLine(QPointF(x, top + row / 2), QPointF(x + kChartPictureLine, top + row / 2));
    }
    painter.setPen(text);
    painter.drawText(QRectF(x + kChartPictureLine + kChartPictureGap, top, width, row),
                     Qt::AlignLeft | Qt::AlignVCenter | Qt::TextDontClip,
                     entry.name);
    x += width + kEntryGap;
  }
  return top + row;
}

}  // namespace

QColor inkOf(const QColor& color) {
  constexpr std::size_t kMatrices = 6;
  const ThemeColors& paper = colorsOf(Theme::kLight);
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    const ThemeColors& screen = colorsOf(theme);
    for (std::size_t i = 0; i < kMatrices; ++i)
      if (color == matrixColor(i, theme)) return matrixColor(i, Theme::kLight);
    if (color == wholeColor(theme)) return wholeColor(Theme::kLight);
    for (const QColor& ground : {screen.window, screen.panel, screen.raised})
      if (color == ground) return Qt::white;
    for (const QColor& words : {screen.text, screen.muted, screen.border})
      if (color == words) return paper.text;
    const std::pair<QColor, QColor> kin[] = {{screen.grid, paper.grid},
                                             {screen.gap, paper.gap},
                                             {screen.warning, paper.warning},
                                             {screen.danger, paper.danger},
                                             {screen.accent, paper.accent},
                                             {screen.accentSoft, paper.accentSoft}};
    for (const auto& [from, to] : kin)
      if (color == from) return to;
  }
  // Translucent shades work on white as on black.
  if (color.alpha() < 255) return color;
  QColor ink = color;
  while (contrastOnWhite(ink) < kMinContrast) ink = ink.darker(110);
  return ink;
}

namespace {

QFont chartPictureFont(const PictureLook& look, const QCustomPlot& plot) {
  QFont font = plot.font();
  font.setPixelSize(look.textUnits > 0 ? look.textUnits : QFontInfo(plot.font()).pixelSize());
  return font;
}

// Title and legend. Returns their lower end.
double paintHead(QPainter& painter,
                 const PictureLook& look,
                 const QCustomPlot& plot,
                 const ChartPictureOptions& options) {
  const QFont font = chartPictureFont(look, plot);
  const QFontMetricsF metrics(font);
  const QColor text = look.forPrint ? colorsOf(Theme::kLight).text : plot.xAxis->labelColor();
  double top = kChartPictureMargin * 0.6;
  if (look.titled && !(options.title.isEmpty() && options.caption.isEmpty())) {
    const QRectF line(
        kChartPictureMargin, top, look.size.width() - 2 * kChartPictureMargin, metrics.height());
    QFont bold = font;
    bold.setBold(true);
    const double room = line.width() - metrics.horizontalAdvance(options.caption) - kEntryGap;
    painter.setPen(text);
    painter.setFont(bold);
    painter.drawText(line,
                     Qt::AlignLeft | Qt::AlignVCenter,
                     QFontMetricsF(bold).elidedText(options.title, Qt::ElideMiddle, room));
    painter.setFont(font);
    painter.drawText(line, Qt::AlignRight | Qt::AlignVCenter, options.caption);
    top = line.bottom() + kChartPictureGap / 2;
  }
  return paintLegend(
      painter, options.legend.empty() ? ownNames(plot) : options.legend, look, font, top, text);
}

double heightOfHead(const PictureLook& look,
                    const QCustomPlot& plot,
                    const ChartPictureOptions& options) {
  QPicture nowhere;
  QPainter painter(&nowhere);
  return paintHead(painter, look, plot, options);
}

// The axes and their content, below the header.
struct ChartBody {
  QPicture picture;
  QRectF axes = {};  // place of the first ones
  // Of the smallest axes; below 0 where there is none.
  QSizeF smallest = {};
};

ChartBody chartBodyOf(QCustomPlot& plot, const PictureLook& look, double head) {
  ChartBody body;
  // The layout of the picture exists only while it is painted.
  const QMetaObject::Connection laidOut =
      QObject::connect(&plot, &QCustomPlot::afterLayout, &plot, [&] {
        body.axes = plot.axisRect()->rect();
        body.smallest = body.axes.size();
        for (const QCPAxisRect* rect : plot.axisRects())
          body.smallest = {std::min<double>(body.smallest.width(), rect->width()),
                           std::min<double>(body.smallest.height(), rect->height())};
      });
  const Restyled restyled(plot, look, chartPictureFont(look, plot), look.size.height() - head);
  QCPPainter chart(&body.picture);
  chart.setMode(QCPPainter::pmVectorized);
  chart.setMode(QCPPainter::pmNoCaching);
  chart.setMode(QCPPainter::pmNonCosmetic);
  plot.toPainter(&chart,
                 std::max(1, static_cast<int>(look.size.width())),
                 std::max(1, static_cast<int>(look.size.height() - head)));
  chart.end();
  QObject::disconnect(laidOut);
  return body;
}

// How many times larger the picture must be for axes of a length that can be read; 1: it is large
// enough.
double enlargement(const PictureLook& look,
                   const QCustomPlot& plot,
                   double head,
                   const ChartBody& body) {
  const double wanted = kMinAxisLines * QFontMetricsF(chartPictureFont(look, plot)).height();
  // Axes that lie below each other share what is added.
  const auto numAxes = static_cast<double>(plot.axisRectCount());
  const double width = look.size.width() + wanted - body.smallest.width();
  const double height =
      std::max(look.size.height(), head + 1.0) + numAxes * (wanted - body.smallest.height());
  return std::max({1.0, width / look.size.width(), height / look.size.height()});
}

}  // namespace

QRectF paintChart(QPainter& painter,
                  const PictureLook& look,
                  QCustomPlot& plot,
                  const ChartPictureOptions& options) {
  PictureLook inner = look;
  double head = heightOfHead(inner, plot, options);
  ChartBody body = chartBodyOf(plot, inner, head);
  double larger = 1.0;
  // More than once where axes share what is added unevenly.
  constexpr int kMaxTries = 5;
  constexpr double kEnough = 1.001;
  for (int i = 0; i < kMaxTries; ++i) {
    const double factor = enlargement(inner, plot, head, body);
    if (factor < kEnough) break;
    larger *= factor;
    inner.size = look.size * larger;
    head = heightOfHead(inner, plot, options);
    body = chartBodyOf(plot, inner, head);
  }
  painter.save();
  painter.fillRect(QRectF(QPointF(), look.size),
                   look.forPrint ? QBrush(Qt::white) : groundOf(plot));
  painter.scale(1.0 / larger, 1.0 / larger);
  paintHead(painter, inner, plot, options);
  painter.translate(0.0, head);
  replay(painter, body.picture);
  painter.restore();
  // Restores the layout of the screen.
  plot.replot(QCustomPlot::rpQueuedReplot);
  return {(body.axes.topLeft() + QPointF(0.0, head)) / larger, body.axes.size() / larger};
}

}  // namespace palpate::gui
