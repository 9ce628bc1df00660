// Stores what a person has noted in a recording that lies on disk: labels, notes, marks, corrected
// segments. Samples are never touched, and what happened (gaps, settings, grasps, motions) never
// changes.
//
// A .palpate file stores its events in one transaction, a .dsa in its sidecar file
// NAME.dsa.notes.json, which is replaced atomically: a process that is killed leaves either the old
// or the new events. Profiles of the recording that are open in any program can still be read.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <palpate/model/event.h>

namespace palpate {

// The sidecar of a .dsa: NAME.dsa.notes.json beside NAME.dsa.
std::filesystem::path sidecarPathOf(const std::filesystem::path& recording);

// Whether a person may add, change and remove an event: kinds "label" and "mark" (as the recorder
// writes them), "note", "recipe" (filters to look through, JSON: filter/recipe.h), "segment" (a
// grasp or another part, as a person sees it), "sensor_settings" (what a person says that the
// sensor was set to: calibration/force_series.h), "tare" (zeros to be taken off:
// calibration/tare.h), and "new_baseline" (readings at rest: model/touch.h).
bool isUserEvent(const Event& event);

struct SaveEventsOptions {
  std::string vfs;  // SQLite file system to write with; empty: the default one
};

// Replaces the events of a recording. `asRead` is what readEvents() gave, `events` the whole new
// list in any order. Damaged events of the file stay as they are. Nothing is written when the file
// has the new list already.
//
// Throws std::invalid_argument when `events` lacks or changes what happened, or one of them is
// empty of kind, ends before it begins, or is longer than kMaxEventBytes. Throws FileError, and
// changes nothing: read-only file or folder, disk full, being recorded, unfinished (recover it
// first), gone, or its events are no longer `asRead`: another program has changed them. Throws
// FormatError (damaged).
void saveEvents(const std::filesystem::path& path,
                const EventsReport& asRead,
                std::span<const Event> events,
                const SaveEventsOptions& options = {});

}  // namespace palpate
