// A part of a profile as a profile of its own: data is never changed, a crop is new.
#pragma once

#include <cstddef>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

// Frames begin..end, both inclusive, and the angles and temperatures within their time; of each of
// these also the last sample before it, so that every frame keeps the angles and temperatures that
// belong to it. Throws std::out_of_range (with the range there is), Cancelled.
Profile cropped(const Profile& profile,
                std::size_t begin,
                std::size_t end,
                const Progress& progress = {});

}  // namespace palpate
