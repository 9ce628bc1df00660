// Live stage that computes the characteristic signals of every matrix and the largest taxel of all.
#pragma once

#include <palpate/live/stage.h>

namespace palpate {

// Fills LiveResults::matrixSignals, wholeSignals and peak.
class SignalsStage final : public Stage {
 public:
  void onFrame(LiveResults& results, std::vector<Event>& out) override;
};

}  // namespace palpate
