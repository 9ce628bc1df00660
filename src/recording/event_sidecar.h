// Events as JSON, and the sidecar that keeps them beside a .dsa. Private to this module.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "palpate/core/json.h"
#include "palpate/core/output_file.h"
#include "palpate/model/event.h"

namespace palpate {

Json eventsToJson(std::span<const Event> events);

// The events in the sidecar of a recording; none where there is no sidecar. Throws FileError,
// FormatError.
EventsReport readEventSidecar(const std::filesystem::path& recording);

// Replaces the events in the sidecar, whole or not at all; what was damaged in it stays. The
// sidecar is removed when nothing is left to stand in it. Throws FileError, FormatError.
void replaceEventSidecar(const std::filesystem::path& recording, std::span<const Event> events);

// The sidecar of a recording that is about to be written: it is prepared before the recording and
// published after it.
class EventSidecar {
 public:
  // Throws FileError where a sidecar exists and may not be replaced, or can't be written.
  EventSidecar(const std::filesystem::path& recording,
               std::span<const Event> events,
               Overwrite overwrite);
  // Publishes the sidecar; without events, removes one that belonged to what was replaced.
  void commit() const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<OutputFile> file_;
};

}  // namespace palpate
