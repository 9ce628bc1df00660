// A part of a profile as a profile of its own, and the events that belong to it. Data is never
// changed: a crop is a new profile.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/event.h>
#include <palpate/model/profile.h>

namespace palpate {

// The frames from `begin` to `end`, both inclusive, and the samples of all series within their
// time. Of each series the last sample before the first frame is taken, too, so that every frame
// keeps those that belong to it, and the first one after the last frame, so that a
// value interpolated at a frame stays the same. Throws std::out_of_range (which names the frames
// that there are), Cancelled.
Profile cropped(const Profile& profile,
                std::size_t begin,
                std::size_t end,
                const Progress& progress = {});

// The events that touch the span from the first to the last frame of a profile; what is outside of
// it is cut off.
std::vector<Event> eventsWithin(std::span<const Event> events, const Profile& profile);

}  // namespace palpate
