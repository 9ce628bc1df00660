#include "gui/appearance/captions.h"

#include <QFont>
#include <QLabel>
#include <utility>

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
  static constexpr std::pair<const char*, const char*> kWords[] = {
      {"'palpate recover'", "File > Recover…"},
      {"'palpate import'", "File > Import…"},
      {"'palpate convert'", "File > Export…"},
      {"'palpate ports'", "Connect… (Ctrl+K)"},
      {"give another name, or --force to replace it", "choose another name"},
      {"give another folder, or --force to replace them", "choose another folder"},
      {"write .h5, or a part with --from and --to", "export .h5, or a selection of the timeline"},
      {"read the file with --decimal comma", "choose decimal comma"},
      {"read it with --decimal comma", "choose decimal comma"},
      {"choose by --time-unit dmy or mdy", "choose the unit date, day first or month first"},
      {"--time-unit dmy", "the unit date, day first"},
      {"choose another one by --time-unit", "choose another unit"},
      {" (--time-unit)", " (Time)"},
      {" (--time)", " (Time)"},
      {" (--rate)", " (Time, in Hz)"},
      {"--rate keeps all rows", "a rate (Time, in Hz) keeps all rows"},
      {" (--matrix)", " (in the table of matrices)"},
      {" (--matrix A..B --components interleaved)", " (in the table of matrices)"},
      {"--components planar: all x", "choose another order under Components: all x"},
      {"train one with --classifier gauss", "train one with the classifier gauss"},
      {"(palpate train --empty-hand-zero, or Zero before Train)", "(Zero before Train)"},
      {" isn't known (--area)", " isn't known"},
  };
  for (const auto& [command, window] : kWords) message.replace(command, window);
  return message;
}

}  // namespace palpate::gui
