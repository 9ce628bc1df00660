#include "gui/appearance/hand_unit.h"

namespace palpate::gui {

QString unitOf(const HandDescription& hand) { return QString::fromStdString(hand.unit); }

int decimalsOf(const HandDescription& hand) {
  constexpr int kMaxDecimals = 6;
  constexpr double kThreeDigits = 100.0;
  int decimals = 0;
  double scaled = static_cast<double>(hand.maximumCounts);
  for (; scaled < kThreeDigits && decimals < kMaxDecimals; scaled *= 10.0) ++decimals;
  return decimals;
}

}  // namespace palpate::gui
