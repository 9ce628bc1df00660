#include "gui/timeline/live_chart.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <limits>

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>
#include <palpate/recording/recording_losses.h>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_style.h"
#include "gui/chart/end_names.h"
#include "gui/picture/stale_notice.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

// Without a frame for so long [s], the chart scrolls by itself.
constexpr double kOldS = 0.4;
constexpr std::size_t kMaxEvents = 500;
constexpr std::size_t kMaxRecordings = 100;
// Least time that the chart moves on when it is drawn [s]: every second frame of an SDH-2, 2 pixels
// of a chart of 30 s on a usual screen.
constexpr double kMinStepS = 0.05;
// The first samples are drawn at once.
constexpr std::size_t kFewSamples = 3;
// Height of the bar of a recording, as a share of that of the chart.
constexpr double kBarHeight = 0.025;
constexpr int kLiveWordsMargin = 6;  // [px]
constexpr int kRightMargin = 20;     // without names at the ends of curves [px]
// Distance of the mouse from the line of an event whose text is shown [px].
constexpr double kEventReach = 4.0;

QString nameOfEvent(const Event& event) {
  const QString text = QString::fromStdString(event.text);
  if (event.kind == "mark") return "mark";
  if (event.kind == "label") return text;
  if (event.kind == "grasp") return text.section(':', 0, 0);  // "opening", "reactive grasp refused"
  return QString::fromStdString(event.kind);
}

// Whether values of the curve end at saturation.
bool endsAtSaturation(const SeriesChoice& choice) {
  if (choice.kind == SeriesChoice::Kind::kTaxels) return true;
  return choice.kind == SeriesChoice::Kind::kMatrix && choice.signal != SignalKind::kSum &&
         choice.signal != SignalKind::kActive && choice.signal != SignalKind::kArea &&
         !isComponent(choice.signal);
}

QLabel* wordsOn(QWidget* chart, const char* name) {
  auto* label = new QLabel(chart);
  label->setObjectName(name);
  label->setTextFormat(Qt::PlainText);
  label->setAttribute(Qt::WA_TransparentForMouseEvents);
  label->setContentsMargins(6, 2, 6, 2);
  label->hide();
  return label;
}

}  // namespace

LiveChart::LiveChart(QWidget* parent)
    : Chart(parent),
      axes_(std::make_unique<UnitAxes>(*this)),
      secondsTicker_(new QCPAxisTickerFixed),
      span_(this),
      readings_(wordsOn(this, "cursorReadings")),
      behind_(wordsOn(this, "behindWords")) {
  setAccessibleName("Live chart");
  setToolTip(
      "Wheel: how many seconds are shown; Shift+wheel: scroll back; drag: cursors with "
      "differences");
  nameTime();
  fitToText(*this, [this] { setMinimumHeight(kMinChartLines * fontMetrics().lineSpacing()); });
  xAxis->setTicker(secondsTicker_);
  connect(axes_.get(), &UnitAxes::byHandChanged, this, &LiveChart::refill);
  connect(axes_.get(), &UnitAxes::logarithmicChanged, this, &LiveChart::rebuildGraphs);
  // Margins are known only after the axes have been laid out.
  connect(this, &QCustomPlot::afterReplot, this, &LiveChart::placeOverlays);
  follow(0.0);
  restyle();
}

void LiveChart::setHistory(const SignalHistory* history, const HandDescription* hand) {
  hasHistory_ = history != nullptr;
  hand_ = hand ? std::optional(*hand) : std::nullopt;
  series_.setHistory(history);
  saturation_.reset();
  if (hand) {
    double highest = 0.0;
    for (std::size_t m = 0; m < hand->layout->numMatrices(); ++m)
      highest = std::max(highest, static_cast<double>(hand->saturationOf(m)));
    if (highest > 0.0) saturation_ = highest;
  }
  nowS_ = 0.0;
  shadedToS_ = 0.0;
  if (silence_) removeItem(silence_);
  drag_ = Drag::kNone;
  setHeld(false);
  clearTimeCursors();
  ranges_.clear();
  forget(std::numeric_limits<double>::infinity());
  series_.update();
  if (!following_) {
    following_ = true;
    emit followingChanged(true);
  }
  if (!history) setCurves({});
  follow(series_.newestS());
}

