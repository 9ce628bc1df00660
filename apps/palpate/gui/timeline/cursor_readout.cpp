#include "gui/timeline/cursor_readout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/timeline/timeline_chart.h"

namespace palpate::gui {
namespace {

constexpr int kReadoutMargin = 5;              // [px] around the text
constexpr int kLowLines = 4;                   // a plot with room for fewer lines is low
constexpr int kLowAir = 1;                     // [px] around the text and the box there
constexpr int kReadoutAir = 6;                 // [px] to the border of the plot
constexpr std::size_t kMostReadoutCurves = 6;  // more would hide the curves

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
    for (std::size_t i = 0; i < std::min(curves.size(), kMostReadoutCurves); ++i) {
      const auto shown = [&](double atS) {
        const auto value = chart_.store().valueAt(curves[i].choice, atS);
        return value ? std::optional(curves[i].conversion.of(*value)) : std::nullopt;
      };
      const auto from = shown(span->fromS);
      const auto to = shown(span->toS);
      QString line = curves[i].name + "  " + (from ? readoutNumber(*from) : QString("–")) + " → " +
                     (to ? readoutNumber(*to) : QString("–"));
      if (from && to) {
        line += "  Δ " + readoutNumber(*to - *from) + " " + curves[i].unit;
        if (seconds > 0.0) line += "  (" + readoutNumber((*to - *from) / seconds) + "/s)";
      }
      lines.append(line);
    }
  }
  lines_ = lines;
  setVisible(!lines_.isEmpty());
  place();
}

// What doesn't fit is counted, and stands in the statistics.
CursorReadout::Part CursorReadout::partFor(QSize room, qsizetype perLine) const {
  const qsizetype more = static_cast<qsizetype>(chart_.curves().size()) + 1 - lines_.size();
  const auto textOf = [&](qsizetype count) {
    QStringList parts = lines_.first(count);
    const qsizetype missing = lines_.size() - count + more;
    if (missing > 0) parts.append(QString::number(missing) + " more: Statistics (Ctrl+Alt+A)");
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
  const QSize room = most - QSize(around, around);
  // A low chart has room for few lines: as many curves as there is room for stand beside each
  // other.
  Part shown;
  for (qsizetype perLine = 1; perLine <= lines_.size(); ++perLine)
    if (Part part = partFor(room, perLine); part.count > shown.count) shown = std::move(part);
  const QString words = shown.count > 0 ? shown.text : lines_.first();
  if (words != text()) setText(words);
  const QSize wanted = sizeHint().boundedTo(most);
  const QRect at(
      plot.right() - air - wanted.width(), plot.top() + air, wanted.width(), wanted.height());
  if (geometry() != at) setGeometry(at);
  raise();
}

}  // namespace palpate::gui
