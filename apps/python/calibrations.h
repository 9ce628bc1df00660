// How Python functions that take a Calibration compute forces.
#pragma once

#include <optional>

#include "palpate/calibration/pressure_map.h"
#include "palpate/calibration/tare.h"
#include "palpate/core/progress.h"
#include "palpate/model/profile.h"

namespace palpate::python {

// Arguments of Calibration.apply() and derive(). Without sensitivity (0..1) or threshold [counts]
// those of the calibration are assumed.
struct ForceChoice {
  std::optional<double> sensitivity, threshold;
  bool tare = false, drift = true;
};
PressureMapOptions pressureOptionsOf(const ForceChoice& choice,
                                     const Calibration& calibration,
                                     const Profile& profile);
// What the unloaded taxels read, if it is to be subtracted. Throws Error, Cancelled.
std::optional<Tare> tareOf(const ForceChoice& choice,
                           const Profile& profile,
                           const Progress& progress);

}  // namespace palpate::python
