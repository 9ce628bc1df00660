// Puts two recordings, A and B, on one time axis for their comparison: seconds from A's first
// frame. B's first frame is `offsetS` after A's, so that time t in A is t - offsetS in B.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/timing.h>
#include <palpate/signals/first_contact.h>

namespace palpate {

// How the two recordings are aligned.
enum class Alignment {
  kContact,  // the first lasting contacts coincide
  kStart,    // the first frames coincide
  kClock,    // the recordings keep their host times
  kGrasp,    // the first frames of two chosen grasps coincide
  kManual    // the user chose the offset
};
inline constexpr std::array kAllAlignments = {Alignment::kContact,
                                              Alignment::kStart,
                                              Alignment::kClock,
                                              Alignment::kGrasp,
                                              Alignment::kManual};
// Name in settings and on the command line: "contact", "start", "clock", "grasp", "hand".
std::string_view nameOf(Alignment alignment);
std::optional<Alignment> alignmentFrom(std::string_view name);

// A recording with what its alignment needs.
struct TimedProfile {
  Profile profile;
  TimingReport timing = {};
  // First frame of the first lasting contact.
  std::optional<std::size_t> contact = {};
  // First frame of the chosen grasp, for Alignment::kGrasp. timedProfile() doesn't look for grasps.
  std::optional<std::size_t> grasp = {};

  // Time of a frame from the first one [s]. Throws std::out_of_range.
  double timeS(std::size_t frame) const;
  // Index of the last frame at or before a time; empty before the first frame, after the last one,
  // and inside a gap.
  std::optional<std::size_t> frameAt(double seconds) const;
};
// Reads all time stamps, and frames until the first contact. Throws as firstContact().
TimedProfile timedProfile(const Profile& profile,
                          const FirstContactOptions& options = {},
                          const Progress& progress = {},
                          UnreadableSamples* unreadable = nullptr);

// Offset of B's first frame [s]. Empty for an empty profile, without a contact (kContact) or a
// chosen grasp (kGrasp) in one of the two, and for kManual. Throws std::out_of_range for a frame
// that one of the two doesn't have.
std::optional<double> offsetBetween(const TimedProfile& a,
                                    const TimedProfile& b,
                                    Alignment alignment);

// The span from the later start to the earlier end; empty when the recordings do not overlap or one
// has no frame.
std::optional<TimeSpan> commonSpan(const TimedProfile& a, const TimedProfile& b, double offsetS);
// The span, on A's axis, in which a grasp of A and one of B both last, each from its first to its
// last frame. Empty when they have no moment in common. Throws std::out_of_range.
struct FrameRange {
  std::size_t begin = 0;
  std::size_t end = 0;  // inclusive
};
std::optional<TimeSpan> graspsInCommon(const TimedProfile& a,
                                       const FrameRange& graspOfA,
                                       const TimedProfile& b,
                                       const FrameRange& graspOfB,
                                       double offsetS);
// The span from the earlier start to the later end; {0, 0} when neither has a frame.
TimeSpan wholeSpan(const TimedProfile& a, const TimedProfile& b, double offsetS);

}  // namespace palpate
