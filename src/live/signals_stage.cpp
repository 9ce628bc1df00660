#include "palpate/live/signals_stage.h"

namespace palpate {

void SignalsStage::onFrame(LiveResults& results, std::vector<Event>&) {
  results.matrixSignals = characteristicSignals(*results.frame);
  results.wholeSignals = wholeFrameSignals(*results.frame);
  results.peak = taxelPeak(*results.frame);
}

}  // namespace palpate