void LiveChart::setCurves(std::vector<PlottedCurve> curves) {
  curves_ = std::move(curves);
  std::vector<SeriesChoice> wanted;
  for (const PlottedCurve& curve : curves_) wanted.push_back(curve.choice);
  series_.setWanted(wanted);
  rebuildGraphs();
}

void LiveChart::style() {
  const ThemeColors& colors = colorsOf();
  span_.restyle();
  for (const Shown& event : events_)
    event.name->setColor(event.isGap ? colors.warning : colors.text);
  for (QLabel* words : {readings_, behind_})
    words->setStyleSheet("background: " + colors.panel.name() + "; color: " + colors.text.name() +
                         "; border: 1px solid " +
                         (words == behind_ ? colors.accent : colors.border).name());
  rebuildGraphs();
}

void LiveChart::setWindowS(double seconds) {
  const double wanted = std::clamp(seconds, kShortestS, kMaxWindowS);
  if (wanted == windowS_) return;
  const double middle = seen().center();
  windowS_ = wanted;
  if (following_)
    follow(nowS_);
  else
    scrollTo(middle - wanted / 2.0);
  emit windowChanged(windowS_);
}

void LiveChart::setHeld(bool held) {
  held_ = held;
  update();
}

void LiveChart::paintEvent(QPaintEvent* event) {
  QCustomPlot::paintEvent(event);
  QPainter painter(this);
  paintEndNames(painter, *this, curves_);
  if (held_) paintStaleNotice(painter, rect(), {kHeldText, true});
}

void LiveChart::setLanes(bool on) {
  wantsLanes_ = on;
  rebuildGraphs();
}

void LiveChart::rebuildGraphs() {
  clearGraphs();
  lanes_.set(curves_, wantsLanes_ && hand_ ? &*hand_ : nullptr);
  if (axes_->logarithmic().contains(lanes_.unit())) lanes_.set({}, nullptr);
  axes_->leaveToLanes(lanes_.any() ? std::optional(lanes_.unit()) : std::nullopt);
  axes_->rebuild(curves_);
  makeRoomForNames();
  nameTime();
  for (const PlottedCurve& curve : curves_) {
    QCPGraph* added = addGraph(xAxis, axes_->of(curve.unit));
    added->setPen(curve.pen);
    // The points are decimated already.
    added->setAdaptiveSampling(false);
  }
  std::erase_if(ranges_, [this](const auto& range) {
    const auto units = axes_->units();
    return std::find(units.begin(), units.end(), range.first) == units.end();
  });
  refill();
}

void LiveChart::refresh(double silentS) {
  if (!hasHistory_ || held_) return;
  const std::size_t taken = series_.update();
  if (series_.empty() || (taken == 0 && silentS < kOldS)) return;
  shadeNewGaps();
  const double newestS = series_.newestS();
  const double nowS = taken == 0 ? newestS + silentS : newestS;
  shadeSilence(nowS);
  if (!following_) return showBehind();
  // A step that is not seen would take as long to draw as a large one. What arrived is drawn by the
  // next step, or when nothing comes any more.
  const double stepS = std::max(kMinStepS, windowS_ / std::max(1, axisRect()->width()));
  if (nowS >= nowS_ && nowS - nowS_ < stepS && series_.numSamples() > kFewSamples) return;
  forget(std::min(series_.oldestS(), nowS - kMaxWindowS));
  follow(nowS);
  renewToolTip();
}

void LiveChart::follow(double nowS) {
  nowS_ = nowS;
  const double toS = std::max(nowS, windowS_);
  showRange(toS - windowS_, toS);
}

void LiveChart::showRange(double fromS, double toS) {
  xAxis->setRange(fromS, toS);
  constexpr double kMaxTicks = 12.0, kTickRoom = 60.0;  // [px]
  const double ticks = std::clamp(axisRect()->width() / kTickRoom, 2.0, kMaxTicks);
  secondsTicker_->setTickStep(niceAbove(windowS_ / ticks));
  arrangeNames();
  refill();
}

