#include "gui/compare/compare_chart.h"

#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include <palpate/signals/curve_comparison.h>
#include <palpate/signals/min_max_decimation.h>

#include "gui/appearance/difference_map.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr double kCompareChartShortestSeenS = 0.05;
constexpr double kLongestSeenS = 1e9;
constexpr double kCompareChartHeadroom = 1.06;  // the highest curve stays below the upper edge

double compareChartLargestOf(const std::shared_ptr<const Series>& series) {
  double largest = 0.0;
  if (series)
    for (const double value : series->values)
      if (value > largest) largest = value;
  return largest;
}

constexpr double kOverlaidWidth = 1.1;
constexpr double kAverageWidth = 2.6;
constexpr int kOverlaidOpacity = 150;  // of 255
constexpr int kBandOpacity = 45;       // of 255
constexpr std::size_t kMaxInTip = 12;

QPen overlaidPen(std::size_t recording) {
  QColor color = recording == 0   ? sideColor(CompareSide::kA)
                 : recording == 1 ? sideColor(CompareSide::kB)
                                  : matrixColor(recording);
  color.setAlpha(kOverlaidOpacity);
  return QPen(color, kOverlaidWidth);
}

// The samples before gaps, of a curve whose samples have other times than the frames.
std::vector<std::size_t> gapsOf(const Series& series, double longestS) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i + 1 < series.timeS.size(); ++i)
    if (series.timeS[i + 1] - series.timeS[i] > longestS) gaps.push_back(i);
  return gaps;
}

std::vector<std::size_t> gapFramesOf(const std::shared_ptr<const TimedProfile>& timed) {
  std::vector<std::size_t> frames;
  if (timed)
    for (const Gap& gap : timed->timing.gaps) frames.push_back(gap.frame);
  return frames;
}

}  // namespace

CompareChart::CompareChart(QWidget* parent) : Chart(parent) {
  setAccessibleName("Curves of A and B");
  xAxis->setLabel("time from A's first frame in s");
  addCursor();
  connect(this, &QCustomPlot::afterReplot, this, [this] { emit rangeChanged(); });
  restyle();
}

TimeSpan CompareChart::whole() const {
  if (!curves_.a || !curves_.b) return {0.0, 1.0};
  if (curves_.overlaid.span && curves_.overlaid.span->lengthS() >= kCompareChartShortestSeenS)
    return *curves_.overlaid.span;
  TimeSpan span = wholeSpan(*curves_.a, *curves_.b, curves_.offsetS);
  if (span.lengthS() < kCompareChartShortestSeenS) span.toS = span.fromS + 1.0;
  return span;
}

void CompareChart::setCurves(const CompareCurves& curves) {
  // Another pair comes after no pair at all.
  const bool otherPair = !curves_.a != !curves.a || !curves_.b != !curves.b ||
                         curves.overlaid.span != curves_.overlaid.span;
  curves_ = curves;
  const auto longestOf = [&curves](const std::shared_ptr<const Series>& series) {
    return curves.column && series ? gapOfTimesS(series->timeS) : 0.0;
  };
  longestA_ = longestOf(curves.curveA);
  longestB_ = longestOf(curves.curveB);
  rebuild();
  if (otherPair) fit();
}

void CompareChart::setOffset(double offsetS) {
  if (offsetS == curves_.offsetS) return;
  curves_.offsetS = offsetS;
  refill();
}

void CompareChart::settle() {
  if (fitted_) fit();
}

QString CompareChart::axisName() const {
  if (curves_.column) return fittingName(curves_.column->axis, curves_.column->unit, *this);
  return signalAxisName(curves_.signal, curves_.handUnit, *this, curves_.units);
}

