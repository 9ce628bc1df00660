// Something that a device tells of, that happened while recording, or that a person noted
// afterwards.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/number_text.h>

namespace palpate {

// An event at a time or over a span of time.
struct Event {
  std::int64_t tUs = 0;       // [us since 1970]
  std::int64_t t1Us = 0;      // end [us since 1970]; equals tUs for a moment
  std::string kind;           // "gap", "label", "note", "settings", ..
  std::optional<int> matrix;  // in wire order; none where it belongs to no single one
  std::string text;
  std::string json;  // more of it, one JSON object; may be empty
  bool operator==(const Event&) const = default;
};

constexpr std::size_t kMaxEventBytes = 256u << 10;  // of kind, text and json together

// The events of a recording in order of time. What is damaged, or more than is read
// (mcap_recording.h), is left out and counted.
struct EventsReport {
  std::vector<Event> events;
  std::size_t damaged = 0;
};
// "3 events left out: damaged, or more than are read".
inline std::string eventsLeftOutText(std::size_t count) {
  return counted(count, "event") + " left out: damaged, or more than are read";
}

// The events without those of `others`; one that is there twice stays once, when `others` has it
// once.
inline std::vector<Event> withoutEvents(std::vector<Event> events,
                                        const std::vector<Event>& others) {
  for (const Event& other : others)
    if (const auto found = std::find(events.begin(), events.end(), other); found != events.end())
      events.erase(found);
  return events;
}

// The times at which the meaning of counts changed, that is of the events "settings", ascending [us
// since 1970].
inline std::vector<std::int64_t> settingsTimesUs(const std::vector<Event>& events) {
  std::vector<std::int64_t> timesUs;
  for (const Event& event : events)
    if (event.kind == "settings") timesUs.push_back(event.tUs);
  std::sort(timesUs.begin(), timesUs.end());
  return timesUs;
}

}  // namespace palpate
