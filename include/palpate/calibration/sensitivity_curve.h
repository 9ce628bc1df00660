// Gain against sensitivity: K = slope s + offset for one load at several sensitivities (study, 3.4,
// fig. 3.10). The amplifier's gain is proportional to s; the offset is the threshold's: it is taken
// off every active taxel after the amplifier, less what the taxel reads at rest, and the mean over
// the active taxels of the filtered matrix dilutes it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <palpate/core/json.h>

namespace palpate {

struct SensitivityPoint {
  double sensitivity = 0.0;           // 0..1
  double staticResponseCounts = 0.0;  // K of the step
  bool used = true;                   // false: the step isn't sound
  std::string note = {};
};

struct SensitivityCurve {
  std::vector<SensitivityPoint> points;
  double slope = 0.0;   // [counts at sensitivity 1]
  double offset = 0.0;  // [counts]
  double r2 = 0.0;      // share of the variance that the line explains
  double slopeSd = 0.0, offsetSd = 0.0;
  double zeroSensitivity = 0.0;  // where K = 0: below, the threshold swallows this load
  bool valid = false;
  std::vector<std::string> notes;
};

// thresholdCounts: setting while it was recorded, for the explanation; 0: not known.
SensitivityCurve fitSensitivityCurve(std::span<const SensitivityPoint> points,
                                     double thresholdCounts = 0.0);

// JSON: points[{sensitivity,K}], slope, offset, r2, and more.
Json jsonOf(const SensitivityCurve& curve);

}  // namespace palpate
