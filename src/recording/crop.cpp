#include "palpate/recording/crop.h"

#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"

namespace palpate {

Profile cropped(const Profile& profile,
                std::size_t begin,
                std::size_t end,
                const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  if (begin > end || end >= profile.numFrames())
    throw std::out_of_range("no frames " + std::to_string(begin) + ".." + std::to_string(end) +
                            ", there are " + std::to_string(profile.numFrames()));
  ProfileBuilder builder(profile.hand());
  TactileFrame frame;
  for (std::size_t i = begin; i <= end; ++i) {
    const double done = static_cast<double>(i - begin) / static_cast<double>(end - begin + 1);
    if (progress && i % kFramesPerReport == 0 && !progress(done)) throw Cancelled();
    profile.readFrame(i, frame);
    builder.addFrame(frame);
  }
  const std::int64_t lastUs = profile.frameTimeUs(end);
  // From the sample that belongs to the first frame: the last one at or before it.
  if (const auto first = profile.angleSampleAt(profile.frameTimeUs(begin)))
    for (std::size_t i = *first; i < profile.numAngles() && profile.angleTimeUs(i) <= lastUs; ++i)
      builder.addAngles(profile.angleTimeUs(i), profile.angles(i).deg);
  if (const auto first = profile.temperatureSampleAt(profile.frameTimeUs(begin)))
    for (std::size_t i = *first;
         i < profile.numTemperatures() && profile.temperatureTimeUs(i) <= lastUs;
         ++i)
      builder.addTemperatures(profile.temperatureTimeUs(i), profile.temperatures(i).degC);
  return builder.finish(profile.info());
}

std::vector<RecordingEvent> eventsWithin(std::span<const RecordingEvent> events,
                                         const Profile& profile) {
  std::vector<RecordingEvent> within;
  if (profile.numFrames() == 0) return within;
  const std::int64_t beginUs = profile.frameTimeUs(0);
  const std::int64_t endUs = profile.frameTimeUs(profile.numFrames() - 1);
  for (const RecordingEvent& event : events)
    if (event.tUs <= endUs && event.t1Us >= beginUs) within.push_back(event);
  return within;
}

}  // namespace palpate
