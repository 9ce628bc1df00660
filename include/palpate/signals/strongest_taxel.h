// Finds the taxel with the largest total value of a recording; the window shows its signal until
// the user selects another taxel.
#pragma once

#include <cstddef>
#include <optional>

#include <palpate/core/progress.h>
#include <palpate/model/matrix_layout.h>
#include <palpate/model/profile.h>

namespace palpate {

// Returns the enabled taxel with the largest sum of values over at most `maxFrames` frames, spread
// evenly over the recording (the first of equal ones); empty when no taxel is loaded. Throws
// std::invalid_argument when maxFrames is 0, Cancelled, and FormatError when a block of the
// recording is damaged.
std::optional<TaxelPlace> strongestTaxel(const Profile& profile,
                                         std::size_t maxFrames = 4000,
                                         const Progress& progress = {});

}  // namespace palpate