void LiveChart::nameTime() {
  xAxis->setLabel(isLow(*this) ? "" : "time since the first frame in s");
  if (timeUnit_) removeItem(timeUnit_);
  if (isLow(*this)) timeUnit_ = unitInCorner(*this, "s", Qt::AlignRight | Qt::AlignBottom);
}

void LiveChart::refill() {
  const QCPRange range = seen();
  const DecimationOptions options{
      .from = range.lower,
      .to = range.upper,
      .columns = static_cast<std::size_t>(std::max(1, axisRect()->width()))};
  scaleAxes();
  if (!series_.empty()) drawnToS_ = std::min(range.upper, series_.newestS());
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const auto points = series_.points(curves_[i].choice, options);
    QVector<QCPGraphData> samples;
    samples.reserve(static_cast<qsizetype>(points.size()));
    const UnitConversion& shown = curves_[i].conversion;
    for (const SeriesPoint& point : points)
      samples.append({point.x, lanes_.placed(i, shown.of(point.y))});
    graph(static_cast<int>(i))->data()->set(samples, true);
  }
  for (Recorded& recording : recordings_) {
    if (recording.runs) recording.endS = std::max(recording.endS, series_.newestS());
    recording.bar->bottomRight->setCoords(recording.endS, 1.0);
  }
  replot(QCustomPlot::rpQueuedReplot);
}

void LiveChart::scaleAxes() {
  for (const QString& unit : axes_->units()) {
    std::optional<ValueExtent> extent;
    AxisRangeOptions options{.fromZero = axes_->fromZero(unit),
                             .minExtent = axes_->minExtent(unit),
                             .ceiling = saturation_};
    for (const PlottedCurve& curve : curves_) {
      if (curve.unit != unit) continue;
      if (!endsAtSaturation(curve.choice)) options.ceiling.reset();
      auto its = series_.extremes(curve.choice, seen().lower, seen().upper);
      if (!its) continue;
      its = {curve.conversion.of(its->first), curve.conversion.of(its->second)};
      if (!extent) extent = ValueExtent{its->first, its->second};
      extent->low = std::min(extent->low, its->first);
      extent->high = std::max(extent->high, its->second);
    }
    // Ranges are fitted in base units: a chart looks the same in all units.
    const UnitConversion shown = axes_->conversionOf(unit);
    if (extent) extent = ValueExtent{shown.back(extent->low), shown.back(extent->high)};
    const AxisRange range = ranges_[unit].update(extent, options);
    const AxisRange automatic = {shown.of(range.from), shown.of(range.to)};
    axes_->setAutomatic(unit, automatic);
    if (!lanes_.any() || unit != lanes_.unit()) continue;
    const auto byHand = axes_->byHand().find(unit);
    lanes_.setRange(byHand == axes_->byHand().end() ? automatic : byHand->second);
    lanes_.scale(*axes_->of(unit));
  }
}

// --- scrolling back

void LiveChart::setFollowing(bool on) {
  if (on == following_) return;
  following_ = on;
  if (on && !held_) {
    series_.update();
    shadeNewGaps();
  }
  if (on) follow(series_.newestS());
  showBehind();
  emit followingChanged(on);
}

void LiveChart::scrollTo(double fromS) { showSpan(fromS, fromS + windowS_); }

void LiveChart::scroll(double share) {
  if (series_.empty() || (following_ && share >= 0.0)) return;
  const double fromS = seen().lower + share * windowS_;
  if (share > 0.0 && fromS + windowS_ >= series_.newestS()) return setFollowing(true);
  scrollTo(fromS);
}

void LiveChart::showOldest() {
  if (!series_.empty()) scrollTo(series_.oldestS());
}

void LiveChart::showSpan(double fromS, double toS) {
  if (series_.empty()) return;
  const double span = std::clamp(toS - fromS, kShortestS, kMaxWindowS);
  const double lowest = series_.oldestS();
  const double latest = std::max(lowest, series_.newestS() - span);
  const double start = std::clamp(fromS, lowest, latest);
  const bool other = span != windowS_;
  windowS_ = span;
  setFollowing(false);
  showRange(start, start + span);
  showBehind();
  if (other) emit windowChanged(windowS_);
}

