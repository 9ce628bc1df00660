#include "gui/timeline/timeline_chart.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/chart/chart_style.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"
#include "gui/window_state/selection.h"

namespace palpate::gui {
namespace {

// Opacity of the curves drawn behind, of 255.
constexpr int kTimelineChartFaint = 110;
// Length of the axis for a recording without duration [s].
constexpr double kEmptyDurationS = 1.0;
// Margin beside a shown span, as a share of it.
constexpr double kTimelineChartAir = 0.08;
// Gaps that are marked, and likewise runs of unreadable frames.
constexpr std::size_t kMaxGapMarks = 2000;
// A view of later times shows h:min:s [s].
constexpr double kTimelineChartLongestInS = 1200.0;
// Below this visible duration [s] ticks need fractions of a second.
constexpr double kFewSecondsS = 8.0;

}  // namespace

TimelineChart::TimelineChart(QWidget* parent)
    : Chart(parent), axes_(std::make_unique<UnitAxes>(*this)), span_(this) {
  setAccessibleName("Timeline");
  fitToText(*this, [this] { setMinimumHeight(kMinChartLines * fontMetrics().lineSpacing()); });
  secondsTicker_ = xAxis->ticker();
  clockTicker_.reset(new QCPAxisTickerTime);
  clockTicker_->setTickCount(secondsTicker_->tickCount());
  nameTime();
  addCursor();
  notes_ = makeLines(this, "chartNotes");
  notes_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  notes_->setAttribute(Qt::WA_TransparentForMouseEvents);
  notes_->hide();
  const auto rescale = [this] {
    scaleAxes();
    replot(QCustomPlot::rpQueuedReplot);
  };
  connect(axes_.get(), &UnitAxes::byHandChanged, this, rescale);
  connect(axes_.get(), &UnitAxes::logarithmicChanged, this, rescale);
  // Margins are known only after the axes have been laid out.
  connect(this, &QCustomPlot::afterReplot, this, [this] {
    placeSelection();
    placeNotes();
    emit seenChanged();
  });
  connect(&before_, &SeriesStore::changed, this, [this] {
    scaleAxes();
    refill();
  });
  connect(&store_, &SeriesStore::changed, this, [this] {
    if (recording_ && (recording_->timingNow().gaps.size() != gaps_.size() ||
                       recording_->unreadableNow().count != numUnreadable_))
      return rebuildGraphs();
    scaleAxes();
    refill();
  });
  restyle();
}

double TimelineChart::durationS() const {
  if (!recording_ || recording_->profile.numFrames() == 0) return kEmptyDurationS;
  return std::max(recording_->durationS(), Selection::kShortestS);
}

void TimelineChart::setRecording(const OpenedRecordingPtr& recording) {
  if (recording == recording_ && recording_) return;
  recording_ = recording;
  rangesOfOther_.clear();
  for (const auto& [unit, range] : axes_->byHand()) rangesOfOther_.insert(unit);
  drag_ = Drag::kNone;
  curves_.clear();
  store_.setRecording(recording);
  Chart::setPosition(recording_ ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  setSelection(std::nullopt);
  rebuildGraphs();
  fit();
}

void TimelineChart::setBefore(const OpenedRecordingPtr& before) {
  hasBefore_ = before && !before->isLong();
  before_.setRecording(hasBefore_ ? before : nullptr);
  std::vector<SeriesChoice> wanted;
  for (const PlottedCurve& curve : curves_) wanted.push_back(curve.choice);
  before_.setWanted(wanted);
  rebuildGraphs();
}

void TimelineChart::setCurves(const std::vector<PlottedCurve>& curves) {
  curves_ = curves;
  std::vector<SeriesChoice> wanted;
  for (const PlottedCurve& curve : curves_) wanted.push_back(curve.choice);
  store_.setWanted(wanted);
  before_.setWanted(wanted);
  rebuildGraphs();
}

void TimelineChart::setNotes(const QStringList& notes) {
  notes_->setText(notes.join("\n"));
  notes_->setVisible(!notes.isEmpty());
  placeNotes();
}

void TimelineChart::placeNotes() {
  constexpr int kAround = 6;  // [px]
  const QRect plot = axisRect()->rect().adjusted(kAround, kAround, -kAround, -kAround);
  if (notes_->isHidden() || plot.isEmpty()) return;
  int top = plot.top();
  for (const QCPItemText* label : gapLabels_)
    if (label->visible())
      top = std::max(top, static_cast<int>(std::ceil(label->bottom->pixelPosition().y())));
  const int height = std::min(plot.bottom() + 1 - top, notes_->heightForWidth(plot.width()));
  notes_->setGeometry(plot.left(), top, plot.width(), std::max(0, height));
}

void TimelineChart::setRight(int px) {
  QMargins margins = axisRect()->minimumMargins();
  constexpr int kUsualRight = 20;  // [px]
  margins.setRight(std::max(px, kUsualRight));
  if (margins == axisRect()->minimumMargins()) return;
  axisRect()->setMinimumMargins(margins);
  replot(QCustomPlot::rpQueuedReplot);
}

void TimelineChart::style() {
  span_.restyle();
  notes_->setStyleSheet("background: transparent; color: " + colorsOf().warning.name());
  rebuildGraphs();
}

void TimelineChart::rebuildGraphs() {
  clearGraphs();
  clearItems();
  gapLabels_.clear();
  axes_->rebuild(curves_);
  nameTime();
  for (const PlottedCurve& curve : curves_) {
    QCPGraph* added = addGraph(xAxis, axes_->of(curve.unit));
    added->setPen(curve.pen);
    // The points are decimated already.
    added->setAdaptiveSampling(false);
  }
  for (const PlottedCurve& curve : hasBefore_ ? curves_ : std::vector<PlottedCurve>()) {
    QCPGraph* behind = addGraph(xAxis, axes_->of(curve.unit));
    QPen faint = curve.pen;
    QColor color = faint.color();
    color.setAlpha(kTimelineChartFaint);
    faint.setColor(color);
    faint.setWidthF(1.0);
    behind->setPen(faint);
    behind->setLayer("grid");
    behind->setAdaptiveSampling(false);
  }
  gaps_.clear();
  if (recording_) gaps_ = recording_->timingNow().gaps;
  for (std::size_t i = 0; i < std::min(gaps_.size(), kMaxGapMarks); ++i) {
    const double begin = recording_->timeAt(gaps_[i].frame);
    shadeGap(*this, begin, begin + gaps_[i].seconds);
    gapLabels_.push_back(wordAt(*this,
                                begin + gaps_[i].seconds / 2,
                                "gap " + QString::number(gaps_[i].seconds, 'f', 1) + " s",
                                Qt::AlignHCenter,
                                colorsOf().warning));
  }
  numUnreadable_ = recording_ ? recording_->unreadableNow().count : 0;
  if (numUnreadable_ > 0) shadeUnreadable();
  scaleAxes();
  refill();
}

// Damaged parts look like gaps: from the last frame before each to the first one behind it.
void TimelineChart::shadeUnreadable() {
  const auto& runs = recording_->unreadableNow().runs;
  const std::size_t last = recording_->profile.numFrames() - 1;
  for (std::size_t i = 0; i < std::min(runs.size(), kMaxGapMarks); ++i)
    shadeGap(*this,
             recording_->timeAt(runs[i].first > 0 ? runs[i].first - 1 : 0),
             recording_->timeAt(std::min(runs[i].last + 1, last)));
}

// Axes begin at zero unless values are below; those of angles and temperatures begin at their
// lowest value. Ranges are fitted in base units: a chart looks the same in all units.
void TimelineChart::scaleAxes() {
  for (const QString& unit : axes_->units()) {
    std::optional<ValueExtent> extent;
    for (const PlottedCurve& curve : curves_) {
      if (curve.unit != unit) continue;
      auto its = store_.extremes(curve.choice);
      if (!its) continue;
      if (const auto before = before_.extremes(curve.choice))
        its = {std::min(its->first, before->first), std::max(its->second, before->second)};
      its = {curve.conversion.of(its->first), curve.conversion.of(its->second)};
      if (!extent) extent = ValueExtent{its->first, its->second};
      extent->low = std::min(extent->low, its->first);
      extent->high = std::max(extent->high, its->second);
    }
    if (extent) dropRangeOfOther(unit, *extent);
    const UnitConversion shown = axes_->conversionOf(unit);
    if (extent) extent = ValueExtent{shown.back(extent->low), shown.back(extent->high)};
    const AxisRange range = fittedRange(extent, axes_->fromZero(unit), axes_->minExtent(unit));
    axes_->setAutomatic(unit, {shown.of(range.from), shown.of(range.to)});
  }
}

void TimelineChart::dropRangeOfOther(const QString& unit, const ValueExtent& shown) {
  if (!rangesOfOther_.contains(unit)) return;
  const auto found = axes_->byHand().find(unit);
  if (found == axes_->byHand().end()) {
    rangesOfOther_.erase(unit);
    return;
  }
  const AxisRange range = found->second;
  const bool inside = shown.low <= range.to && range.from <= shown.high;
  // Of a long recording more values follow.
  if (!inside && recording_->isLong() && store_.progress() < 1.0) return;
  rangesOfOther_.erase(unit);
  if (inside) return;
  const QString name = axes_->nameOf(unit);
  axes_->setByHand(unit, std::nullopt);
  emit rangeDropped(name, range);
}

void TimelineChart::refill() {
  // The store may have news of curves whose graphs don't exist yet: rebuilding fills those.
  if (static_cast<std::size_t>(graphCount()) < curves_.size() * (hasBefore_ ? 2 : 1)) return;
  const QCPRange range = xAxis->range();
  const DecimationOptions options{.from = range.lower,
                                  .to = range.upper,
                                  .columns = static_cast<std::size_t>(std::max(1, width()))};
  const auto fill = [&](const SeriesStore& store, std::size_t first) {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const auto points = store.points(curves_[i].choice, options);
      QVector<QCPGraphData> samples;
      samples.reserve(static_cast<qsizetype>(points.size()));
      const UnitConversion& shown = curves_[i].conversion;
      for (const SeriesPoint& point : points) samples.append({point.x, shown.of(point.y)});
      graph(static_cast<int>(first + i))->data()->set(samples, true);
    }
  };
  fill(store_, 0);
  if (hasBefore_) fill(before_, curves_.size());
  showGapLabels();
  replot(QCustomPlot::rpQueuedReplot);
}

// Shows a label only in gaps that are wide enough for it.
void TimelineChart::showGapLabels() {
  for (std::size_t i = 0; i < gapLabels_.size(); ++i) {
    const double begin = recording_->timeAt(gaps_[i].frame);
    const double widthPx = pixelOf(begin + gaps_[i].seconds) - pixelOf(begin);
    gapLabels_[i]->setVisible(widthPx > fontMetrics().horizontalAdvance(gapLabels_[i]->text()) + 6);
  }
}

void TimelineChart::setPosition(double seconds) {
  const auto page = pageWith(seconds);
  if (recording_ && drag_ == Drag::kNone && page) setVisibleRange(page->lower, page->upper);
  Chart::setPosition(recording_ ? seconds : std::numeric_limits<double>::quiet_NaN());
}

void TimelineChart::setSelection(std::optional<TimeSpan> span) {
  if (span && !recording_) span.reset();
  if (span) {
    const auto [low, high] = std::minmax(span->fromS, span->toS);
    span = TimeSpan{std::clamp(low, 0.0, durationS()), std::clamp(high, 0.0, durationS())};
  }
  if (span == selection_) return;
  selection_ = span;
  placeSelection();
  emit selectionChanged();
}

void TimelineChart::placeSelection() {
  const auto pixel = [&](double TimeSpan::*end) {
    return selection_ ? std::optional(pixelOf((*selection_).*end)) : std::nullopt;
  };
  span_.place(axisRect()->rect(), pixel(&TimeSpan::fromS), pixel(&TimeSpan::toS));
}

void TimelineChart::setVisibleRange(double from, double to) {
  const double duration = durationS();
  const double span = std::clamp(to - from, std::min(Selection::kShortestS, duration), duration);
  const double start = std::clamp(from, 0.0, duration - span);
  xAxis->setRange(start, start + span);
  nameTime();
  store_.setVisibleRange(start, start + span);
  before_.setVisibleRange(start, start + span);
  refill();
}

// Long times are shown in hours and minutes, not in seconds.
void TimelineChart::nameTime() {
  const bool seconds = seen().upper <= kTimelineChartLongestInS;
  if (seconds)
    xAxis->setTicker(secondsTicker_);
  else
    xAxis->setTicker(clockTicker_);
  if (!seconds)
    clockTicker_->setTimeFormat(seen().size() < kFewSecondsS ? "%h:%m:%s.%z" : "%h:%m:%s");
  const QString unit = seconds ? "s" : "h:min:s";
  xAxis->setLabel(isLow(*this) ? QString() : "time from the first frame in " + unit);
  if (timeUnit_) removeItem(timeUnit_);
  if (isLow(*this)) timeUnit_ = unitInCorner(*this, unit, Qt::AlignRight | Qt::AlignBottom);
}

void TimelineChart::fit() { setVisibleRange(0.0, durationS()); }

void TimelineChart::zoom(double factor) {
  zoomAbout(seen().contains(position()) && factor > 1.0 ? position() : seen().center(), factor);
}

void TimelineChart::showSpan(const TimeSpan& span) {
  const double air =
      std::max((span.toS - span.fromS) * kTimelineChartAir, Selection::kShortestS / 2);
  setVisibleRange(span.fromS - air, span.toS + air);
}

void TimelineChart::zoomAbout(double seconds, double factor) {
  const double shortest = std::min(Selection::kShortestS, durationS());
  const QCPRange range = zoomed(seconds, factor, shortest, durationS());
  setVisibleRange(range.lower, range.upper);
}

TimelineChart::Drag TimelineChart::dragAt(const QPointF& at) const {
  const QRect plot = axisRect()->rect();
  if (at.y() > plot.bottom()) return Drag::kScrub;
  if (selection_) {
    const double from = std::abs(at.x() - pixelOf(selection_->fromS));
    const double to = std::abs(at.x() - pixelOf(selection_->toS));
    if (std::min(from, to) <= kHandleReach) return from < to ? Drag::kFrom : Drag::kTo;
  }
  return Drag::kSelect;
}

void TimelineChart::mousePressEvent(QMouseEvent* event) {
  if (!recording_) return;
  if (axes_->press(*event)) return;
  const bool left = event->button() == Qt::LeftButton;
  pressedAt_ = event->position();
  pressedS_ = secondsAt(pressedAt_.x());
  panFrom_ = xAxis->range();
  if ((left && event->modifiers() & Qt::ShiftModifier) || event->button() == Qt::MiddleButton) {
    drag_ = Drag::kPan;
    setCursor(Qt::ClosedHandCursor);
  } else if (left) {
    drag_ = dragAt(pressedAt_);
    if (drag_ == Drag::kScrub) emit seekRequested(pressedS_);
  }
}

void TimelineChart::dragTo(const QPointF& at) {
  const double seconds = std::clamp(secondsAt(at.x()), 0.0, durationS());
  switch (drag_) {
    case Drag::kPan: {
      const double perPixel = panFrom_.size() / std::max(1, axisRect()->width());
      const double moved = (pressedAt_.x() - at.x()) * perPixel;
      return setVisibleRange(panFrom_.lower + moved, panFrom_.upper + moved);
    }
    case Drag::kScrub:
      emit seekRequested(seconds);
      return;
    case Drag::kSelect:
      if (std::abs(at.x() - pressedAt_.x()) >= QApplication::startDragDistance() ||
          (selection_ && (selection_->fromS == pressedS_ || selection_->toS == pressedS_)))
        setSelection(TimeSpan{pressedS_, seconds});
      return;
    case Drag::kFrom:
    case Drag::kTo: {
      if (!selection_) return;
      const double other = drag_ == Drag::kFrom ? selection_->toS : selection_->fromS;
      // A handle dragged past the other one takes over its role.
      if (seconds > other) drag_ = Drag::kTo;
      if (seconds < other) drag_ = Drag::kFrom;
      return setSelection(TimeSpan{other, seconds});
    }
    case Drag::kNone:
      break;
  }
}

void TimelineChart::mouseMoveEvent(QMouseEvent* event) {
  if (axes_->move(*event)) return;
  if (drag_ != Drag::kNone) return dragTo(event->position());
  if (!recording_) return;
  const Drag here = dragAt(event->position());
  if (here == Drag::kFrom || here == Drag::kTo)
    setCursor(Qt::SizeHorCursor);
  else
    unsetCursor();
}

void TimelineChart::mouseReleaseEvent(QMouseEvent* event) {
  if (axes_->release()) return;
  const bool still =
      std::abs(event->position().x() - pressedAt_.x()) < QApplication::startDragDistance();
  // A click moves the cursor and clears a selection elsewhere.
  if (drag_ == Drag::kSelect && still && recording_) {
    if (selection_ && (pressedS_ < selection_->fromS || pressedS_ > selection_->toS))
      setSelection(std::nullopt);
    emit seekRequested(pressedS_);
  }
  drag_ = Drag::kNone;
  unsetCursor();
}

void TimelineChart::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || axes_->doubleClick(*event)) return;
  fit();
}

