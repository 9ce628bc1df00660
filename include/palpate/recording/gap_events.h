// Which events belong to a gap between two frames: the recorder writes events about what is
// missing.
#pragma once

#include <palpate/model/event.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>

namespace palpate {

// Whether the event, from its begin to its end, touches the gap between two frames of the profile;
// the stamps of both frames belong to the gap.
bool touchesGap(const Event& event, const Gap& gap, const Profile& profile);

}  // namespace palpate