// Says that the chart doesn't show the newest frame, and how far behind it is.
void LiveChart::showBehind() {
  if (following_) {
    behind_->hide();
    return;
  }
  const double behindS = std::max(0.0, series_.newestS() - drawnToS_);
  behind_->setText("frozen, " + figure(behindS, 1) + " s behind · End: newest");
  behind_->show();
  placeWords();
}

// --- cursors

void LiveChart::setTimeCursor(std::size_t which, double seconds) {
  const auto sampleS = series_.sampleTimeAt(seconds);
  if (!sampleS || which >= cursors_.size()) return;
  lastCursor_ = which;
  if (cursors_[which] == sampleS) return;
  cursors_[which] = sampleS;
  placeOverlays();
  emit cursorsChanged();
}

void LiveChart::setTimeCursorHere(std::size_t which) {
  if (series_.empty()) return;
  const QPoint mouse = mapFromGlobal(QCursor::pos());
  if (following_)
    setTimeCursor(which, series_.newestS());
  else
    setTimeCursor(which,
                  underMouse() && axisRect()->rect().contains(mouse) ? secondsAt(mouse.x())
                                                                     : seen().center());
}

void LiveChart::moveTimeCursor(std::ptrdiff_t samples) {
  const auto& cursor = cursors_[lastCursor_];
  if (!cursor) return;
  const auto sampleS = series_.sampleTimeBeside(*cursor, samples);
  if (!sampleS) return;
  // The cursor stays visible: the chart stops, or is scrolled to it.
  if (*sampleS < seen().lower || *sampleS > seen().upper)
    scrollTo(*sampleS - windowS_ / 2.0);
  else
    setFollowing(false);
  setTimeCursor(lastCursor_, *sampleS);
}

void LiveChart::clearTimeCursors() {
  if (!cursors_[0] && !cursors_[1]) return;
  cursors_ = {};
  placeOverlays();
  emit cursorsChanged();
}

QString LiveChart::cursorWords() const {
  if (cursors_[0] && cursors_[1]) {
    const auto [fromS, toS] = std::minmax(*cursors_[0], *cursors_[1]);
    return figure(fromS, 2) + " – " + figure(toS, 2) + " s · Δt " + figure(toS - fromS, 2) + " s";
  }
  const auto& one = cursors_[0] ? cursors_[0] : cursors_[1];
  return one ? figure(*one, 2) + " s" : QString();
}

std::optional<double> LiveChart::differenceAtCursors(const SeriesChoice& choice) const {
  if (!cursors_[0] || !cursors_[1]) return std::nullopt;
  const auto [fromS, toS] = std::minmax(*cursors_[0], *cursors_[1]);
  const auto from = series_.valueAt(choice, fromS);
  const auto to = series_.valueAt(choice, toS);
  return from && to ? std::optional(*to - *from) : std::nullopt;
}

// Values at the cursors and their differences, from the earlier to the later one.
QString LiveChart::cursorText(int mostLines) const {
  QStringList lines;
  if (cursors_[0] && cursors_[1]) {
    const auto [fromS, toS] = std::minmax(*cursors_[0], *cursors_[1]);
    lines.append("Δt " + figure(toS - fromS, 3) + " s" +
                 (toS > fromS ? " · " + figure(1.0 / (toS - fromS), 2) + " Hz" : QString()));
    for (const PlottedCurve& curve : curves_)
      lines.append(curve.name + "  " + readingOf(curve, series_.valueAt(curve.choice, fromS)) +
                   " → " + readingOf(curve, series_.valueAt(curve.choice, toS)) + "  Δ " +
                   differenceOf(curve, differenceAtCursors(curve.choice)));
  } else if (const auto& one = cursors_[0] ? cursors_[0] : cursors_[1]) {
    lines.append(figure(*one, 3) + " s");
    for (const PlottedCurve& curve : curves_)
      lines.append(curve.name + "  " + readingOf(curve, series_.valueAt(curve.choice, *one)));
  }
  if (lines.size() > mostLines) {
    const qsizetype more = lines.size() - mostLines + 1;
    lines = lines.mid(0, std::max(1, mostLines - 1));
    lines.last() += " · and " + QString::number(more) + " more";
  }
  return lines.join('\n');
}

