// What the stages of live processing found in one frame. A stage adds its own part and may read
// those of the stages before it; nothing is taken away.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/capture/capture_queue.h>
#include <palpate/model/hand_state.h>
#include <palpate/signals/characteristic_signals.h>
#include <palpate/slip/slip_detector.h>

namespace palpate {

// The taxel of largest value in a frame; the first of equals in wire order.
struct TaxelPeak {
  std::size_t matrix = 0;
  int row = 0;  // 0 is the fingertip
  int column = 0;
  float counts = 0.0F;  // 0: no taxel is active
};
TaxelPeak taxelPeak(const TactileFrame& frame);

struct PressureFrame;  // calibration/pressure_map.h

struct LiveResults {
  SharedFrame frame;  // never null; filtered where filters are on
  // As it came, where filters are on; else null. Saturation is looked for here.
  SharedFrame unfiltered;
  // The last samples at or before the frame; nothing: none came yet.
  std::optional<JointAngles> angles;
  std::optional<Temperatures> temperatures;
  // Of the signals stage: one per matrix, and of all matrices together.
  std::vector<CharacteristicSignals> matrixSignals;
  CharacteristicSignals wholeSignals;
  TaxelPeak peak;
  // Of the pressure stage, where a calibration is chosen; else null.
  std::shared_ptr<const PressureFrame> pressure;
  // Of the slip stage: one per matrix.
  std::vector<SlipDetection> slip;
};

}  // namespace palpate
