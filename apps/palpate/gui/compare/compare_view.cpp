#include "gui/compare/compare_view.h"

#include <QMouseEvent>
#include <QPaintEvent>
#include <QPainter>
#include <QToolTip>
#include <cmath>

#include "gui/appearance/difference_map.h"
#include "gui/appearance/hand_unit.h"

namespace palpate::gui {
namespace {

bool sameOptions(const ComparePictureOptions& a, const ComparePictureOptions& b) {
  return a.look.map == b.look.map && a.look.interpolated == b.look.interpolated &&
         a.look.values == b.look.values && a.look.rangeMin == b.look.rangeMin &&
         a.look.rangeMax == b.look.rangeMax && a.look.theme == b.look.theme &&
         a.largestDifference == b.largestDifference;
}

bool has(const HandDescription& hand, const TaxelPlace& place) {
  return place.matrix < hand.layout->numMatrices() &&
         hand.layout->matrix(place.matrix).exists(place.y, place.x);
}

}  // namespace

CompareView::CompareView(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName("Heat maps of A, of B, and their difference");
}

void CompareView::setHands(const ComparedHands& hands) {
  hands_ = hands;
  frames_ = {};
  setHover(std::nullopt);
  renew();
}

void CompareView::clear() {
  hands_.reset();
  frames_ = {};
  setHover(std::nullopt);
  renew();
}

void CompareView::setFrames(ComparedFrames frames) {
  frames_ = std::move(frames);
  update();
  if (hover_) emit hovered(hoverText());
}

void CompareView::setOptions(const ComparePictureOptions& options) {
  ComparePictureOptions wanted = options;
  wanted.look.font = font();
  wanted.look.pixelRatio = devicePixelRatioF();
  if (sameOptions(wanted, options_)) return;
  options_ = wanted;
  renew();
}

void CompareView::renew() {
  options_.look.font = font();
  options_.look.pixelRatio = devicePixelRatioF();
  background_ = QPixmap();
  geometry_ = hands_ ? CompareGeometry(rect(), *hands_, options_) : CompareGeometry();
  update();
}

void CompareView::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  if (!hands_) return painter.fillRect(event->rect(), colorsOf(options_.look.theme).window);
  // The window may have moved to another screen.
  if (!background_.isNull() && background_.devicePixelRatio() != devicePixelRatioF()) renew();
  if (background_.isNull()) {
    background_ = QPixmap(size() * devicePixelRatioF());
    background_.setDevicePixelRatio(devicePixelRatioF());
    QPainter onPixmap(&background_);
    paintCompareBackground(onPixmap, geometry_, *hands_, options_);
  }
  painter.drawPixmap(0, 0, background_);
  paintCompareValues(painter, geometry_, *hands_, frames_, options_);
  if (!hover_) return;
  // Marks the same taxel in all three groups.
  painter.setPen(QPen(colorsOf(options_.look.theme).accent, 2.0));
  painter.setBrush(Qt::NoBrush);
  for (const CompareGroup group : kAllCompareGroups)
    if (has(hands_->of(group), *hover_))
      painter.drawRect(geometry_.group(group).taxelRect(hover_->matrix, hover_->y, hover_->x));
}

void CompareView::resizeEvent(QResizeEvent*) { renew(); }

void CompareView::changeEvent(QEvent* event) {
  if (event->type() == QEvent::FontChange) renew();
  QWidget::changeEvent(event);
}

void CompareView::setHover(std::optional<TaxelPlace> place) {
  if (place == hover_) return;
  hover_ = place;
  update();
  emit hovered(hoverText());
}

void CompareView::mouseMoveEvent(QMouseEvent* event) {
  std::optional<TaxelPlace> place;
  if (const auto at = hands_ ? geometry_.placeAt(event->position()) : std::nullopt)
    if (has(hands_->of(at->group), at->taxel)) place = at->taxel;
  setHover(place);
  if (place)
    QToolTip::showText(event->globalPosition().toPoint() + QPoint(12, 8), hoverText(), this);
  else
    QToolTip::hideText();
}

void CompareView::leaveEvent(QEvent*) { setHover(std::nullopt); }

QString CompareView::valueText(CompareGroup group) const {
  const HandDescription& hand = hands_->of(group);
  if (!has(hand, *hover_)) return "has no such taxel";
  const TactileFrame& frame = frames_[static_cast<std::size_t>(group)].frame;
  const bool enabled = hand.layout->matrix(hover_->matrix).enabled(hover_->y, hover_->x);
  if (!enabled) return group == CompareGroup::kDifference ? "not compared" : "not scanned";
  if (frame.values.size() != hand.layout->numCells()) return "no frame";
  const auto value = static_cast<double>(frame.matrix(hover_->matrix)(hover_->y, hover_->x));
  const int decimals = value == std::round(value) ? 0 : 2;
  if (group == CompareGroup::kDifference) return signedText(value, decimals) + " " + unitOf(hand);
  return QString::number(value, 'f', decimals) +
         (frame.matrix(hover_->matrix)(hover_->y, hover_->x) >= hand.saturationOf(hover_->matrix)
              ? " (saturated)"
              : "");
}

QString CompareView::hoverText() const {
  if (!hover_ || !hands_) return {};
  const bool inA = has(hands_->a, *hover_);
  const HandDescription& named = inA ? hands_->a : hands_->b;
  return QString::fromStdString(named.matrixName(hover_->matrix)) + " · x " +
         QString::number(hover_->x) + ", y " + QString::number(hover_->y) + " · A " +
         valueText(CompareGroup::kA) + " · B " + valueText(CompareGroup::kB) + " · A − B " +
         valueText(CompareGroup::kDifference);
}

}  // namespace palpate::gui