TextTable LiveChart::cursorTable() const {
  TextTable table{.header = {"curve", "unit", "first", "second", "difference"}};
  std::vector<std::vector<std::string>> rows;
  if (cursors_[0] && cursors_[1]) {
    const auto [fromS, toS] = std::minmax(*cursors_[0], *cursors_[1]);
    rows.push_back({"time", "s", numberText(fromS), numberText(toS), numberText(toS - fromS)});
    const auto cell = [](std::optional<double> value) {
      return value ? numberText(*value) : std::string();
    };
    for (const PlottedCurve& curve : curves_)
      rows.push_back({curve.name.toStdString(),
                      curve.baseUnit.toStdString(),
                      cell(series_.valueAt(curve.choice, fromS)),
                      cell(series_.valueAt(curve.choice, toS)),
                      cell(differenceAtCursors(curve.choice))});
  }
  table.numRows = rows.size();
  table.row = [rows](std::size_t row) { return rows.at(row); };
  return table;
}

void LiveChart::placeOverlays() {
  const auto pixel = [this](const std::optional<double>& seconds) {
    return seconds ? std::optional(pixelOf(*seconds)) : std::nullopt;
  };
  span_.place(axisRect()->rect(), pixel(cursors_[0]), pixel(cursors_[1]));
  const int lineHeight = fontMetrics().lineSpacing();
  // Cursors that were scrolled out of the chart have no box on it.
  const auto isSeen = [this](const std::optional<double>& cursor) {
    return cursor && *cursor >= seen().lower && *cursor <= seen().upper;
  };
  const bool any = isSeen(cursors_[0]) || isSeen(cursors_[1]);
  const int room = axisRect()->height() - (behind_->isHidden() ? 0 : behind_->height());
  if (any) readings_->setText(cursorText(std::max(2, room / lineHeight - 1)));
  readings_->setVisible(any);
  placeWords();
}

// How far behind the chart is stands at the right, the values at the cursors below it, or at the
// left where they would cover the cursors.
void LiveChart::placeWords() {
  const QRect plot = axisRect()->rect();
  int top = plot.top() + kLiveWordsMargin;
  const double last = std::max(cursors_[0].value_or(-1.0), cursors_[1].value_or(-1.0));
  for (QLabel* words : {behind_, readings_}) {
    if (words->isHidden()) continue;
    const QSize size = words->sizeHint();
    int left = plot.right() - size.width() - kLiveWordsMargin;
    if (words == readings_ && pixelOf(last) >= left) {
      left = plot.left() + kLiveWordsMargin;
      top = plot.top() + kLiveWordsMargin;
    }
    const QRect place(std::max(0, left), top, size.width(), size.height());
    if (words->geometry() != place) words->setGeometry(place);
    top = place.bottom() + 2;
  }
}

// --- events, gaps and recordings

void LiveChart::forget(double beforeS) {
  const auto drop = [this](const Shown& event) {
    if (event.shape) removeItem(event.shape);
    if (event.name) removeItem(event.name);
  };
  while (!events_.empty() && (events_.front().endS < beforeS || events_.size() > kMaxEvents)) {
    drop(events_.front());
    events_.pop_front();
  }
  while (!recordings_.empty() &&
         (beforeS == std::numeric_limits<double>::infinity() ||
          (!recordings_.front().runs &&
           (recordings_.front().endS < beforeS || recordings_.size() > kMaxRecordings)))) {
    removeItem(recordings_.front().bar);
    recordings_.pop_front();
  }
}

