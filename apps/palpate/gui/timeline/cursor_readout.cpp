#include "gui/timeline/cursor_readout.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "gui/timeline/timeline_chart.h"

namespace palpate::gui {
namespace {

constexpr int kReadoutMargin = 5;             // [px] around the text
constexpr int kLowLines = 8;                  // a plot with room for fewer lines is low
constexpr int kLowShare = 3;                  // there the box takes the third part of the height
constexpr int kLowAir = 1;                    // [px] around the text and the box there
constexpr int kReadoutAir = 6;                // [px] to the border of the plot
constexpr std::size_t kMaxReadoutCurves = 6;  // more would hide the curves
// Of a long recording a value may have to be read from the file: so many frames are tried for one.
constexpr std::size_t kMaxReads = 64;

QString readoutNumber(double value) { return QString::number(value, 'g', 5); }

}  // namespace

CursorReadout::CursorReadout(TimelineChart& chart) : QLabel(&chart), chart_(chart) {
  setObjectName("cursorReadout");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setTextFormat(Qt::PlainText);
  setMargin(kReadoutMargin);
  setAutoFillBackground(true);
  setFrameShape(QFrame::StyledPanel);
  hide();
  connect(&chart, &TimelineChart::selectionChanged, this, &CursorReadout::renew);
  // Also emitted when curves or their data have changed.
  connect(&chart, &TimelineChart::seenChanged, this, &CursorReadout::renew);
}

void CursorReadout::setOn(bool on) {
  on_ = on;
  renew();
}

void CursorReadout::renew() {
  const auto& span = chart_.selection();
  QStringList lines;
  if (on_ && span) {
    const double seconds = span->lengthS();
    lines.append("Δt " + QString::number(seconds, 'f', 3) + " s" +
                 (seconds > 0.0 ? " (" + readoutNumber(1.0 / seconds) + " Hz)" : QString()));
    const auto& curves = chart_.curves();
    for (std::size_t i = 0; i < std::min(curves.size(), kMaxReadoutCurves); ++i) {
      const auto change = changeOf(curves[i], *span);
      QString line = curves[i].name + "  " + (change ? readoutNumber(change->from) : QString("–")) +
                     " → " + (change ? readoutNumber(change->to) : QString("–"));
      if (change) {
        line += "  Δ " + readoutNumber(change->difference()) + " " + curves[i].unit;
        if (const auto rate = change->rate()) line += "  (" + readoutNumber(*rate) + "/s)";
      }
      lines.append(line);
    }
  }
  lines_ = lines;
  setVisible(!lines_.isEmpty());
  place();
}

// As in the table of the statistics.
std::optional<RangeChange> CursorReadout::changeOf(const PlottedCurve& curve,
                                                   const TimeSpan& span) const {
  const OpenedRecordingPtr& recording = chart_.recording();
  const SeriesStore& store = chart_.store();
  // Nothing was read yet, or there is no value at all.
  if (!recording || !store.extremes(curve.choice)) return std::nullopt;
  const auto frames = recording->framesWithin(span.fromS, span.toS);
  if (!frames) return std::nullopt;
  const auto timeSAt = [&](std::size_t sample) {
    return recording->timeAt(frames->first + sample);
  };
  const bool inMemory = store.holds(curve.choice, span.fromS, span.toS);
  std::size_t numReads = 0;  // at one end
  return rangeChange(frames->second - frames->first + 1, timeSAt, [&](std::size_t sample) {
    if (!inMemory && ++numReads > kMaxReads) return std::numeric_limits<double>::quiet_NaN();
    const auto value = store.valueAt(curve.choice, timeSAt(sample));
    if (value) numReads = 0;
    return value ? curve.conversion.of(*value) : std::numeric_limits<double>::quiet_NaN();
  });
}

// What doesn't fit is counted, and stands in the statistics.
CursorReadout::Part CursorReadout::partFor(QSize room, qsizetype perLine) const {
  const qsizetype more = static_cast<qsizetype>(chart_.curves().size()) + 1 - lines_.size();
  const auto textOf = [&](qsizetype count) {
    QStringList parts = lines_.first(count);
    const qsizetype missing = lines_.size() - count + more;
    if (missing > 0) parts.append(QString::number(missing) + " more: Statistics");
    QStringList rows;
    for (qsizetype i = 0; i < parts.size(); i += perLine)
      rows.append(parts.sliced(i, std::min(perLine, parts.size() - i)).join("  ·  "));
    return rows.join('\n');
  };
  for (qsizetype count = lines_.size(); count > 0; --count) {
    const QString text = textOf(count);
    const QSize needed = fontMetrics().size(0, text);
    if (needed.width() <= room.width() && needed.height() <= room.height()) return {text, count};
  }
  return {};
}

void CursorReadout::place() {
  if (isHidden()) return;
  const QRect plot = chart_.axisRect()->rect();
  const bool low = plot.height() < kLowLines * fontMetrics().lineSpacing();
  const int air = low ? kLowAir : kReadoutAir;
  setMargin(low ? kLowAir : kReadoutMargin);
  const int around = 2 * (margin() + frameWidth());
  const QSize most = plot.size() - QSize(2 * air, 2 * air);
  QSize room = most - QSize(around, around);
  // The curves of a low chart stay visible: its box is low, too, but has a line; as many curves as
  // there is room for stand beside each other.
  if (low)
    room.setHeight(std::min(room.height(),
                            std::max(plot.height() / kLowShare - around,
                                     fontMetrics().size(0, lines_.first()).height())));
  Part shown;
  for (qsizetype perLine = 1; perLine <= lines_.size(); ++perLine)
    if (Part part = partFor(room, perLine); part.count > shown.count) shown = std::move(part);
  const QString words = shown.count > 0 ? shown.text : lines_.first();
  if (words != text()) setText(words);
  const QSize wanted = sizeHint().boundedTo(room + QSize(around, around));
  const QRect at(
      plot.right() - air - wanted.width(), plot.top() + air, wanted.width(), wanted.height());
  if (geometry() != at) setGeometry(at);
  raise();
}

}  // namespace palpate::gui
