// Fits gain against sensitivity: K = slope s + offset for one load at several sensitivities
// (study, 3.4, fig. 3.10), for the command `calibrate sensitivity`. The amplifier's gain is
// proportional to s. The offset comes from the threshold: after the amplifier, the threshold minus
// the reading at rest is subtracted from every active taxel, and the mean over the active taxels of
// the filtered matrix reduces its effect.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <palpate/core/json.h>

namespace palpate {

// K of one loading step at one sensitivity.
struct SensitivityPoint {
  double sensitivity = 0.0;           // 0..1
  double staticResponseCounts = 0.0;  // K of the step
  bool used = true;                   // false when the step is not usable
  std::string note = {};
};

// The line K = slope s + offset and its points.
struct SensitivityCurve {
  std::vector<SensitivityPoint> points;
  double slope = 0.0;   // [counts at sensitivity 1]
  double offset = 0.0;  // [counts]
  double r2 = 0.0;      // share of the variance that the line explains, 0..1
  double slopeSd = 0.0, offsetSd = 0.0;
  // Sensitivity at which K = 0; below it, the threshold suppresses this load.
  double zeroSensitivity = 0.0;
  bool valid = false;
  std::vector<std::string> notes;
};

// Fits the line. `thresholdCounts` is the setting during the recording, for the notes; 0 when not
// known.
SensitivityCurve fitSensitivityCurve(std::span<const SensitivityPoint> points,
                                     double thresholdCounts = 0.0);

// JSON: points[{sensitivity,K}], slope, offset, r2, and more.
Json jsonOf(const SensitivityCurve& curve);

}  // namespace palpate
