// A recording seen over the clocks of its senders and through filters.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <palpate/core/error.h>
#include <palpate/filter/filtered_profile.h>
#include <palpate/model/fitted_times.h>
#include <palpate/recording/recording.h>

namespace palpate {

// The profile at the chosen times. `said` is set to what is known of each clock. Throws Error where
// the frames have no times of a sender to fit; with `said` only where no series has any, either.
inline Profile atTimes(TimeChoice times,
                       const Profile& profile,
                       const std::filesystem::path& file,
                       const Progress& progress = {},
                       std::string* said = nullptr) {
  if (times == TimeChoice::kArrival) return profile;
  FittedTimes fitted = fittedTimes(profile, progress);
  bool isFitted = false;
  std::string text;
  for (const FittedClock& clock : fitted.clocks) {
    isFitted = isFitted || (clock.base && (said || &clock == &fitted.clocks.front()));
    text += (text.empty() ? "" : "; ") + clock.text();
  }
  if (!isFitted)
    throw Error(file.string() + ": times can't be fitted: " + fitted.clocks.front().why +
                "; take the times of arrival");
  if (said) *said = text;
  return fitted.profile;
}

// The same of a recording that is saved afterwards: a note from its first frame to its last one
// tells of it, so that each part that is cut out keeps the note. Returns what is known of each
// clock.
inline std::string takeFittedTimes(Recording& recording,
                                   const std::filesystem::path& file,
                                   const Progress& progress = {}) {
  std::string said;
  recording.profile = atTimes(TimeChoice::kFitted, recording.profile, file, progress, &said);
  const std::size_t count = recording.profile.numFrames();
  const std::int64_t us = count > 0 ? recording.profile.frameTimeUs(0) : 0;
  const std::int64_t endUs = count > 0 ? recording.profile.frameTimeUs(count - 1) : us;
  const auto after = std::find_if(recording.events.begin(),
                                  recording.events.end(),
                                  [&](const Event& event) { return event.tUs > us; });
  recording.events.insert(
      after, {us, endUs, "note", {}, "times fitted to the sender's clock: " + said, ""});
  return said;
}

// The filtered recording at the chosen times; the recording itself when the recipe is empty. Events
// "settings" restart the filters over time. Throws Error (a matrix that the recording does not
// have; an unreadable file; as atTimes()) and Cancelled.
inline Profile filteredBy(const Recipe& recipe,
                          const Recording& recording,
                          const std::filesystem::path& file,
                          const Progress& progress = {},
                          TimeChoice times = TimeChoice::kArrival) {
  const Profile profile = atTimes(times, recording.profile, file, progress);
  if (recipe.empty()) return profile;
  recording.requireEvents();
  try {
    return filteredProfile(profile, recipe, {settingsTimesUs(recording.events)}, progress);
  } catch (const std::invalid_argument& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace palpate
