#include "gui/taxel_text.h"

#include <cmath>

namespace palpate::gui {

QString taxelText(const HandDescription& hand,
                  const TaxelPlace& place,
                  const std::optional<TactileFrame>& frame) {
  const auto [m, y, x] = place;
  const MatrixLayout& layout = hand.layout->matrix(m);
  const QString where = QString::fromStdString(hand.matrixName(m)) + " · x " + QString::number(x) +
                        ", y " + QString::number(y) + " · ";
  if (!layout.enabled(y, x)) return where + "masked: not scanned";
  if (!frame) return where + "no frame yet";
  const float value = frame->matrix(m)(y, x);
  if (!(value > 0.0F)) return where + "0 counts, at rest";
  const QString number = value == std::round(value)
                             ? QString::number(std::lround(value))
                             : QString::number(static_cast<double>(value), 'f', 2);
  return where + number + " counts" + (value >= hand.saturationCounts ? ", saturated" : "");
}

}  // namespace palpate::gui
