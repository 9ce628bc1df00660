#include "gui/recognise/answer_view.h"

#include <QPainter>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr double kAirUnits = 0.9;
constexpr double kUnitsHigh = 19.0;  // size in text units when the text is as large as fits
constexpr double kUnitsWide = 30.0;

}  // namespace

AnswerView::AnswerView(PhotoCache& photos, double scale, QWidget* parent)
    : QWidget(parent), photos_(photos), scale_(scale) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void AnswerView::setAnswer(const RecognitionAnswer& answer) {
  answer_ = answer;
  setAccessibleName(answer.accessibleText());
  update();
}

void AnswerView::setTheme(Theme theme) {
  theme_ = theme;
  update();
}

void AnswerView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const double unit = scale_ > 0.0
                          ? scale_ * fontInfo().pixelSize()
                          : std::max(10.0, std::min(height() / kUnitsHigh, width() / kUnitsWide));
  const double air = kAirUnits * unit;
  static const QPixmap none;
  paintAnswer(painter,
              QRectF(rect()).adjusted(air, air, -air, -air),
              answer_,
              answer_.name().isEmpty() ? none : photos_.photo(answer_.name()),
              theme_,
              unit);
}

}  // namespace palpate::gui
