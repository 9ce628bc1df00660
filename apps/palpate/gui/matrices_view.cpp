#include "gui/matrices_view.h"

#include <QEvent>
#include <QMouseEvent>
#include <QPaintEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace palpate::gui {

MatricesView::MatricesView(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName("Matrices");
}

void MatricesView::setHand(const HandDescription& hand) {
  hand_ = hand;
  frame_.reset();
  setHover(std::nullopt);
  renew();
}

void MatricesView::clear() {
  hand_.reset();
  frame_.reset();
  setHover(std::nullopt);
  renew();
}

void MatricesView::setFrame(const TactileFrame& frame) {
  if (!hand_) return;
  const bool first = !frame_;
  QRegion changed;
  for (std::size_t m = 0; m < geometry_.numMatrices() && !first; ++m)
    if (frame.matrix(m) != static_cast<const TactileFrame&>(*frame_).matrix(m))
      changed += geometry_.matrixRect(m).toAlignedRect();
  frame_ = frame;
  if (first)
    update();
  else if (!changed.isEmpty())
    update(changed);
  if (hover_) emit hovered(hoverText());
}

void MatricesView::setLook(const MatricesLook& look) {
  if (look == look_) return;
  look_ = look;
  renew();
}

MatricesPictureOptions MatricesView::pictureOptions() const {
  MatricesPictureOptions options;
  options.map = look_.map;
  options.interpolated = look_.interpolated;
  options.values = look_.values;
  options.rangeMin = look_.range.minimum;
  options.rangeMax = look_.range.maximum;
  options.theme = look_.theme;
  options.pixelRatio = devicePixelRatioF();
  options.font = font();
  return options;
}

void MatricesView::renew() {
  background_ = QPixmap();
  geometry_ = hand_ ? MatricesGeometry(rect(), *hand_, pictureOptions()) : MatricesGeometry();
  update();
}

void MatricesView::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  if (!hand_) {
    painter.fillRect(event->rect(), colorsOf(look_.theme).window);
    return;
  }
  const MatricesPictureOptions options = pictureOptions();
  if (background_.isNull()) {
    background_ = QPixmap(size() * devicePixelRatioF());
    background_.setDevicePixelRatio(devicePixelRatioF());
    QPainter onPixmap(&background_);
    paintMatricesBackground(onPixmap, geometry_, *hand_, look_.range, options);
  }
  for (const QRect& part : event->region()) {
    const QRectF source(QPointF(part.topLeft()) * devicePixelRatioF(),
                        QSizeF(part.size()) * devicePixelRatioF());
    painter.drawPixmap(QRectF(part), background_, source);
  }
  if (!frame_) return;
  for (std::size_t m = 0; m < geometry_.numMatrices(); ++m)
    if (event->region().intersects(geometry_.matrixRect(m).toAlignedRect()))
      paintMatrixValues(painter, geometry_, m, *frame_, *hand_, look_.range, options);
  if (hover_) {
    painter.setPen(QPen(colorsOf(look_.theme).accent, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(geometry_.taxelRect(hover_->matrix, hover_->y, hover_->x));
  }
}

void MatricesView::resizeEvent(QResizeEvent*) { renew(); }

void MatricesView::changeEvent(QEvent* event) {
  if (event->type() == QEvent::FontChange) renew();
  QWidget::changeEvent(event);
}

void MatricesView::setHover(std::optional<TaxelPlace> place) {
  if (place == hover_) return;
  hover_ = place;
  update();
  emit hovered(hoverText());
}

void MatricesView::mouseMoveEvent(QMouseEvent* event) {
  std::optional<TaxelPlace> place;
  if (hand_ && frame_) place = geometry_.placeAt(event->position());
  if (place && !hand_->layout->matrix(place->matrix).exists(place->y, place->x)) place.reset();
  setHover(place);
  if (place)
    QToolTip::showText(event->globalPosition().toPoint() + QPoint(12, 8), hoverText(), this);
  else
    QToolTip::hideText();
}

void MatricesView::leaveEvent(QEvent*) { setHover(std::nullopt); }

QString MatricesView::hoverText() const {
  if (!hover_ || !hand_ || !frame_) return {};
  const auto [m, y, x] = *hover_;
  const MatrixLayout& layout = hand_->layout->matrix(m);
  const QString place = QString::fromStdString(hand_->matrixName(m)) + " · x " +
                        QString::number(x) + ", y " + QString::number(y) + " · ";
  if (!layout.enabled(y, x)) return place + "masked: not scanned";
  const float value = static_cast<const TactileFrame&>(*frame_).matrix(m)(y, x);
  if (!(value > 0.0F)) return place + "0 counts, at rest";
  const QString number = value == std::round(value)
                             ? QString::number(std::lround(value))
                             : QString::number(static_cast<double>(value), 'f', 2);
  return place + number + " counts" + (value >= hand_->saturationCounts ? ", saturated" : "");
}

}  // namespace palpate::gui
