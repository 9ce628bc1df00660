// Something that happened while recording, or that a person noted afterwards.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpate {

// At a time or over a span.
struct RecordingEvent {
  std::int64_t tUs = 0;   // [us since 1970]
  std::int64_t t1Us = 0;  // end; equals tUs for a moment
  std::string kind;       // "gap", "label", "note", "settings", ..
  std::optional<int> matrix;
  std::string text;
  std::string json;  // more of it, one JSON object; may be empty
  bool operator==(const RecordingEvent&) const = default;
};

constexpr std::size_t kMaxEventBytes = 256u << 10;  // of kind, text and json together

// The events of a recording in order of time. What is damaged is left out and counted.
struct EventsReport {
  std::vector<RecordingEvent> events;
  std::size_t damaged = 0;
};

// When the meaning of counts changed: events "settings", ascending [us since 1970].
inline std::vector<std::int64_t> settingsTimesUs(const std::vector<RecordingEvent>& events) {
  std::vector<std::int64_t> timesUs;
  for (const RecordingEvent& event : events)
    if (event.kind == "settings") timesUs.push_back(event.tUs);
  std::sort(timesUs.begin(), timesUs.end());
  return timesUs;
}

}  // namespace palpate
