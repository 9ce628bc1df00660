#include "gui/appearance/captions.h"

#include <QFont>
#include <QLabel>

#include <palpate/core/number_text.h>

namespace palpate::gui {

QLabel* sectionHeading(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text.toUpper(), parent);
  label->setProperty("role", "heading");
  QFont font = label->font();
  constexpr double kSmaller = 0.86;
  font.setPointSizeF(font.pointSizeF() * kSmaller);
  font.setLetterSpacing(QFont::AbsoluteSpacing, 0.8);
  label->setFont(font);
  return label;
}

QString figure(double value, int decimals) {
  return QString::fromStdString(fixedText(value, decimals));
}

QString inWindowWords(QString message) {
  return message.replace("'palpate recover'", "File > Recover…");
}

}  // namespace palpate::gui