void CompareChart::rebuild() {
  clearGraphs();
  clearItems();
  contact_ = nullptr;
  yAxis->setLabel(axisName());
  for (const CompareSide side : {CompareSide::kA, CompareSide::kB}) {
    QCPGraph* graph = addGraph();
    QPen pen(sideColor(side), 1.6);
    if (side == CompareSide::kB) pen.setStyle(Qt::DashLine);
    graph->setPen(pen);
    graph->setName(side == CompareSide::kA ? "A" : "B");
    // The points are already decimated.
    graph->setAdaptiveSampling(false);
  }
  addOverlaid();
  double largest =
      std::max(compareChartLargestOf(curves_.curveA), compareChartLargestOf(curves_.curveB));
  for (const OverlaidCurve& each : curves_.overlaid.curves)
    largest = std::max(largest, compareChartLargestOf(each.curve.series));
  for (const OverlaidAverage& each : curves_.overlaid.averages)
    for (const double high : each.curve->high)
      if (high > largest) largest = high;
  const UnitConversion to = shown().conversion;
  // Only columns go below 0.
  double least = 0.0;
  const auto lower = [&](const std::vector<double>& values) {
    for (const double value : values) least = std::min(least, std::isnan(value) ? least : value);
  };
  if (curves_.column) {
    for (const auto& series : {curves_.curveA, curves_.curveB})
      if (series) lower(series->values);
    for (const OverlaidCurve& each : curves_.overlaid.curves) lower(each.curve.series->values);
    for (const OverlaidAverage& each : curves_.overlaid.averages) lower(each.curve->low);
  }
  yAxis->setRange(to.of(least * kCompareChartHeadroom),
                  to.of(largest > 0.0 || least < 0.0 ? largest * kCompareChartHeadroom : 1.0));
  if (curves_.a && curves_.a->contact) {
    contact_ = new QCPItemStraightLine(this);
    contact_->setPen(QPen(colorsOf().muted, 1.0, Qt::DotLine));
    const double at = curves_.a->timeS(*curves_.a->contact);
    contact_->point1->setCoords(at, 0.0);
    contact_->point2->setCoords(at, 1.0);
    wordAt(*this, at, " first contact in A", Qt::AlignLeft, colorsOf().muted);
  }
  refill();
}

void CompareChart::addOverlaid() {
  overlaidGraphs_.clear();
  averageGraphs_.clear();
  const ComparedCurves& overlaid = curves_.overlaid;
  for (std::size_t i = 0; i < overlaid.curves.size(); ++i) {
    if (!overlaid.curves[i].drawn) continue;
    QCPGraph* graph = addGraph();
    graph->setPen(overlaidPen(overlaid.curves[i].recording));
    graph->setAdaptiveSampling(false);
    overlaidGraphs_.emplace_back(i, graph);
  }
  for (const OverlaidAverage& each : overlaid.averages) addAverage(each);
}

void CompareChart::addAverage(const OverlaidAverage& of) {
  // Averages of several recordings have the colours of their curves.
  QColor ink = colorsOf().text;
  if (curves_.overlaid.averages.size() > 1) ink = overlaidPen(of.recording).color();
  ink.setAlpha(255);
  QColor shade = ink;
  shade.setAlpha(kBandOpacity);
  std::array<QCPGraph*, 3> graphs = {};
  for (QCPGraph*& graph : graphs) {
    graph = addGraph();
    graph->setPen(Qt::NoPen);
  }
  graphs[1]->setBrush(shade);
  graphs[1]->setChannelFillGraph(graphs[0]);
  graphs[2]->setPen(QPen(ink, kAverageWidth));
  const AverageCurve& average = *of.curve;
  const UnitConversion to = shown().conversion;
  const std::array columns = {&average.low, &average.high, &average.middle};
  for (std::size_t which = 0; which < columns.size(); ++which) {
    QVector<QCPGraphData> samples;
    for (std::size_t i = 0; i < average.timeS.size(); ++i)
      samples.append({average.timeS[i] + curves_.overlaid.zeroS, to.of((*columns[which])[i])});
    graphs[which]->data()->set(samples, true);
  }
  averageGraphs_.push_back(graphs);
}

void CompareChart::fillOverlaid() {
  const QCPRange range = xAxis->range();
  const UnitConversion to = shown().conversion;
  for (const auto& [index, graph] : overlaidGraphs_) {
    const AlignedCurve& curve = curves_.overlaid.curves[index].curve;
    const double shiftS = curves_.overlaid.zeroS - curve.zeroS;
    const auto& timeS = curve.series->timeS;
    const std::vector<std::size_t> gaps = gapsOf(*curve.series, curve.longestS);
    const DecimationOptions options{.from = std::max(range.lower - shiftS, curve.fromS),
                                    .to = std::min(range.upper - shiftS, curve.toS),
                                    .columns = static_cast<std::size_t>(std::max(1, width())),
                                    .breaks = gaps};
    QVector<QCPGraphData> samples;
    if (options.from < options.to)
      for (const SeriesPoint& point : minMaxDecimated(timeS, curve.series->values, options))
        if (std::isnan(point.x) || (point.x >= curve.fromS && point.x <= curve.toS))
          samples.append({point.x + shiftS, to.of(point.y)});
    graph->data()->set(samples, true);
  }
}

