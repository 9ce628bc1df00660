#include "gui/chart/chart_style.h"

#include <algorithm>
#include <numeric>

#include "gui/chart/plot.h"

namespace palpate::gui {
namespace {

void styleAxis(QCPAxis& axis, const ThemeColors& colors, const QFont& font) {
  axis.setBasePen(QPen(colors.border));
  axis.setTickPen(QPen(colors.border));
  axis.setSubTickPen(Qt::NoPen);
  axis.setTickLabelColor(colors.muted);
  axis.setLabelColor(colors.muted);
  axis.setTickLabelFont(font);
  axis.setLabelFont(font);
  axis.grid()->setPen(QPen(colors.grid));
  axis.grid()->setZeroLinePen(QPen(colors.grid));
  axis.grid()->setSubGridVisible(false);
}

// Numbers that would lie on each other in a low or narrow chart are left out.
void fitTicks(QCustomPlot& plot) {
  constexpr int kMaxAlong = 4, kMaxAcross = 9;
  const int line = plot.fontMetrics().lineSpacing();
  constexpr int kNumberWidth = 62;  // [px] with a gap
  bool changed = false;
  const auto fit = [&changed](QCPAxis* axis, int count) {
    if (!axis->visible() || axis->ticker()->tickCount() == count ||
        axis->ticker().dynamicCast<QCPAxisTickerFixed>())
      return;
    axis->ticker()->setTickCount(count);
    changed = true;
  };
  for (QCPAxisRect* rect : plot.axisRects()) {
    const int along = std::clamp(2 * rect->height() / (3 * line), 1, kMaxAlong);
    const int across = std::clamp(rect->width() / kNumberWidth, 2, kMaxAcross);
    for (QCPAxis* axis : rect->axes(QCPAxis::atLeft | QCPAxis::atRight)) fit(axis, along);
    for (QCPAxis* axis : rect->axes(QCPAxis::atBottom)) fit(axis, across);
  }
  if (changed) plot.replot(QCustomPlot::rpQueuedReplot);
}

// Gives the space left of the chart another width with another size of text.
void fitLeft(QCustomPlot& plot) {
  QMargins margins = plot.axisRect()->minimumMargins();
  const int left = timeAxisLeft(plot);
  if (margins.left() == left) return;
  margins.setLeft(left);
  plot.axisRect()->setMinimumMargins(margins);
  plot.replot(QCustomPlot::rpQueuedReplot);
}

// Makes x a time on the axis, and y a share of the height.
void anchor(QCPItemPosition& position) {
  position.setTypeX(QCPItemPosition::ptPlotCoords);
  position.setTypeY(QCPItemPosition::ptAxisRectRatio);
}

}  // namespace

void arrangeChart(QCustomPlot& plot) {
  plot.setLocale(QLocale::c());
  plot.setPlottingHint(QCP::phFastPolylines, true);
  // A queued replot then only marks the chart, and is painted together with all else that changed.
  // Otherwise it paints at once, and the window is brought to the screen for each chart.
  plot.setPlottingHint(QCP::phImmediateRefresh, false);
  plot.xAxis->ticker()->setTickCount(9);
  plot.yAxis->ticker()->setTickCount(4);
  plot.xAxis->grid()->setVisible(false);
  plot.xAxis->setNumberFormat("gb");
  plot.yAxis->setNumberFormat("gb");
  plot.xAxis->setTickLengthIn(0);
  plot.yAxis->setTickLengthIn(0);
  plot.xAxis->setTickLengthOut(4);
  plot.axisRect()->setMinimumMargins(QMargins(timeAxisLeft(plot), 10, 20, 10));
  QObject::connect(&plot, &QCustomPlot::afterLayout, &plot, [&plot] {
    fitTicks(plot);
    fitLeft(plot);
  });
}

int timeAxisLeft(const QWidget& plot) {
  constexpr int kAround = 18;  // [px] ticks and gaps
  const QFontMetrics metrics = plot.fontMetrics();
  return metrics.horizontalAdvance("00000") + metrics.lineSpacing() + kAround;
}

void styleChart(QCustomPlot& plot) {
  const ThemeColors& colors = colorsOf();
  plot.setBackground(QBrush(colors.window));
  styleAxis(*plot.xAxis, colors, plot.font());
  styleAxis(*plot.yAxis, colors, plot.font());
}

QPen legendPen(QPen pen, double length) {
  if (pen.style() != Qt::CustomDashLine) return pen;
  QList<qreal> dashes = pen.dashPattern();
  const double whole = std::accumulate(dashes.begin(), dashes.end(), 0.0) * pen.widthF();
  for (qreal& each : dashes) each *= length / whole;
  pen.setDashPattern(dashes);
  return pen;
}

QPen curvePen(std::size_t matrix, bool whole) {
  QPen pen(whole ? wholeColor() : matrixColor(matrix), 1.4);
  if (whole) pen.setStyle(Qt::DashLine);
  return pen;
}

QString fittingName(const QString& name, const QString& shortName, const QWidget& plot) {
  constexpr int kAroundAxis = 26;  // [px] margins and ticks
  // Below it are the numbers and the title of the other axis.
  const int lines = isLow(plot) ? 1 : 2;
  const QFontMetrics metrics = plot.fontMetrics();
  const int room = plot.height() - kAroundAxis - lines * metrics.lineSpacing();
  if (metrics.horizontalAdvance(name) < room) return name;
  return metrics.horizontalAdvance(shortName) < room ? shortName : QString();
}

bool isLow(const QWidget& plot) {
  constexpr int kLines = 7;
  return plot.height() < kLines * plot.fontMetrics().lineSpacing();
}

QCPItemText* unitInCorner(QCustomPlot& plot, const QString& unit, Qt::Alignment corner) {
  constexpr int kAround = 3;  // [px]
  auto* word = new QCPItemText(&plot);
  word->position->setType(QCPItemPosition::ptAxisRectRatio);
  word->position->setCoords(corner & Qt::AlignRight ? 1.0 : 0.0,
                            corner & Qt::AlignBottom ? 1.0 : 0.0);
  word->setPositionAlignment(corner);
  word->setPadding(QMargins(kAround, 0, kAround, 0));
  word->setText(unit);
  word->setFont(plot.font());
  word->setColor(colorsOf().muted);
  QColor behind = colorsOf().window;
  behind.setAlphaF(0.7F);
  word->setBrush(behind);
  return word;
}

QString signalAxisName(PlottedSignal signal,
                       const QString& handUnit,
                       const QWidget& plot,
                       const DisplayUnits& units) {
  QString whole = nameOf(signal);
  const QString unit = shownUnit(signal, handUnit, units).symbol;
  if (!whole.endsWith(unit)) whole += " in " + unit;
  return fittingName(whole, unit, plot);
}

void styleExtraAxis(QCPAxis& axis, const QWidget& plot) {
  styleAxis(axis, colorsOf(), plot.font());
  axis.grid()->setVisible(false);
  axis.ticker()->setTickCount(4);
  axis.setNumberFormat("gb");
  axis.setTickLengthIn(0);
  axis.setTickLengthOut(4);
}

QCPItemRect* shadeSpan(QCustomPlot& plot, double beginS, double endS) {
  auto* shade = new QCPItemRect(&plot);
  anchor(*shade->topLeft);
  anchor(*shade->bottomRight);
  shade->topLeft->setCoords(beginS, 0.0);
  shade->bottomRight->setCoords(endS, 1.0);
  shade->setPen(Qt::NoPen);
  shade->setBrush(colorsOf().gap);
  shade->setLayer("background");
  return shade;
}

QCPItemRect* shadeGap(QCustomPlot& plot, double beginS, double endS) {
  QCPItemRect* shade = shadeSpan(plot, beginS, endS);
  QColor edge = colorsOf().gap;
  edge.setAlpha(3 * edge.alpha());
  shade->setPen(edge);
  return shade;
}

QCPItemText* wordAt(
    QCustomPlot& plot, double atS, const QString& text, Qt::Alignment side, const QColor& color) {
  // Share of the height.
  constexpr double kTop = 0.04;
  auto* word = new QCPItemText(&plot);
  anchor(*word->position);
  word->position->setCoords(atS, kTop);
  word->setPositionAlignment(side | Qt::AlignTop);
  word->setText(text);
  word->setFont(plot.font());
  word->setColor(color);
  return word;
}

}  // namespace palpate::gui
