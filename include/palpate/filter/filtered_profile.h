// A profile seen through a recipe: the same frames at the same times, filtered when they are asked
// for. Angles, temperatures and stamps are those of the source; values are floats. Active is what
// was active in the source (filter_chain.h).
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>

namespace palpate {

struct FilteredProfileOptions {
  // Moments at which counts begin to mean something else (events "settings") [us since 1970],
  // ascending: filters over time restart with the first frame at or after one.
  std::vector<std::int64_t> restartsUs = {};
};

// Frames read in order go through the chain once. A frame out of order is computed from as many
// frames before it as have a say in it (filter_chain.h, filterLengthFrames()); of recursive filters
// from so many that what is left out is below 1e-9 of the value. A recipe that needs all frames of
// a stretch at once is computed here, as a whole.
//
// A frame of the source that can't be read throws when it is asked for, as it does there; filters
// over time restart after it. Throws std::invalid_argument (recipe), Cancelled, Error (such a
// recipe and a frame that can't be read).
Profile filteredProfile(const Profile& source,
                        const Recipe& recipe,
                        FilteredProfileOptions options = {},
                        const Progress& progress = {});

}  // namespace palpate