std::vector<ChartLegendEntry> CompareChart::legendOf(const QString& nameA,
                                                     const QString& nameB) const {
  std::vector<ChartLegendEntry> entries = {{"A  " + nameA, graph(0)->pen()},
                                           {"B  " + nameB, graph(1)->pen()}};
  const ComparedCurves& overlaid = curves_.overlaid;
  std::vector<std::size_t> named;
  for (const auto& [index, graph] : overlaidGraphs_) {
    const OverlaidCurve& each = overlaid.curves[index];
    if (std::find(named.begin(), named.end(), each.recording) != named.end()) continue;
    named.push_back(each.recording);
    const bool grasps = each.name.contains(", grasp ");
    entries.push_back(
        {grasps ? "grasps of " + each.name.section(", grasp ", 0, 0) : each.name, graph->pen()});
  }
  for (std::size_t i = 0; i < averageGraphs_.size(); ++i) {
    const OverlaidAverage& of = overlaid.averages[i];
    entries.push_back({gui::nameOf(overlaid.band) + " of " + QString::number(of.numCurves) +
                           (averageGraphs_.size() > 1 ? ", " + of.of : QString()),
                       averageGraphs_[i][2]->pen()});
  }
  return entries;
}

void CompareChart::refill() {
  const QCPRange range = xAxis->range();
  const UnitConversion to = shown().conversion;
  const auto fill = [&](int index,
                        const std::shared_ptr<const Series>& series,
                        const std::vector<std::size_t>& gaps,
                        double shiftS) {
    QVector<QCPGraphData> samples;
    if (series) {
      const DecimationOptions options{.from = range.lower - shiftS,
                                      .to = range.upper - shiftS,
                                      .columns = static_cast<std::size_t>(std::max(1, width())),
                                      .breaks = gaps};
      const auto points = minMaxDecimated(series->timeS, series->values, options);
      samples.reserve(static_cast<qsizetype>(points.size()));
      for (const SeriesPoint& point : points) samples.append({point.x + shiftS, to.of(point.y)});
    }
    // A single sample makes no line: it is drawn as a dot.
    const bool dot = series && series->timeS.size() == 1;
    graph(index)->setScatterStyle(dot ? QCPScatterStyle(QCPScatterStyle::ssDisc, 7)
                                      : QCPScatterStyle(QCPScatterStyle::ssNone));
    graph(index)->data()->set(samples, true);
  };
  const auto gaps = [this](const std::shared_ptr<const Series>& series,
                           const std::shared_ptr<const TimedProfile>& timed,
                           double longestS) {
    return curves_.column && series ? gapsOf(*series, longestS) : gapFramesOf(timed);
  };
  fill(0, curves_.curveA, gaps(curves_.curveA, curves_.a, longestA_), 0.0);
  fill(1, curves_.curveB, gaps(curves_.curveB, curves_.b, longestB_), curves_.offsetS);
  fillOverlaid();
  replot(QCustomPlot::rpQueuedReplot);
}

void CompareChart::setPosition(double seconds) {
  const auto page = pageWith(seconds);
  if (!fitted_ && drag_ == Drag::kNone && page) setVisibleRange(page->lower, page->upper);
  Chart::setPosition(seconds);
}

void CompareChart::setVisibleRange(double from, double to) {
  const TimeSpan all = whole();
  const double span =
      std::clamp(to - from, kCompareChartShortestSeenS, std::min(all.lengthS(), kLongestSeenS));
  const double start = std::clamp(from, all.fromS, all.toS - span);
  xAxis->setRange(start, start + span);
  fitted_ = span >= all.lengthS() * (1.0 - 1e-9);
  refill();
}

void CompareChart::fit() {
  const TimeSpan all = whole();
  setVisibleRange(all.fromS, all.toS);
}

void CompareChart::zoomAbout(double seconds, double factor) {
  const QCPRange range = zoomed(seconds, factor, kCompareChartShortestSeenS, whole().lengthS());
  setVisibleRange(range.lower, range.upper);
}

