#include "gui/recognise/answer_view.h"

#include <QPainter>
#include <QResizeEvent>
#include <algorithm>
#include <cmath>

namespace palpate::gui {
namespace {

constexpr double kAirUnits = 0.9;
constexpr double kUnitsHigh = 19.0;  // size in text units when the text is as large as fits
constexpr double kUnitsWide = 30.0;
constexpr double kMinAnswerUnit = 10.0;  // [px]
constexpr double kSmallerAnswer = 0.97;  // a step of the search for the size that fits

}  // namespace

AnswerView::AnswerView(PhotoCache& photos, double scale, QWidget* parent)
    : QWidget(parent), photos_(photos), scale_(scale) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&photos, &PhotoCache::changed, this, [this] {
    askForHeight();
    update();
  });
}

void AnswerView::setAnswer(const RecognitionAnswer& answer) {
  answer_ = answer;
  renewAccessibleName();
  askForHeight();
  update();
}

void AnswerView::setStale(const QString& reason) {
  if (reason == stale_.notice) return;
  stale_.notice = reason;
  renewAccessibleName();
  update();
}

void AnswerView::renewAccessibleName() {
  setAccessibleName(stale_.notice.isEmpty() ? answer_.accessibleText() : stale_.notice);
}

double AnswerView::textHeight() const {
  if (scale_ > 0.0) return scale_ * fontInfo().pixelSize();
  double unit = std::max(kMinAnswerUnit, std::min(height() / kUnitsHigh, width() / kUnitsWide));
  while (unit > kMinAnswerUnit && neededHeight(unit) > height())
    unit = std::max(kMinAnswerUnit, kSmallerAnswer * unit);
  return unit;
}

double AnswerView::neededHeight(double unit) const {
  // The last lines may need several rows: painted onto nothing, they tell their height.
  QPixmap nothing(1, 1);
  QPainter painter(&nothing);
  painter.setFont(font());
  constexpr double kAnyHeight = 1e6;
  const double air = kAirUnits * unit;
  return air + paintAnswer(painter,
                           QRectF(air, air, width() - 2.0 * air, kAnyHeight),
                           answer_,
                           photo(),
                           shownTheme(),
                           unit);
}

void AnswerView::askForHeight() {
  // A view that has no place yet has no width to go by.
  if (scale_ <= 0.0 || width() < minimumSizeHint().width()) return;
  setMinimumHeight(std::max(minimumSizeHint().height(),
                            static_cast<int>(std::ceil(neededHeight(textHeight())))));
}

void AnswerView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  if (event->size().width() != event->oldSize().width()) askForHeight();
}

void AnswerView::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) askForHeight();
}

const QPixmap& AnswerView::photo() const {
  static const QPixmap none;
  return answer_.name().isEmpty() ? none : photos_.photo(answer_.name());
}

void AnswerView::paintEvent(QPaintEvent*) {
  const double unit = textHeight();
  const double air = kAirUnits * unit;
  QPainter painter(this);
  paintAnswer(
      painter, QRectF(rect()).adjusted(air, air, -air, -air), answer_, photo(), shownTheme(), unit);
  if (stale_.notice.isEmpty()) return;
  QFont large = font();
  large.setPixelSize(std::max(1, static_cast<int>(unit)));
  painter.setFont(large);
  paintStaleNotice(painter, rect(), stale_);
}

}  // namespace palpate::gui
