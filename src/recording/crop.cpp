#include "palpate/recording/crop.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/first_where.h"
#include "palpate/model/profile_builder.h"

namespace palpate {
namespace {

// The samples from the last one at or before `beginUs` to the last one at `endUs`, or, without one
// at this time, to the first one after it: the first of them, and the one behind the last.
template <typename TimeUs>
std::pair<std::size_t, std::size_t> samplesAround(std::size_t count,
                                                  std::int64_t beginUs,
                                                  std::int64_t endUs,
                                                  const TimeUs& timeUs) {
  const std::size_t first = firstWhere(count, [&](std::size_t i) { return timeUs(i) > beginUs; });
  const std::size_t end = firstWhere(count, [&](std::size_t i) { return timeUs(i) > endUs; });
  const bool exact = end > 0 && timeUs(end - 1) == endUs;
  return {first > 0 ? first - 1 : 0, std::min(count, exact ? end : end + 1)};
}

}  // namespace

Profile cropped(const Profile& profile,
                std::size_t begin,
                std::size_t end,
                const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  if (begin > end || end >= profile.numFrames())
    throw std::out_of_range("no frames " + std::to_string(begin) + ".." + std::to_string(end) +
                            ", there are " + std::to_string(profile.numFrames()));
  ProfileBuilder builder(profile.hand());
  builder.setBaselines(profile.baselines());
  TactileFrame frame;
  for (std::size_t i = begin; i <= end; ++i) {
    const double done = static_cast<double>(i - begin) / static_cast<double>(end - begin + 1);
    if (progress && i % kFramesPerReport == 0 && !progress(done)) throw Cancelled();
    profile.readFrame(i, frame);
    builder.addFrame(frame);
  }
  const std::int64_t beginUs = profile.frameTimeUs(begin), endUs = profile.frameTimeUs(end);
  for (std::size_t series = 0; series < profile.series().size(); ++series) {
    // They belong to what is seen, not to what was recorded.
    if (profile.series()[series].role == kComputedRole) continue;
    const std::size_t made =
        series < kHandSeries ? series : builder.addSeries(profile.series()[series]);
    const auto [first, behind] =
        samplesAround(profile.numSamples(series), beginUs, endUs, [&](std::size_t i) {
          return profile.sampleTimeUs(series, i);
        });
    for (std::size_t i = first; i < behind; ++i) {
      Sample sample = profile.sample(series, i);
      sample.series = made;
      builder.addSample(sample);
    }
  }
  return builder.finish(profile.info());
}

std::vector<Event> eventsWithin(std::span<const Event> events, const Profile& profile) {
  std::vector<Event> within;
  if (profile.numFrames() == 0) return within;
  const std::int64_t beginUs = profile.frameTimeUs(0);
  const std::int64_t endUs = profile.frameTimeUs(profile.numFrames() - 1);
  // The baselines that hold at the begin: the first one also before its time.
  for (const char* kind : {kBaselineKind, kNewBaselineKind}) {
    const Event* baseline = nullptr;
    for (const Event& event : events)
      if (event.kind == kind && (event.tUs < beginUs || (!baseline && event.tUs > endUs)))
        baseline = &event;
      else if (event.kind == kind && !baseline)
        break;  // it is within
    if (!baseline) continue;
    within.push_back(*baseline);
    within.back().tUs = within.back().t1Us = beginUs;
  }
  for (const Event& event : events) {
    if (event.tUs > endUs || event.t1Us < beginUs) continue;
    within.push_back(event);
    within.back().tUs = std::max(event.tUs, beginUs);
    within.back().t1Us = std::min(event.t1Us, endUs);
  }
  return within;
}

}  // namespace palpate
