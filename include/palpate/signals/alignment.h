// Two recordings, A and B, on one axis of time: seconds from A's first frame. B's first frame lies
// `offsetS` after A's, so what is at t in A is at t - offsetS in B.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/time_span.h>
#include <palpate/model/timing.h>
#include <palpate/signals/first_contact.h>

namespace palpate {

enum class Alignment {
  kContact,  // first lasting contacts on top of each other
  kStart,    // first frames on top of each other
  kClock,    // as they were, by host time
  kManual    // whatever offset somebody chose
};
inline constexpr std::array kAllAlignments = {
    Alignment::kContact, Alignment::kStart, Alignment::kClock, Alignment::kManual};
// "contact", "start", "clock", "hand": the word in settings and on the command line.
std::string_view nameOf(Alignment alignment);
std::optional<Alignment> alignmentFrom(std::string_view name);

// What has to be known of a recording to lay it beside another.
struct TimedProfile {
  Profile profile;
  TimingReport timing = {};
  std::optional<std::size_t> contact = {};  // first frame of the first lasting contact

  double timeS(std::size_t frame) const;  // from the first frame [s]; throws std::out_of_range
  // The last frame at or before; nothing before the first, after the last, inside a gap.
  std::optional<std::size_t> frameAt(double seconds) const;
};
// Reads stamps, and frames until the first contact. Throws Cancelled.
TimedProfile timedProfile(const Profile& profile,
                          const FirstContactOptions& options = {},
                          const Progress& progress = {});

// Where B's first frame lies [s]. Nothing: an empty profile, no contact in one of the two, kManual.
std::optional<double> offsetBetween(const TimedProfile& a,
                                    const TimedProfile& b,
                                    Alignment alignment);

// From the later begin to the earlier end; nothing when they don't meet, or one has no frame.
std::optional<TimeSpan> commonSpan(const TimedProfile& a, const TimedProfile& b, double offsetS);
// From the earlier begin to the later end; {0, 0} when neither has a frame.
TimeSpan wholeSpan(const TimedProfile& a, const TimedProfile& b, double offsetS);

}  // namespace palpate
