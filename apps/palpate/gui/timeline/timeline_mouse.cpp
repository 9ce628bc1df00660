// The mouse in the timeline, and what it tells.
#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/timeline/timeline_chart.h"

namespace palpate::gui {
namespace {

constexpr double kTimelineMouseWheelStep = 1.25;  // zoom per notch
constexpr double kTimelineMouseNotch = 120.0;     // angleDelta of one notch
constexpr double kTimelineMouseWheelPan = 0.1;    // part of what is seen per notch
constexpr double kHandleReach = 6.0;  // [px] beside a handle or the cursor that still take it

}  // namespace

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
  const bool left = event->button() == Qt::LeftButton;
  pressedAt_ = event->position();
  pressedS_ = secondsAt(pressedAt_.x());
  panFrom_ = xAxis->range();
  if ((left && event->modifiers() & Qt::ShiftModifier) || event->button() == Qt::MiddleButton) {
    drag_ = Drag::kPan;
    setCursor(Qt::ClosedHandCursor);
  } else if (left) {
    drag_ = dragAt(pressedAt_);
    if (drag_ == Drag::kScrub) emit sought(pressedS_);
  }
}

void TimelineChart::dragTo(const QPointF& at) {
  const double seconds = std::clamp(secondsAt(at.x()), 0.0, durationS());
  switch (drag_) {
    case Drag::kPan: {
      const double perPixel = panFrom_.size() / std::max(1, axisRect()->width());
      const double moved = (pressedAt_.x() - at.x()) * perPixel;
      return setSeen(panFrom_.lower + moved, panFrom_.upper + moved);
    }
    case Drag::kScrub:
      emit sought(seconds);
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
      // A handle that is dragged over the other one takes its place.
      if (seconds > other) drag_ = Drag::kTo;
      if (seconds < other) drag_ = Drag::kFrom;
      return setSelection(TimeSpan{other, seconds});
    }
    case Drag::kNone:
      break;
  }
}

void TimelineChart::mouseMoveEvent(QMouseEvent* event) {
  if (drag_ != Drag::kNone) return dragTo(event->position());
  if (!recording_) return;
  const Drag here = dragAt(event->position());
  if (here == Drag::kFrom || here == Drag::kTo)
    setCursor(Qt::SizeHorCursor);
  else
    unsetCursor();
}

void TimelineChart::mouseReleaseEvent(QMouseEvent* event) {
  const bool still =
      std::abs(event->position().x() - pressedAt_.x()) < QApplication::startDragDistance();
  // A click: there goes the cursor, and what was chosen elsewhere is let go.
  if (drag_ == Drag::kSelect && still && recording_) {
    if (selection_ && (pressedS_ < selection_->fromS || pressedS_ > selection_->toS))
      setSelection(std::nullopt);
    emit sought(pressedS_);
  }
  drag_ = Drag::kNone;
  unsetCursor();
}

void TimelineChart::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) fit();
}

void TimelineChart::wheelEvent(QWheelEvent* event) {
  if (!recording_) return;
  const double notches = event->angleDelta().y() / kTimelineMouseNotch;
  const double sideways = event->angleDelta().x() / kTimelineMouseNotch;
  if (sideways != 0.0 || event->modifiers() & Qt::ShiftModifier) {
    const QCPRange range = xAxis->range();
    const double moved =
        -(sideways != 0.0 ? sideways : notches) * kTimelineMouseWheelPan * range.size();
    setSeen(range.lower + moved, range.upper + moved);
  } else {
    zoomAbout(secondsAt(event->position().x()), std::pow(kTimelineMouseWheelStep, notches));
  }
  event->accept();
}

void TimelineChart::contextMenuEvent(QContextMenuEvent* event) {
  if (recording_) emit menuAsked(event->globalPos());
}

void TimelineChart::resizeEvent(QResizeEvent* event) {
  QCustomPlot::resizeEvent(event);
  nameAxes();
  refill();
}

QString TimelineChart::valuesAt(double seconds) const {
  if (!recording_ || recording_->profile.numFrames() == 0 || seconds < 0.0 || seconds > durationS())
    return {};
  const std::int64_t atUs = recording_->profile.frameTimeUs(0) + std::llround(seconds * 1e6);
  const std::size_t frame = recording_->profile.frameAt(atUs).value_or(0);
  QString text =
      QString::number(recording_->timeAt(frame), 'f', 2) + " s · frame " + QString::number(frame);
  if (const Gap* gap = recording_->gapAt(seconds))
    return text + "\ngap of " + QString::number(gap->seconds, 'f', 1) + " s: nothing was recorded";
  for (const PlottedCurve& curve : curves_) {
    const auto value = store_.valueAt(curve.choice, seconds);
    const int digits = curve.choice.kind == SeriesChoice::Kind::kMatrix ? 0 : 1;
    text += "\n" + curve.name + "  " +
            (value ? QString::number(*value, 'f', digits) + " " + curve.unit : QString("–"));
  }
  return text;
}

bool TimelineChart::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), valuesAt(secondsAt(help->pos().x())), this);
    return true;
  }
  if (event->type() == QEvent::FontChange) setTheme(theme_);
  return QCustomPlot::event(event);
}

}  // namespace palpate::gui
