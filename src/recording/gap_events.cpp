#include "palpate/recording/gap_events.h"

#include <cmath>
#include <cstdint>

namespace palpate {

bool touchesGap(const Event& event, const Gap& gap, const Profile& profile) {
  const std::int64_t fromUs = profile.frameTimeUs(gap.frame);
  const std::int64_t toUs = fromUs + std::llround(gap.seconds * 1e6);
  return event.tUs <= toUs && event.t1Us >= fromUs;
}

}  // namespace palpate
