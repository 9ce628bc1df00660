// Live results of a frame with known content, for the tests of interop.
#pragma once

#include "palpate/calibration/pressure_map.h"
#include "palpate/device/sdh2.h"
#include "palpate/live/live_results.h"
#include "palpate/live/signals_stage.h"
#include "palpate/model/hand_description.h"

namespace palpate::testing {

// Two taxels of finger 0 distal (matrix 1): 100 and 300 counts; the larger one in row 8, column 2.
inline LiveResults sampleResults(std::int64_t hostUs = 1'416'996'123'250'007) {
  TactileFrame frame(sdh2().layout);
  frame.hostUs = hostUs;
  frame.matrix(1)(8, 2) = 300.0F;
  frame.matrix(1)(9, 2) = 100.0F;
  LiveResults results;
  results.frame = std::make_shared<const TactileFrame>(std::move(frame));
  std::vector<Event> events;
  SignalsStage().onFrame(results, events);
  return results;
}

}  // namespace palpate::testing
