#include "gui/widgets/elided_text.h"

#include <QLabel>

namespace palpate::gui {

void showElided(QLabel* label, const QString& text, int widthPx) {
  label->setText(label->fontMetrics().elidedText(text, Qt::ElideMiddle, widthPx));
  label->setToolTip(label->text() == text ? QString() : text);
  label->setAccessibleName(text);
}

}  // namespace palpate::gui
