// A native recording as a whole, by one opening: an unfinished one is copied at each. Private to
// this module.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "palpate/core/progress.h"
#include "palpate/model/profile.h"
#include "palpate/recording/recording_event.h"

namespace palpate {

struct PalpateContent {
  Profile profile;
  EventsReport events;
  std::string eventsFault;                  // why the events can't be read; empty: they could
  std::map<std::string, std::string> meta;  // as readRecordingMeta()
};

// Throws as readPalpate(), but not for its events.
PalpateContent readPalpateContent(const std::filesystem::path& path, const Progress& progress);

}  // namespace palpate