void LiveChart::addEvent(const Event& event) {
  if (!hasHistory_) return;
  const ThemeColors& colors = colorsOf();
  const double beginS = series_.secondsOf(event.tUs);
  const QString text = QString::fromStdString(event.text);
  // Long gaps are visible in the samples, shorter ones only here. Where single frames are lost the
  // line goes on.
  constexpr double kMinGapS = 0.15;
  if (event.kind == "gap") {
    for (const RecordingLoss& loss : lossesOf({&event, 1}))
      if (loss.stream == "tactile" && loss.seconds >= kMinGapS) series_.breakAfter(event.tUs);
    return;
  }
  if (event.kind == "mark" || event.kind == "label")
    line(beginS, nameOfEvent(event), text.isEmpty() ? "mark" : "mark: " + text, colors.accent);
  else if (event.kind == "slip" && event.t1Us > event.tUs)
    shadeSlip(beginS, series_.secondsOf(event.t1Us), text);
  else if (event.kind == "slip")
    line(beginS, "slip", text, colors.danger);
  else if (event.kind == "grasp")
    line(event.t1Us > event.tUs ? series_.secondsOf(event.t1Us) : beginS,
         nameOfEvent(event),
         text,
         colors.muted);
}

void LiveChart::showRecording(std::int64_t firstUs, std::int64_t lastUs, bool runs) {
  if (!hasHistory_ || series_.empty() || firstUs == 0) return;
  const ThemeColors& colors = colorsOf();
  const double beginS = series_.secondsOf(firstUs);
  const double endS = series_.secondsOf(lastUs);
  // The last one, unless it has ended.
  if (recordings_.empty() || recordings_.back().beginS != beginS) {
    auto* bar = shadeSpan(*this, beginS, endS);
    bar->setBrush(colors.danger);
    bar->setLayer("overlay");
    bar->topLeft->setCoords(beginS, 1.0 - kBarHeight);
    recordings_.push_back({beginS, endS, true, bar});
    line(beginS, "recording", "the recording begins here", colors.danger);
    events_.back().endsRecording = true;
  }
  Recorded& recording = recordings_.back();
  if (!recording.runs) return;
  recording.endS = std::max(recording.endS, endS);
  recording.runs = runs;
  if (!runs) {
    recording.endS = endS;
    line(endS, "end of recording", "the recording ends here", colors.danger);
    events_.back().endsRecording = true;
  }
  recording.bar->bottomRight->setCoords(recording.endS, 1.0);
  replot(QCustomPlot::rpQueuedReplot);
}

std::size_t LiveChart::numRecordingEnds() const {
  return static_cast<std::size_t>(std::count_if(
      events_.begin(), events_.end(), [](const Shown& event) { return event.endsRecording; }));
}

void LiveChart::line(double atS, const QString& name, const QString& text, const QColor& color) {
  auto* shape = new QCPItemLine(this);
  for (QCPItemPosition* end : {shape->start, shape->end}) {
    end->setTypeX(QCPItemPosition::ptPlotCoords);
    end->setTypeY(QCPItemPosition::ptAxisRectRatio);
  }
  shape->start->setCoords(atS, 0.0);
  shape->end->setCoords(atS, 1.0);
  shape->setPen(QPen(color, 1.0));
  auto* word = wordAt(*this, atS, name, Qt::AlignLeft, colorsOf().text);
  events_.push_back({atS, atS, false, shape, word, text, false});
  arrangedFor_ = 0.0;
  arrangeNames();
  if (!following_) replot(QCustomPlot::rpQueuedReplot);
}

// Places names of neighbouring events one below the other, so that none covers another one; a name
// for which no line is free is hidden.
void LiveChart::arrangeNames() {
  const double pxPerS = axisRect()->width() / windowS_;
  const double key = pxPerS + 1e6 * axisRect()->height();
  if (key == arrangedFor_) return;
  arrangedFor_ = key;
  const int lineHeight = fontMetrics().lineSpacing();
  constexpr int kMaxChartLines = 4, kBetween = 10;  // [px]
  const int lines = std::clamp(axisRect()->height() / (2 * lineHeight), 1, kMaxChartLines);
  std::vector<double> usedTo(static_cast<std::size_t>(lines), -1e12);  // [px]
  for (const Shown& event : events_) {
    const double width = fontMetrics().horizontalAdvance(event.name->text());
    const double left =
        event.isGap ? (event.beginS + event.endS) / 2 * pxPerS - width / 2 : event.beginS * pxPerS;
    const auto free =
        std::find_if(usedTo.begin(), usedTo.end(), [&](double to) { return to <= left; });
    event.name->setVisible(free != usedTo.end());
    if (free == usedTo.end()) continue;
    *free = left + width + kBetween;
    event.name->setPadding(
        QMargins(event.isGap ? 0 : 4, static_cast<int>(free - usedTo.begin()) * lineHeight, 0, 0));
  }
}

