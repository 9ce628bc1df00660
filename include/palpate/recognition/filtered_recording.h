// A recording seen through filters.
#pragma once

#include <filesystem>
#include <stdexcept>

#include <palpate/core/error.h>
#include <palpate/filter/filtered_profile.h>
#include <palpate/recording/recording.h>

namespace palpate {

// The filtered recording; the recording itself when the recipe is empty. Events "settings" restart
// the filters over time. Throws Error (a matrix that the recording does not have; an unreadable
// file) and Cancelled.
inline Profile filteredBy(const Recipe& recipe,
                          const Recording& recording,
                          const std::filesystem::path& file,
                          const Progress& progress = {}) {
  if (recipe.empty()) return recording.profile;
  recording.requireEvents();
  try {
    return filteredProfile(
        recording.profile, recipe, {settingsTimesUs(recording.events)}, progress);
  } catch (const std::invalid_argument& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace palpate
