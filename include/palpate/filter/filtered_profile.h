// A profile filtered by a recipe: it has the same frames at the same times, and filters each frame
// when it is read. Angles, temperatures and stamps are those of the source; values are floats.
// Active taxels are those of the source (filter_chain.h). Commands and the window use it.
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>

namespace palpate {

struct FilteredProfileOptions {
  // Times at which the meaning of counts changes (events "settings") [us since 1970], ascending.
  // Filters over time restart with the first frame at or after each.
  std::vector<std::int64_t> restartsUs = {};
};

// The recipe with the rest of its enabled steps "baseline": the mean of what comes into the step
// between `from` and `to` seconds after the first frame, with its noise. Throws
// std::invalid_argument, as the functions of the filters: fewer than two frames there, or the span
// ends after the recording.
Recipe withRest(const Recipe& recipe,
                const Profile& source,
                const FilteredProfileOptions& options = {},
                const Progress& progress = {});

// Frames that are read in order pass the chain once. A frame that is read out of order is computed
// from all earlier frames that influence it (filter_chain.h, filterLengthFrames()); with recursive
// filters, from enough frames that the others contribute less than 1e-9 of the value. A recipe that
// needs all frames of a stretch at once is applied to the whole profile inside this function.
//
// When a frame of the source cannot be read, reading it here throws the same error, and filters
// over time restart after it. Throws std::invalid_argument (recipe, or a frequency that is not
// below half of the profile's rate, 1 / median interval), Cancelled, and Error (a recipe that needs
// whole stretches meets a frame that cannot be read).
Profile filteredProfile(const Profile& source,
                        const Recipe& recipe,
                        FilteredProfileOptions options = {},
                        const Progress& progress = {});

}  // namespace palpate
