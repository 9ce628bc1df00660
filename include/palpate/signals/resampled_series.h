// The values of a series at the times of another one, so that signals with different stamps (taxels
// and joint angles) can be compared, combined, and plotted over each other.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include <palpate/signals/profile_series.h>

namespace palpate {

// Interpolates `series` linearly at `timeS` (ascending) [s]. NaN before the first and after the
// last finite sample, and between samples that are more than `longestS` apart (a gap). Samples that
// are not finite are left out. Throws std::invalid_argument when the times of the series don't
// ascend or the numbers of times and values differ.
std::vector<double> resampled(const Series& series,
                              std::span<const double> timeS,
                              double longestS = std::numeric_limits<double>::infinity());

// The value of the last sample at or before each time; NaN before the first one, and where that
// sample's value is NaN. Throws as above.
std::vector<double> heldAt(const Series& series, std::span<const double> timeS);

}  // namespace palpate
