#include "gui/playback/seek_bar.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/desktop/key_policy.h"

namespace palpate::gui {
namespace {

constexpr double kHandleRadius = 7.0;  // [px]
constexpr double kGroove = 4.0;        // [px]

}  // namespace

SeekBar::SeekBar(QWidget* parent) : QSlider(Qt::Horizontal, parent) {
  setProperty(kTakesWheel, true);
  setRange(0, 0);
  setMinimumWidth(120);
  setFixedHeight(22);
  // Shortcuts of the window move it.
  setFocusPolicy(Qt::NoFocus);
  setAccessibleName("Frame");
}

double SeekBar::pixelOf(int frame) const {
  const double span = width() - 2 * kHandleRadius;
  return kHandleRadius + (maximum() > 0 ? span * frame / maximum() : 0.0);
}

int SeekBar::frameAt(double pixel) const {
  const double span = width() - 2 * kHandleRadius;
  if (span <= 0.0) return 0;
  const double fraction = std::clamp((pixel - kHandleRadius) / span, 0.0, 1.0);
  return static_cast<int>(std::lround(fraction * maximum()));
}

void SeekBar::seekTo(double pixel) {
  setValue(frameAt(pixel));
  emit seekRequested(value());
}

void SeekBar::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  setSliderDown(true);
  seekTo(event->position().x());
}

void SeekBar::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) seekTo(event->position().x());
}

void SeekBar::mouseReleaseEvent(QMouseEvent*) { setSliderDown(false); }

void SeekBar::wheelEvent(QWheelEvent* event) {
  const int step = event->angleDelta().y() > 0 ? -1 : 1;
  setValue(value() + step);
  emit seekRequested(value());
  event->accept();
}

void SeekBar::paintEvent(QPaintEvent*) {
  const ThemeColors& colors = colorsOf();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  const double middle = height() / 2.0;
  const double handle = pixelOf(value());
  const QRectF groove(kHandleRadius, middle - kGroove / 2, width() - 2 * kHandleRadius, kGroove);
  painter.setBrush(colors.border);
  painter.drawRoundedRect(groove, kGroove / 2, kGroove / 2);
  if (!isEnabled()) return;
  painter.setBrush(colors.accent);
  QRectF done = groove;
  done.setRight(handle);
  painter.drawRoundedRect(done, kGroove / 2, kGroove / 2);
  painter.setBrush(colors.text);
  painter.drawEllipse(QPointF(handle, middle), kHandleRadius - 1, kHandleRadius - 1);
}

}  // namespace palpate::gui
