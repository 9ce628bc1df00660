#include "palpate/live/signals_stage.h"

namespace palpate {

void SignalsStage::onFrame(LiveResults& results, std::vector<RecordingEvent>&) {
  results.signals = characteristicSignals(*results.frame);
  results.peak = taxelPeak(*results.frame);
}

}  // namespace palpate
