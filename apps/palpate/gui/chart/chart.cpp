#include "gui/chart/chart.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/appearance/theme.h"
#include "gui/appearance/theme_change.h"
#include "gui/chart/chart_style.h"
#include "gui/chart/span_overlay.h"

namespace palpate::gui {

Chart::Chart(QWidget* parent) : QCustomPlot(parent) {
  arrangeChart(*this);
  setMouseTracking(true);
}

void Chart::addCursor(int widthPx) {
  cursorPx_ = widthPx;
  cursor_ = overlayOn(this, "cursor");
  // Margins are known only after the axes have been laid out.
  connect(this, &QCustomPlot::afterReplot, this, &Chart::placeCursor);
}

QCPAxisRect* Chart::addBelow(double share) {
  below_ = new QCPAxisRect(this);
  plotLayout()->addElement(1, 0, below_);
  plotLayout()->setRowStretchFactor(1, share);
  plotLayout()->setRowSpacing(0);
  xAxis->setTickLabels(false);
  for (QCPAxis* axis : below_->axes()) {
    axis->setLayer("axes");
    axis->grid()->setLayer("grid");
  }
  auto* sides = new QCPMarginGroup(this);
  for (QCPAxisRect* each : {axisRect(), below_})
    each->setMarginGroup(QCP::msLeft | QCP::msRight, sides);
  return below_;
}

void Chart::setVisibleRange(double from, double to) {
  if (!(to > from)) return;
  xAxis->setRange(from, to);
  if (below_) below_->axis(QCPAxis::atBottom)->setRange(from, to);
  replot(QCustomPlot::rpQueuedReplot);
}

void Chart::setPosition(double at) {
  position_ = at;
  placeCursor();
}

void Chart::placeCursor() {
  if (!cursor_) return;
  if (!std::isfinite(position_)) return cursor_->hide();
  const QRect plot = axisRect()->rect();
  constexpr double kFar = 1e6;  // [px]
  const int x =
      static_cast<int>(std::lround(std::clamp(pixelOf(position_ - origin_), -kFar, kFar)));
  const bool inside = x >= plot.left() - 1 && x <= plot.right() + 2;
  const int height = (below_ ? below_->rect().bottom() : plot.bottom() + 1) - plot.top();
  const QRect place(x - cursorPx_ / 2, plot.top(), cursorPx_, height);
  if (cursor_->geometry() != place) cursor_->setGeometry(place);
  if (cursor_->isHidden() == inside) cursor_->setVisible(inside);
}

void Chart::restyle() {
  const ThemeColors& colors = colorsOf();
  styleChart(*this);
  if (below_)
    for (QCPAxis* axis : below_->axes()) styleExtraAxis(*axis, *this);
  legend->setFont(font());
  legend->setTextColor(colors.muted);
  legend->setBrush(Qt::NoBrush);
  legend->setBorderPen(Qt::NoPen);
  legend->setRowSpacing(-4);
  if (cursor_) cursor_->setStyleSheet("background: " + colors.accent.name());
  style();
  replot(QCustomPlot::rpQueuedReplot);
}

QCPRange Chart::zoomed(double about, double factor, double shortest, double longest) const {
  const QCPRange range = xAxis->range();
  const double span = std::clamp(range.size() / factor, shortest, longest);
  const double share = (about - range.lower) / range.size();
  return {about - share * span, about + (1.0 - share) * span};
}

std::optional<QCPRange> Chart::pageWith(double position) const {
  const QCPRange range = xAxis->range();
  if (range.contains(position)) return std::nullopt;
  const double span = range.size();
  const double from = position - (position > range.upper ? kPageRest : 1.0 - kPageRest) * span;
  return QCPRange(from, from + span);
}

bool Chart::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), readingAt(help->pos()), this);
    return true;
  }
  const bool handled = QCustomPlot::event(event);
  if (event->type() == QEvent::FontChange || event->type() == themeChange()) restyle();
  return handled;
}

void Chart::resizeEvent(QResizeEvent* event) {
  QCustomPlot::resizeEvent(event);
  resized();
}

void Chart::mousePressEvent(QMouseEvent* event) {
  if (cursor_ && event->button() == Qt::LeftButton)
    emit seekRequested(origin_ + secondsAt(event->position().x()));
}

void Chart::mouseMoveEvent(QMouseEvent* event) {
  if (cursor_ && event->buttons() & Qt::LeftButton)
    emit seekRequested(origin_ + secondsAt(event->position().x()));
}

void Chart::wheelEvent(QWheelEvent* event) {
  constexpr double kPan = 0.1;  // movement per notch, as a share of the visible range
  const double notches = event->angleDelta().y() / kWheelNotch;
  const double sideways = event->angleDelta().x() / kWheelNotch;
  if (sideways != 0.0 || event->modifiers() & Qt::ShiftModifier)
    panBy(-(sideways != 0.0 ? sideways : notches) * kPan * xAxis->range().size());
  else
    zoomAbout(secondsAt(event->position().x()), std::pow(kWheelZoom, notches));
  event->accept();
}

}  // namespace palpate::gui