void TimelineChart::wheelEvent(QWheelEvent* event) {
  if (!recording_) return;
  event->accept();
  if (!axes_->wheel(*event)) Chart::wheelEvent(event);
}

void TimelineChart::panBy(double seconds) {
  const QCPRange range = xAxis->range();
  setVisibleRange(range.lower + seconds, range.upper + seconds);
}

void TimelineChart::contextMenuEvent(QContextMenuEvent* event) {
  if (recording_) emit menuRequested(event->globalPos());
}

void TimelineChart::resized() {
  nameTime();
  axes_->nameAxes();
  refill();
}

QString TimelineChart::valuesAt(double seconds) const {
  if (!recording_ || recording_->profile.numFrames() == 0 || seconds < 0.0 || seconds > durationS())
    return {};
  const std::int64_t atUs = recording_->profile.frameTimeUs(0) + std::llround(seconds * 1e6);
  const std::size_t frame = recording_->profile.frameAt(atUs).value_or(0);
  const QString text =
      QString::number(recording_->timeAt(frame), 'f', 2) + " s · frame " + QString::number(frame);
  if (const Gap* gap = recording_->gapAt(seconds))
    return text + "\ngap of " + QString::number(gap->seconds, 'f', 1) +
           " s: " + recording_->reasonOf(*gap);
  if (recording_->unreadableAt(seconds)) return text + "\nthis frame is damaged and can't be read";
  return readingsText(
      text, curves_, [&](const SeriesChoice& choice) { return store_.valueAt(choice, seconds); });
}

}  // namespace palpate::gui
