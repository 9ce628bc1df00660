#include "palpate/signals/signal_text_table.h"

#include <string>
#include <utility>
#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/signals/characteristic_signals.h"

namespace palpate {

TextTable signalTextTable(const TactileFrame& frame, const HandDescription& hand) {
  std::vector<CharacteristicSignals> rows = characteristicSignals(frame);
  rows.push_back(wholeFrameSignals(frame));
  std::vector<std::string> names;
  for (std::size_t m = 0; m + 1 < rows.size(); ++m) names.push_back(hand.matrixName(m));
  names.emplace_back("all");
  const std::size_t numRows = rows.size();
  return {.header = {"matrix",
                     "active",
                     "mean [counts]",
                     "filtered mean [counts]",
                     "max [counts]",
                     "min [counts]",
                     "sum [counts]",
                     "area [mm^2]"},
          .numRows = numRows,
          .row = [rows = std::move(rows), names = std::move(names)](std::size_t row) {
            const CharacteristicSignals& values = rows[row];
            return std::vector<std::string>{names[row],
                                            std::to_string(values.active),
                                            numberText(values.mean),
                                            numberText(values.filteredMean),
                                            numberText(values.maximum),
                                            numberText(values.minimum),
                                            numberText(values.sum),
                                            numberText(values.areaMm2)};
          }};
}

}  // namespace palpate
