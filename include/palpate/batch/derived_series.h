// What is computed of the frames of a recording, as series of rows that an export writes beside the
// frames: the characteristic signals of every matrix, and the slip of its contact.
//
// Series "signals": per matrix N `mN/mean`, `mN/filtered_mean`, `mN/max`, `mN/min`, `mN/sum` [unit
// of the hand's taxels], `mN/active` [taxels], `mN/area_mm2` [mm^2]; the same of all matrices
// together as `whole/..`. With readings also `mN/x`, `mN/y`, `mN/z`, `mN/norm`. The values are
// those of `palpate signals`.
//
// Series "slip": per matrix N `mN/active` [taxels], `mN/dx`, `mN/dy`, `mN/ref_dx`, `mN/ref_dy`
// [taxels], `mN/rotation_deg`, `mN/ref_rotation_deg` [deg], `mN/confidence`, `mN/p_moved` (0..1),
// `mN/state` (the number of the SlipState, 0 invalid .. 5 slip) and `mN/slipping` (0 or 1). What is
// not known, and everything but `active` and `slipping` of a matrix that is not touched, is NaN.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/recording/exported_series.h>
#include <palpate/slip/slip_detector.h>

namespace palpate {

struct DerivedSeriesOptions {
  bool withSignals = true;
  bool withSlip = true;
  // As the views of the window have it: the method `contest`, the reference is taken when the
  // contact is at rest.
  SlipDetectorOptions detector = {};
  std::size_t threads = 0;  // of slip, as SlipRunOptions::threads
};

// Returns the chosen series over all frames of the profile, signals first. Each reads the frames by
// itself, in order and once, and keeps none of them; two series may be read by two threads. Throws
// std::invalid_argument (options).
std::vector<std::unique_ptr<ExportedSeries>> derivedSeries(
    const Profile& profile, const DerivedSeriesOptions& options = {});

}  // namespace palpate
