#include "palpate/model/rest_span.h"

#include <cmath>
#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate {

Rest restIn(const Profile& profile, double fromS, double toS, RestOf what) {
  constexpr std::int64_t kToleranceUs = 1'000;  // the ends of a span that was chosen are rounded
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("baseline from " + fixedText(fromS, 3) + " s to " +
                                fixedText(toS, 3) + " s: " + why);
  };
  const double lastsS = static_cast<double>(profile.durationUs()) / kUsPerS;
  if (!(fromS >= 0.0 && toS > fromS)) refuse("that is not a span of a recording");
  if (!(toS <= lastsS + static_cast<double>(kToleranceUs) / kUsPerS))
    refuse("the recording ends after " + fixedText(lastsS, 3) + " s");
  const std::int64_t beginUs = profile.frameTimeUs(0);
  const std::int64_t fromUs = beginUs + std::llround(fromS * kUsPerS) - kToleranceUs;
  const std::int64_t toUs = beginUs + std::llround(toS * kUsPerS) + kToleranceUs;
  const bool ofReadings = what == RestOf::kReadings;
  RestMeter meter(ofReadings ? static_cast<double>(profile.hand().maximumCounts) : 0.0);
  UnreadableSamples unreadable;
  TactileFrame frame;
  for (std::size_t i = profile.frameAt(fromUs).value_or(0);
       i < profile.numFrames() && profile.frameTimeUs(i) <= toUs;
       ++i) {
    if (profile.frameTimeUs(i) < fromUs || !profile.readFrame(i, frame, &unreadable)) continue;
    meter.add(ofReadings ? frame.stored() : frame.allValues());
  }
  if (meter.numFrames() < 2) refuse("fewer than two frames are in it");
  return {meter.baseline(), meter.numFrames()};
}

}  // namespace palpate
