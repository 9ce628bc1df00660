#include "gui/compare/compare_strip.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include "gui/appearance/difference_map.h"
#include "gui/compare/compare_chart.h"

namespace palpate::gui {
namespace {

constexpr int kBar = 11;                 // [px] height
constexpr int kCompareStripBetween = 4;  // [px]
constexpr int kCompareStripAround = 4;   // [px]
// [px] smallest width, so that a single frame is visible and can be dragged
constexpr double kMinimum = 8.0;
constexpr double kContact = 2.0;  // [px]

}  // namespace

CompareStrip::CompareStrip(const CompareChart& chart, QWidget* parent)
    : QWidget(parent), chart_(chart) {
  setMouseTracking(true);
  setAccessibleName("When A and B were recorded; B can be dragged");
  setToolTip("Drag B's bar to shift it against A");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(&chart, &CompareChart::rangeChanged, this, qOverload<>(&QWidget::update));
}

QSize CompareStrip::sizeHint() const {
  return {300, 2 * kBar + kCompareStripBetween + 2 * kCompareStripAround};
}

QRectF CompareStrip::barRect(bool ofB) const {
  const CompareCurves& curves = chart_.curves();
  const auto& timed = ofB ? curves.b : curves.a;
  if (!timed || timed->profile.numFrames() == 0) return {};
  const double beginS = ofB ? curves.offsetS : 0.0;
  const double left = chart_.pixelOf(beginS);
  const double right = chart_.pixelOf(beginS + timed->timing.durationS);
  const double top = kCompareStripAround + (ofB ? kBar + kCompareStripBetween : 0);
  return {left, top, std::max(kMinimum, right - left), static_cast<double>(kBar)};
}

void CompareStrip::paintBar(QPainter& painter, bool ofB) const {
  const QRectF bar = barRect(ofB);
  if (bar.isEmpty()) return;
  const CompareCurves& curves = chart_.curves();
  const TimedProfile& timed = ofB ? *curves.b : *curves.a;
  const double beginS = ofB ? curves.offsetS : 0.0;
  const QColor color = sideColor(ofB ? CompareSide::kB : CompareSide::kA);
  QColor fill = color;
  fill.setAlpha(70);
  painter.setPen(QPen(color, 1.0, ofB ? Qt::DashLine : Qt::SolidLine));
  painter.setBrush(fill);
  painter.drawRoundedRect(bar.adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
  const ThemeColors& colors = colorsOf();
  for (const Gap& gap : timed.timing.gaps) {
    const double from = chart_.pixelOf(beginS + timed.timeS(gap.frame));
    const double to = chart_.pixelOf(beginS + timed.timeS(gap.frame) + gap.seconds);
    if (to - from > 1.0)
      painter.fillRect(QRectF(from, bar.top() + 1, to - from, bar.height() - 2), colors.window);
  }
  if (!timed.contact) return;
  const double contact = chart_.pixelOf(beginS + timed.timeS(*timed.contact));
  painter.fillRect(QRectF(contact - kContact / 2, bar.top() - 2, kContact, bar.height() + 4),
                   colors.text);
}

void CompareStrip::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), colorsOf().window);
  const QRect plot = chart_.axisRect()->rect();
  painter.setPen(colorsOf().muted);
  for (const bool ofB : {false, true}) {
    const QRectF name(0,
                      kCompareStripAround + (ofB ? kBar + kCompareStripBetween : 0) - 3,
                      plot.left() - 8,
                      kBar + 6);
    painter.drawText(name, Qt::AlignRight | Qt::AlignVCenter, ofB ? "B" : "A");
  }
  painter.setClipRect(plot.left() - 1, 0, plot.width() + 3, height());
  painter.setRenderHint(QPainter::Antialiasing);
  paintBar(painter, false);
  paintBar(painter, true);
}

void CompareStrip::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !barRect(true).contains(event->position())) return;
  dragging_ = true;
  dragFromPixel_ = event->position().x();
  dragFromOffsetS_ = chart_.curves().offsetS;
  dragSecondsPerPixel_ = chart_.secondsAt(1.0) - chart_.secondsAt(0.0);
}

void CompareStrip::mouseMoveEvent(QMouseEvent* event) {
  if (dragging_)
    emit shifted(dragFromOffsetS_ +
                 (event->position().x() - dragFromPixel_) * dragSecondsPerPixel_);
  else if (barRect(true).contains(event->position()))
    setCursor(Qt::SizeHorCursor);
  else
    unsetCursor();
}

void CompareStrip::mouseReleaseEvent(QMouseEvent*) {
  if (!dragging_) return;
  dragging_ = false;
  emit shiftEnded();
}

}  // namespace palpate::gui
