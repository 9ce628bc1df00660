#include "palpate/signals/alignment.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/error.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

// There is no frame beyond this time [s]; the limit keeps microseconds within 64 bits.
constexpr double kAlignmentFurthestS = 1e9;

bool empty(const TimedProfile& side) { return side.profile.numFrames() == 0; }

}  // namespace

std::string_view nameOf(Alignment alignment) {
  switch (alignment) {
    case Alignment::kStart:
      return "start";
    case Alignment::kClock:
      return "clock";
    case Alignment::kManual:
      return "hand";
    case Alignment::kGrasp:
      return "grasp";
    case Alignment::kContact:
      break;
  }
  return "contact";
}

std::optional<Alignment> alignmentFrom(std::string_view name) {
  for (const Alignment each : kAllAlignments)
    if (name == nameOf(each)) return each;
  return std::nullopt;
}

double TimedProfile::timeS(std::size_t frame) const {
  return static_cast<double>(profile.frameTimeUs(frame) - profile.frameTimeUs(0)) / kUsPerS;
}

std::optional<std::size_t> TimedProfile::frameAt(double seconds) const {
  const std::size_t numFrames = profile.numFrames();
  if (numFrames == 0 || !(std::abs(seconds) < kAlignmentFurthestS)) return std::nullopt;
  const std::int64_t timeUs = profile.frameTimeUs(0) + std::llround(seconds * kUsPerS);
  if (timeUs < profile.frameTimeUs(0) || timeUs > profile.frameTimeUs(numFrames - 1))
    return std::nullopt;
  const auto frame = profile.frameAt(timeUs);
  if (!frame || profile.frameTimeUs(*frame) == timeUs) return frame;
  const auto gap = std::lower_bound(
      timing.gaps.begin(), timing.gaps.end(), *frame, [](const Gap& each, std::size_t at) {
        return each.frame < at;
      });
  if (gap != timing.gaps.end() && gap->frame == *frame) return std::nullopt;
  return frame;
}

TimedProfile timedProfile(const Profile& profile,
                          const FirstContactOptions& options,
                          const Progress& progress,
                          UnreadableSamples* unreadable) {
  TimedProfile timed{.profile = profile};
  timed.timing = timingOf(profile);
  std::vector<std::size_t> gapFrames;
  for (const Gap& gap : timed.timing.gaps) gapFrames.push_back(gap.frame);
  timed.contact = firstContact(profile, gapFrames, options, progress, unreadable);
  return timed;
}

std::optional<double> offsetBetween(const TimedProfile& a,
                                    const TimedProfile& b,
                                    Alignment alignment) {
  if (empty(a) || empty(b)) return std::nullopt;
  switch (alignment) {
    case Alignment::kStart:
      return 0.0;
    case Alignment::kClock:
      return static_cast<double>(b.profile.frameTimeUs(0) - a.profile.frameTimeUs(0)) / kUsPerS;
    case Alignment::kContact:
      if (!a.contact || !b.contact) return std::nullopt;
      return a.timeS(*a.contact) - b.timeS(*b.contact);
    case Alignment::kGrasp:
      if (!a.grasp || !b.grasp) return std::nullopt;
      return a.timeS(*a.grasp) - b.timeS(*b.grasp);
    case Alignment::kManual:
      break;
  }
  return std::nullopt;
}

std::optional<TimeSpan> commonSpan(const TimedProfile& a, const TimedProfile& b, double offsetS) {
  if (empty(a) || empty(b)) return std::nullopt;
  const TimeSpan span{std::max(0.0, offsetS),
                      std::min(a.timing.durationS, offsetS + b.timing.durationS)};
  if (span.toS < span.fromS) return std::nullopt;
  return span;
}

std::optional<TimeSpan> graspsInCommon(const TimedProfile& a,
                                       const FrameRange& graspOfA,
                                       const TimedProfile& b,
                                       const FrameRange& graspOfB,
                                       double offsetS) {
  const TimeSpan span{std::max(a.timeS(graspOfA.begin), b.timeS(graspOfB.begin) + offsetS),
                      std::min(a.timeS(graspOfA.end), b.timeS(graspOfB.end) + offsetS)};
  if (span.toS < span.fromS) return std::nullopt;
  return span;
}

TimeSpan wholeSpan(const TimedProfile& a, const TimedProfile& b, double offsetS) {
  if (empty(a) && empty(b)) return {};
  if (empty(b)) return {0.0, a.timing.durationS};
  if (empty(a)) return {offsetS, offsetS + b.timing.durationS};
  return {std::min(0.0, offsetS), std::max(a.timing.durationS, offsetS + b.timing.durationS)};
}

}  // namespace palpate