// Its line, at the begin, has its name.
void LiveChart::shadeSlip(double beginS, double endS, const QString& text) {
  auto* shape = shadeSpan(*this, beginS, endS);
  QColor tone = colorsOf().danger;
  tone.setAlphaF(0.25F);
  shape->setBrush(tone);
  auto* word = wordAt(*this, beginS, {}, Qt::AlignLeft, colorsOf().text);
  events_.push_back({beginS, endS, false, shape, word, text, false});
}

void LiveChart::shadeNewGaps() {
  for (const TimeSpan& gap : series_.gaps()) {
    if (gap.fromS < shadedToS_) continue;
    shadedToS_ = gap.toS;
    auto* shape = shadeGap(*this, gap.fromS, gap.toS);
    const QString name = "gap " + figure(gap.lengthS(), 1) + " s";
    auto* word =
        wordAt(*this, (gap.fromS + gap.toS) / 2, name, Qt::AlignHCenter, colorsOf().warning);
    events_.push_back({gap.fromS, gap.toS, true, shape, word, name, false});
    arrangedFor_ = 0.0;
  }
}

void LiveChart::shadeSilence(double toS) {
  const double newestS = series_.newestS();
  const bool isSilent = toS - newestS >= kOldS;
  if (!isSilent && silence_) removeItem(silence_);
  if (!isSilent) return;
  if (!silence_) silence_ = shadeGap(*this, newestS, toS);
  silence_->bottomRight->setCoords(toS, 1.0);
}

// --- mouse

QString LiveChart::valuesAt(double seconds) const {
  if (series_.empty() || seconds > series_.newestS()) return {};
  const auto sampleS = series_.sampleTimeAt(seconds);
  if (!sampleS || seconds < series_.oldestS()) return {};
  QString heading = figure(*sampleS, 2) + " s · " + figure(series_.newestS() - *sampleS, 1) +
                    " s before the newest frame";
  for (const Shown& event : events_)
    if (!event.isGap && std::abs(pixelOf(event.beginS) - pixelOf(seconds)) <= kEventReach)
      heading += "\n" + event.text;
  if (const auto gap = series_.gapAt(seconds))
    return heading + "\ngap of " + figure(gap->lengthS(), 1) + " s: no frame was received";
  return readingsText(heading, curves_, [&](const SeriesChoice& choice) {
    return series_.valueAt(choice, seconds);
  });
}

// The curves move below the mouse, so the tool tip is made anew while it is shown.
void LiveChart::renewToolTip() {
  if (toolTip_.isEmpty()) return;
  if (!QToolTip::isVisible() || QToolTip::text() != toolTip_ || !underMouse()) {
    toolTip_.clear();
    return;
  }
  const QString text = valuesAt(secondsAt(mapFromGlobal(toolTipAt_).x()));
  if (text == toolTip_) return;
  toolTip_ = text;
  QToolTip::showText(toolTipAt_, text, this);
}

bool LiveChart::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    toolTipAt_ = help->globalPos();
    if (axes_->unitAt(help->pos()))
      toolTip_ = "Wheel and drag: the range of this axis; double click: automatic";
    else
      toolTip_ = valuesAt(secondsAt(help->pos().x()));
    QToolTip::showText(toolTipAt_, toolTip_.isEmpty() ? toolTip() : toolTip_, this);
    return true;
  }
  return Chart::event(event);
}

LiveChart::Drag LiveChart::dragAt(const QPointF& at) const {
  const QRect plot = axisRect()->rect();
  if (at.y() > plot.bottom()) return Drag::kPan;
  const auto distance = [&](const std::optional<double>& cursor) {
    return cursor ? std::abs(at.x() - pixelOf(*cursor)) : std::numeric_limits<double>::infinity();
  };
  const double first = distance(cursors_[0]);
  const double second = distance(cursors_[1]);
  if (std::min(first, second) <= kHandleReach) return first < second ? Drag::kFirst : Drag::kSecond;
  return Drag::kSelect;
}

