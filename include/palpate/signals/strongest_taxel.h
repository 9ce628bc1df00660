// Finds the taxel with the largest total value of a recording, which is displayed until the user
// selects another one.
#pragma once

#include <cstddef>
#include <optional>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/taxel_place.h>

namespace palpate {

// The enabled taxel with the largest sum of values over at most `maxFrames` frames, spread evenly
// (the first of equals); nothing where none feels anything. Throws std::invalid_argument for no
// frames to look at, Cancelled, FormatError where a block is damaged.
std::optional<TaxelPlace> strongestTaxel(const Profile& profile,
                                         std::size_t maxFrames = 4000,
                                         const Progress& progress = {});

}  // namespace palpate
