#include "gui/matrices/matrices_view.h"

#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPaintEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <limits>

#include "gui/matrices/taxel_text.h"

namespace palpate::gui {
namespace {

constexpr const char* kBlind = "blind";

// The direction of an arrow key; null: another key.
QPoint directionOf(int key) {
  switch (key) {
    case Qt::Key_Left:
      return {-1, 0};
    case Qt::Key_Right:
      return {1, 0};
    case Qt::Key_Up:
      return {0, -1};
    case Qt::Key_Down:
      return {0, 1};
    default:
      return {};
  }
}

}  // namespace

MatricesView::MatricesView(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName("Matrices");
  setFocusPolicy(Qt::TabFocus);
}

void MatricesView::setHand(const HandDescription& hand) {
  // When only the mask of the hand changes, the selection stays.
  const TaxelSelection fresh(*hand.layout);
  if (selection_.numMatrices() != fresh.numMatrices()) selection_ = fresh;
  hand_ = hand;
  frame_.reset();
  unmeasurable_.clear();
  paintedUs_ = 0;
  setHover(std::nullopt);
  renew();
}

void MatricesView::clear() {
  hand_.reset();
  selection_ = {};
  stale_ = {};
  unmeasurable_.clear();
  paintedUs_ = 0;
  frame_.reset();
  setHover(std::nullopt);
  renew();
}

void MatricesView::setPressure(std::shared_ptr<const PressureFrame> pressure) {
  pressure_ = std::move(pressure);
  if (hover_) emit hovered(hoverText());
}

void MatricesView::setFrame(const TactileFrame& frame) {
  if (!hand_) return;
  // Readings may shear or change their sign where the values stay; arrows leave their matrix.
  const bool first = !frame_ || frame_->readings != frame.readings;
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
  options.taxels = look_.taxels;
  options.isSigned = look_.isSigned;
  options.arrows = look_.arrows;
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
  // The window may have moved to another screen.
  if (!background_.isNull() && background_.devicePixelRatio() != devicePixelRatioF()) renew();
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
  for (std::size_t m = 0; frame_ && m < geometry_.numMatrices(); ++m)
    if (event->region().intersects(geometry_.matrixRect(m).toAlignedRect()))
      paintMatrixValues(painter, geometry_, m, *frame_, *hand_, look_.range, options);
  for (std::size_t m = 0; frame_ && m < geometry_.numMatrices(); ++m)
    paintShear(painter, geometry_, m, *frame_, look_.range, options);
  if (hover_) {
    painter.setPen(QPen(colorsOf(look_.theme).accent, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(geometry_.taxelRect(hover_->matrix, hover_->y, hover_->x));
  }
  paintUnmeasurable(painter);
  for (const std::size_t m : slipping_) paintFrame(painter, m, "slip");
  paintSelection(painter);
  paintStaleNotice(painter, rect(), stale_, look_.theme);
  if (!frame_ || frame_->hostUs == paintedUs_) return;
  paintedUs_ = frame_->hostUs;
  emit painted(paintedUs_);
}

// Paints an outline around the selection; inner borders would hide the values.
void MatricesView::paintSelection(QPainter& painter) const {
  if (selection_.empty()) return;
  painter.setPen(QPen(colorsOf(look_.theme).accent, 2.0));
  for (std::size_t m = 0; m < geometry_.numMatrices(); ++m) {
    const MatrixLayout& layout = hand_->layout->matrix(m);
    const auto chosen = [&](int y, int x) {
      return y >= 0 && y < layout.rows && x >= 0 && x < layout.columns &&
             selection_.contains(m, y, x);
    };
    for (int y = 0; y < layout.rows; ++y)
      for (int x = 0; x < layout.columns; ++x) {
        if (!chosen(y, x)) continue;
        const QRectF rect = geometry_.taxelRect(m, y, x).adjusted(0, 0, -1, -1);
        if (!chosen(y - 1, x)) painter.drawLine(rect.topLeft(), rect.topRight());
        if (!chosen(y + 1, x)) painter.drawLine(rect.bottomLeft(), rect.bottomRight());
        if (!chosen(y, x - 1)) painter.drawLine(rect.topLeft(), rect.bottomLeft());
        if (!chosen(y, x + 1)) painter.drawLine(rect.topRight(), rect.bottomRight());
      }
  }
}

void MatricesView::setUnmeasurable(const std::vector<QString>& why) {
  if (why == unmeasurable_) return;
  unmeasurable_ = why;
  update();
}

void MatricesView::setSlipping(const std::set<std::size_t>& matrices) {
  if (matrices == slipping_) return;
  slipping_ = matrices;
  update();
}

// Dark taxels of a matrix that can't measure the limit don't mean that there is no contact.
void MatricesView::paintUnmeasurable(QPainter& painter) const {
  for (std::size_t m = 0; m < unmeasurable_.size(); ++m)
    if (!unmeasurable_[m].isEmpty()) paintFrame(painter, m, kBlind);
}

void MatricesView::paintFrame(QPainter& painter, std::size_t matrix, const QString& word) const {
  if (matrix >= geometry_.numMatrices()) return;
  const QColor& color = colorsOf(look_.theme).danger;
  const QRectF rect = geometry_.matrixRect(matrix);
  painter.setPen(QPen(color, 3.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(rect.adjusted(1.5, 1.5, -1.5, -1.5));
  // In the place of the name, so that no taxel is covered; without names on the lowest row.
  const QFontMetricsF metrics(font());
  const QRectF name = geometry_.nameRect(matrix);
  const bool named = name.height() > 0.0;
  const auto fits = [&](const QString& text) {
    return metrics.horizontalAdvance(text + ": " + word) + 12.0 <= name.width();
  };
  const QString whose = named ? matrixNameWithin(*hand_, matrix, fits) : QString();
  const QString text = named && fits(whose) ? whose + ": " + word : word;
  const QRectF place =
      metrics.boundingRect(named ? name : rect, Qt::AlignHCenter | Qt::AlignBottom, text)
          .adjusted(-6.0, named ? 0.0 : -6.0, 6.0, named ? 0.0 : -3.0);
  painter.fillRect(named ? name.united(place) : place, color);
  painter.setPen(colorsOf(look_.theme).window);
  painter.drawText(place, Qt::AlignCenter, text);
}

void MatricesView::setStale(const StaleNotice& old) {
  if (old == stale_) return;
  stale_ = old;
  update();
}

void MatricesView::select(const TaxelSelection& selection) {
  if (selection == selection_ || selection.numMatrices() != selection_.numMatrices()) return;
  selection_ = selection;
  update();
  emit selectionChanged();
}

void MatricesView::clearSelection() {
  TaxelSelection none = selection_;
  none.clear();
  select(none);
}

void MatricesView::choose(const TaxelPlace& from, const TaxelPlace& to) {
  TaxelSelection wanted = selectedBefore_;
  if (from == to && wanted.contains(from.matrix, from.y, from.x))
    // Ctrl+click on a selected taxel.
    wanted.toggle(from.matrix, from.y, from.x);
  else
    wanted.add(from.matrix, from.y, from.x, to.y, to.x);
  select(wanted);
}

void MatricesView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !hand_) return QWidget::mousePressEvent(event);
  selectedBefore_ = selection_;
  if (!(event->modifiers() & Qt::ControlModifier)) selectedBefore_.clear();
  pressed_ = geometry_.placeAt(event->position());
  if (pressed_)
    choose(*pressed_, *pressed_);
  else
    select(selectedBefore_);
}

void MatricesView::mouseReleaseEvent(QMouseEvent*) { pressed_.reset(); }

void MatricesView::contextMenuEvent(QContextMenuEvent* event) {
  if (hand_) emit menuRequested(event->globalPos());
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
  setAccessibleDescription(hoverText());
  emit hovered(hoverText());
}

void MatricesView::mouseMoveEvent(QMouseEvent* event) {
  std::optional<TaxelPlace> place;
  if (hand_) place = geometry_.placeAt(event->position());
  if (pressed_ && (event->buttons() & Qt::LeftButton)) {
    // A drag stays in its matrix, wherever the mouse pointer is.
    const QRectF matrix = geometry_.matrixRect(pressed_->matrix);
    const QSizeF taxel = geometry_.taxelSize(pressed_->matrix);
    const QPointF inside(std::clamp(event->position().x(), matrix.left(), matrix.right() - 1),
                         std::clamp(event->position().y(), matrix.top(), matrix.bottom() - 1));
    choose(*pressed_,
           {pressed_->matrix,
            static_cast<int>((inside.y() - matrix.top()) / taxel.height()),
            static_cast<int>((inside.x() - matrix.left()) / taxel.width())});
  }
  if (place && !hand_->layout->matrix(place->matrix).exists(place->y, place->x)) place.reset();
  setHover(place);
  if (place)
    QToolTip::showText(event->globalPosition().toPoint() + QPoint(12, 8), hoverText(), this);
  else
    QToolTip::hideText();
}

std::optional<TaxelPlace> MatricesView::neighbour(const std::optional<TaxelPlace>& from,
                                                  const QPoint& direction) const {
  if (!hand_) return std::nullopt;
  const QPointF begin =
      from ? geometry_.taxelRect(from->matrix, from->y, from->x).center() : QPointF();
  std::optional<TaxelPlace> nearest = from;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < geometry_.numMatrices(); ++m) {
    const MatrixLayout& layout = hand_->layout->matrix(m);
    for (int y = 0; y < layout.rows; ++y)
      for (int x = 0; x < layout.columns; ++x) {
        if (!layout.exists(y, x)) continue;
        if (!from) return TaxelPlace{m, y, x};
        const QPointF to = geometry_.taxelRect(m, y, x).center() - begin;
        const double along = to.x() * direction.x() + to.y() * direction.y();
        const double aside = std::abs(to.x() * direction.y()) + std::abs(to.y() * direction.x());
        // What lies more aside than ahead is in another direction.
        if (along < 1.0 || aside > along || along + 2.0 * aside >= least) continue;
        least = along + 2.0 * aside;
        nearest = TaxelPlace{m, y, x};
      }
  }
  return nearest;
}

void MatricesView::keyPressEvent(QKeyEvent* event) {
  const QPoint direction = directionOf(event->key());
  const bool isSpace = event->key() == Qt::Key_Space;
  if (hand_ && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)) {
    hasKeys_ = !hasKeys_;
    setHover(hasKeys_ ? neighbour({}, {}) : std::nullopt);
    return;
  }
  if (!hand_ || !hasKeys_ || (direction.isNull() && !isSpace)) return QWidget::keyPressEvent(event);
  selectedBefore_ = selection_;
  if (isSpace) {
    if (hover_) choose(*hover_, *hover_);
    return;
  }
  const std::optional<TaxelPlace> from = hover_;
  setHover(neighbour(from, direction));
  if (!(event->modifiers() & Qt::ShiftModifier)) return;
  for (const auto& place : {from, hover_})
    if (place) selectedBefore_.add(place->matrix, place->y, place->x, place->y, place->x);
  select(selectedBefore_);
}

void MatricesView::focusOutEvent(QFocusEvent* event) {
  // A window that is left for another program comes back as it was.
  if (event->reason() != Qt::ActiveWindowFocusReason) {
    if (hasKeys_) setHover(std::nullopt);
    hasKeys_ = false;
  }
  QWidget::focusOutEvent(event);
}

bool MatricesView::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && hasKeys_) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool isPlain = !(key->modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier));
    if (isPlain && (!directionOf(key->key()).isNull() || key->key() == Qt::Key_Space))
      event->accept();
  }
  return QWidget::event(event);
}

void MatricesView::leaveEvent(QEvent*) { setHover(std::nullopt); }

void MatricesView::setUnits(const DisplayUnits& units) {
  units_ = units;
  if (hover_) emit hovered(hoverText());
}

QString MatricesView::hoverText() const {
  if (!hover_ || !hand_) return {};
  const QString text = taxelText(*hand_, *hover_, frame_, pressure_.get(), units_);
  const std::size_t m = hover_->matrix;
  return m < unmeasurable_.size() && !unmeasurable_[m].isEmpty() ? text + " · " + unmeasurable_[m]
                                                                 : text;
}

}  // namespace palpate::gui