void LiveChart::mousePressEvent(QMouseEvent* event) {
  if (series_.empty() || axes_->press(*event)) return;
  const bool left = event->button() == Qt::LeftButton;
  pressedAt_ = event->position();
  pressedS_ = secondsAt(pressedAt_.x());
  panFrom_ = seen();
  if ((left && event->modifiers() & Qt::ShiftModifier) || event->button() == Qt::MiddleButton)
    drag_ = Drag::kPan;
  else if (left)
    drag_ = dragAt(pressedAt_);
  if (drag_ == Drag::kPan) QWidget::setCursor(Qt::ClosedHandCursor);
}

void LiveChart::dragTo(const QPointF& at) {
  const bool moved = std::abs(at.x() - pressedAt_.x()) >= QApplication::startDragDistance();
  switch (drag_) {
    case Drag::kPan: {
      const double perPixel = panFrom_.size() / std::max(1, axisRect()->width());
      const double fromS = panFrom_.lower + (pressedAt_.x() - at.x()) * perPixel;
      if (!moved && following_) return;
      if (fromS > seen().lower && fromS + windowS_ >= series_.newestS()) return setFollowing(true);
      if (!following_ || fromS < seen().lower) scrollTo(fromS);
      return;
    }
    case Drag::kSelect:
      if (!moved) return;
      setTimeCursor(0, pressedS_);
      setTimeCursor(1, secondsAt(at.x()));
      drag_ = Drag::kSecond;
      return;
    case Drag::kFirst:
      return setTimeCursor(0, secondsAt(at.x()));
    case Drag::kSecond:
      return setTimeCursor(1, secondsAt(at.x()));
    case Drag::kNone:
      return;
  }
}

void LiveChart::mouseMoveEvent(QMouseEvent* event) {
  if (axes_->move(*event)) return;
  if (drag_ != Drag::kNone) return dragTo(event->position());
  const Drag here = dragAt(event->position());
  if (axes_->unitAt(event->position()))
    QWidget::setCursor(Qt::SizeVerCursor);
  else if (here == Drag::kFirst || here == Drag::kSecond)
    QWidget::setCursor(Qt::SizeHorCursor);
  else
    unsetCursor();
  if (toolTip_.isEmpty()) return;
  toolTipAt_ = event->globalPosition().toPoint();
  renewToolTip();
}

void LiveChart::mouseReleaseEvent(QMouseEvent* event) {
  if (axes_->release()) return;
  const bool still =
      std::abs(event->position().x() - pressedAt_.x()) < QApplication::startDragDistance();
  // A click elsewhere removes the cursors.
  if (drag_ == Drag::kSelect && still) clearTimeCursors();
  drag_ = Drag::kNone;
  unsetCursor();
}

void LiveChart::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || axes_->doubleClick(*event)) return;
  setFollowing(true);
}

void LiveChart::wheelEvent(QWheelEvent* event) {
  event->accept();
  if (!axes_->wheel(*event)) Chart::wheelEvent(event);
}

void LiveChart::zoomAbout(double seconds, double factor) {
  const double wanted = std::clamp(windowS_ / factor, kShortestS, kMaxWindowS);
  if (following_) return setWindowS(wanted);
  const double share = (seconds - seen().lower) / seen().size();
  showSpan(seconds - share * wanted, seconds + (1.0 - share) * wanted);
}

void LiveChart::contextMenuEvent(QContextMenuEvent* event) {
  if (!series_.empty()) emit menuRequested(event->globalPos());
}

void LiveChart::makeRoomForNames() {
  QMargins margins = axisRect()->minimumMargins();
  margins.setRight(std::max(kRightMargin, roomForEndNames(*this, curves_)));
  axisRect()->setMinimumMargins(margins);
}

void LiveChart::resized() {
  makeRoomForNames();
  nameTime();
  axes_->nameAxes();
  refill();
}

}  // namespace palpate::gui