void CompareChart::mousePressEvent(QMouseEvent* event) {
  dragFromPixel_ = event->position().x();
  dragFromRange_ = xAxis->range();
  dragFromOffsetS_ = curves_.offsetS;
  const bool left = event->button() == Qt::LeftButton;
  if (event->button() == Qt::MiddleButton || (left && event->modifiers() & Qt::ShiftModifier)) {
    drag_ = Drag::kPan;
    setCursor(Qt::ClosedHandCursor);
  } else if (left && event->modifiers() & Qt::ControlModifier) {
    drag_ = Drag::kShift;
    setCursor(Qt::SizeHorCursor);
  } else if (left) {
    drag_ = Drag::kSeek;
    emit seekRequested(secondsAt(event->position().x()));
  }
}

void CompareChart::mouseMoveEvent(QMouseEvent* event) {
  const double perPixel = dragFromRange_.size() / std::max(1, axisRect()->width());
  const double moved = (event->position().x() - dragFromPixel_) * perPixel;
  switch (drag_) {
    case Drag::kSeek:
      emit seekRequested(secondsAt(event->position().x()));
      break;
    case Drag::kPan:
      setVisibleRange(dragFromRange_.lower - moved, dragFromRange_.upper - moved);
      break;
    case Drag::kShift:
      emit shifted(dragFromOffsetS_ + moved);
      break;
    case Drag::kNone:
      break;
  }
}

void CompareChart::mouseReleaseEvent(QMouseEvent*) {
  const bool shifting = drag_ == Drag::kShift;
  drag_ = Drag::kNone;
  unsetCursor();
  if (shifting) emit shiftEnded();
}

void CompareChart::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) fit();
}

void CompareChart::panBy(double seconds) {
  const QCPRange range = xAxis->range();
  setVisibleRange(range.lower + seconds, range.upper + seconds);
}

void CompareChart::resized() {
  yAxis->setLabel(axisName());
  constexpr int kLow = 130;  // [px]; lower: fewer ticks
  yAxis->ticker()->setTickCount(height() < kLow ? 2 : 4);
  refill();
}

QString CompareChart::valuesAt(double seconds) const {
  if (!curves_.a || !curves_.b) return {};
  QString text = QString::number(seconds, 'f', 2) + " s";
  const ShownUnit unit = shown();
  const auto line = [&](const char* name,
                        const TimedProfile& timed,
                        const std::shared_ptr<const Series>& series,
                        double longestS,
                        double at) {
    text += "\n" + QString(name) + "  ";
    if (curves_.column) {
      const auto sample = series ? sampleAt(*series, at, longestS) : std::nullopt;
      const bool isKnown = sample && std::isfinite(series->values[*sample]);
      return text += isKnown ? unit.text(series->values[*sample], 1) : QString("–"), void();
    }
    const auto frame = timed.frameAt(at);
    if (!frame || !series || *frame >= series->values.size()) return text += "no frame", void();
    const double value = series->values[*frame];
    text += (std::isfinite(value) ? unit.text(value, 1) : QString("damaged")) + " · frame " +
            QString::number(*frame);
  };
  line("A", *curves_.a, curves_.curveA, longestA_, seconds);
  line("B", *curves_.b, curves_.curveB, longestB_, seconds - curves_.offsetS);
  const ComparedCurves& overlaid = curves_.overlaid;
  const std::vector<double> now = {seconds - overlaid.zeroS};
  for (std::size_t i = 0; i < std::min(overlaidGraphs_.size(), kMaxInTip); ++i) {
    const OverlaidCurve& each = overlaid.curves[overlaidGraphs_[i].first];
    const double value = alignedValues(each.curve, now).front();
    if (std::isfinite(value)) text += "\n" + each.name + "  " + unit.text(value, 1);
  }
  if (overlaidGraphs_.size() > kMaxInTip)
    text += "\n… " + QString::number(overlaidGraphs_.size()) + " curves";
  for (const OverlaidAverage& of : overlaid.averages) {
    const AverageCurve& average = *of.curve;
    const auto at = placeIn(average, now.front());
    if (at && std::isfinite(average.middle[*at]))
      text += "\n" + gui::nameOf(overlaid.band) + "  " + unit.number(average.middle[*at], 1) +
              " (" + unit.number(average.low[*at], 1) + " … " + unit.number(average.high[*at], 1) +
              ") " + unit.symbol + " of " + QString::number(average.count[*at]) +
              (overlaid.averages.size() > 1 ? ", " + of.of : QString());
  }
  return text;
}

}  // namespace palpate::gui
