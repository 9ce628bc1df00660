#include "gui/widgets/eliding_box.h"

#include <QStyleOptionComboBox>
#include <QStylePainter>
#include <algorithm>

namespace palpate::gui {

QSize ElidingBox::minimumSizeHint() const {
  constexpr int kMinimumWidth = 80;  // [px]
  const QSize whole = QComboBox::minimumSizeHint();
  return {std::min(kMinimumWidth, whole.width()), whole.height()};
}

void ElidingBox::paintEvent(QPaintEvent*) {
  QStyleOptionComboBox option;
  initStyleOption(&option);
  if (currentIndex() < 0) option.currentText = placeholderText();
  constexpr int kAround = 4;  // [px]
  const int room =
      style()
          ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this)
          .width() -
      kAround;
  option.currentText = fontMetrics().elidedText(option.currentText, Qt::ElideMiddle, room);
  QStylePainter painter(this);
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

}  // namespace palpate::gui
