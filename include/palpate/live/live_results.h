// Results of the live stages for one frame. Each stage adds its own part and may read the parts of
// earlier stages.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/capture/capture_queue.h>
#include <palpate/model/series.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/signals/characteristic_signals.h>
#include <palpate/slip/slip_detector.h>

namespace palpate {

struct PressureFrame;  // calibration/pressure_map.h

// The last sample of a series beside those of the hand.
struct FurtherSample {
  // Never null; it has as many columns as the sample has values.
  std::shared_ptr<const SeriesDescription> series;
  Sample sample;
};

struct LiveResults {
  // Never null; the filtered frame where filters are on.
  SharedFrame frame;
  // The unfiltered frame where filters are on, else null. Saturation must be checked here.
  SharedFrame unfiltered;
  // The last samples at or before the frame; empty before the first one.
  std::optional<Sample> angles;
  std::optional<Sample> temperatures;
  // Likewise of the series beside those of the hand that have one, by their index.
  std::vector<FurtherSample> further;
  // Signals of each matrix and of all matrices together, from SignalsStage.
  std::vector<CharacteristicSignals> matrixSignals;
  CharacteristicSignals wholeSignals;
  TaxelPeak peak;
  // Pressures from PressureStage, if a calibration is chosen; else null.
  std::shared_ptr<const PressureFrame> pressure;
  // Slip of each matrix, from SlipStage.
  std::vector<SlipDetection> slip;
};

}  // namespace palpate
