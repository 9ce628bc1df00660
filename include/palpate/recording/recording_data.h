// A recording as a whole, whatever its format.
#pragma once

#include <cstddef>
#include <exception>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <palpate/model/event.h>
#include <palpate/model/profile.h>
#include <palpate/recording/exported_series.h>

namespace palpate {

// What was said of a recording as a whole when it was made: by the device about itself, by the
// operator about the run. These are the keys and values of the table `meta` of a native recording
// (docs/notes/palpate_format.md), which an .h5 and an .mcap keep: "serial", "firmware", "settings"
// (JSON), "operator", ..; a .dsa has none.
using RecordingMeta = std::map<std::string, std::string>;

// What can't be had of a recording.
struct Damage {
  // One line: what is missing; empty: nothing. Of readableRecording() only; readRecording() throws
  // where samples are missing, and eventsError says why events are.
  std::string text = {};
  std::vector<Event> notInFile = {};  // of the events: what was found to be lost
  std::size_t events = 0;  // that can't be read, or are more than are read (mcap_recording.h)
  std::exception_ptr eventsError = {};  // why no event can be read; null: they were read
  std::string eventsFault() const {     // what() of it; empty: none
    if (!eventsError) return "";
    try {
      std::rethrow_exception(eventsError);
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  // Messages and values of another program's MCAP file that are not used, with their count, one
  // line; empty: none.
  std::string unused = {};
};

struct Recording {
  Profile profile;                 // without what was lost to damage
  std::vector<Event> events = {};  // in order of time
  RecordingMeta meta = {};
  Provenance provenance = {};  // of an .h5 and an .mcap
  Damage damage = {};
  // Throws FileError or FormatError where the events could not be read.
  void requireEvents() const {
    if (damage.eventsError) std::rethrow_exception(damage.eventsError);
  }
};

// What is written of a recording. All of it must outlive the call.
struct RecordingContent {
  const Profile& profile;
  std::span<const Event> events;
  // What the profile says by itself (hand, serial number, ..) is added.
  const RecordingMeta& meta;
  const ExportExtras& extras;  // into an .h5, a .mat and an .mcap; its series are read to their end
};

}  // namespace palpate
