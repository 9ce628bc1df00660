#include "gui/timeline/cursor_readout.h"

#include <algorithm>
#include <cmath>

#include "gui/timeline/timeline_chart.h"

namespace palpate::gui {
namespace {

constexpr int kReadoutAir = 6;                 // [px] to the border of the plot
constexpr std::size_t kMostReadoutCurves = 6;  // more would hide the curves

QString readoutNumber(double value) { return QString::number(value, 'g', 5); }

}  // namespace

CursorReadout::CursorReadout(TimelineChart& chart) : QLabel(&chart), chart_(chart) {
  setObjectName("cursorReadout");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setTextFormat(Qt::PlainText);
  setMargin(5);
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
    if (curves.size() > kMostReadoutCurves)
      lines.append(QString::number(curves.size() - kMostReadoutCurves) +
                   " more: Statistics (Ctrl+Alt+A)");
  }
  lines_ = lines;
  setVisible(!lines_.isEmpty());
  place();
}

void CursorReadout::place() {
  if (isHidden()) return;
  const QRect plot = chart_.axisRect()->rect();
  const QSize most = plot.size() - QSize(2 * kReadoutAir, 2 * kReadoutAir);
  QString words = lines_.join('\n');
  const auto heightOf = [this](qsizetype lines) {
    return static_cast<int>(lines) * fontMetrics().lineSpacing() + 2 * (margin() + frameWidth());
  };
  // A low chart has room for a single line, which leaves half of the curves free.
  if (heightOf(lines_.size()) > most.height())
    words = fontMetrics().elidedText(
        lines_.join("  ·  "), Qt::ElideRight, most.width() / 2 - 2 * (margin() + frameWidth()));
  if (words != text()) setText(words);
  const QSize wanted = sizeHint().boundedTo(most);
  const QRect room(plot.right() - kReadoutAir - wanted.width(),
                   plot.top() + kReadoutAir,
                   wanted.width(),
                   wanted.height());
  if (geometry() != room) setGeometry(room);
  raise();
}

}  // namespace palpate::gui
