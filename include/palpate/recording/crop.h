// A part of a profile as a profile of its own: data is never changed, a crop is new.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording_event.h>

namespace palpate {

// Frames begin..end, both inclusive, and the angles and temperatures within their time; of each of
// these also the last sample before it, so that every frame keeps the angles and temperatures that
// belong to it. Throws std::out_of_range (with the range there is), Cancelled.
Profile cropped(const Profile& profile,
                std::size_t begin,
                std::size_t end,
                const Progress& progress = {});

// The events that touch the span from the first to the last frame of a profile.
std::vector<RecordingEvent> eventsWithin(std::span<const RecordingEvent> events,
                                         const Profile& profile);

}  // namespace palpate
