#include "recording/event_sidecar.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/text_file.h"
#include "palpate/recording/event_store.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kEventNotesFormat = "palpate notes";
constexpr std::int64_t kEventNotesVersion = 1;
constexpr std::uintmax_t kLargestSidecar = 32u << 20;

Event eventFrom(const Json& json) {
  Event event;
  event.tUs = json.at("t_us").asInteger();
  event.t1Us = json.at("t1_us").asInteger();
  event.kind = json.at("kind").asString();
  if (!json.at("matrix").isNull()) {
    const std::int64_t matrix = json.at("matrix").asInteger();
    if (matrix < INT32_MIN || matrix > INT32_MAX) throw Error("matrix is out of range");
    event.matrix = static_cast<int>(matrix);
  }
  event.text = json.at("text").asString();
  event.json = json.at("json").asString();
  if (event.kind.size() + event.text.size() + event.json.size() > kMaxEventBytes)
    throw Error("an event is too long");
  return event;
}

// Calls back with each item of the list of events in the sidecar of a recording, if it has one.
void forEachNote(const fs::path& recording, const std::function<void(const Json&)>& take) {
  const fs::path path = sidecarPathOf(recording);
  std::error_code failure;
  if (!fs::exists(path, failure)) return;
  const std::string text = readTextFile(path, kLargestSidecar);
  try {
    const Json json = Json::parse(text);
    if (!json.isObject() || json.at("format").asString() != kEventNotesFormat)
      throw Error("isn't a file of notes");
    if (json.at("version").asInteger() != kEventNotesVersion)
      throw Error("has version " + std::to_string(json.at("version").asInteger()) +
                  " of the format; this program reads version " +
                  std::to_string(kEventNotesVersion));
    const Json events = json.at("events");
    if (!events.isArray()) throw Error("has no list of events");
    for (std::size_t i = 0; i < events.size(); ++i) take(events.at(i));
  } catch (const Error& error) {
    throw FormatError(path, error.what());
  }
}

std::string sidecarText(Json events) {
  return Json::object()
             .set("format", kEventNotesFormat)
             .set("version", kEventNotesVersion)
             .set("events", std::move(events))
             .text() +
         "\n";
}

void removeSidecar(const fs::path& path) {
  std::error_code failure;
  fs::remove(path, failure);
  if (failure) throw FileError(path, "can't be removed: " + failure.message());
}

}  // namespace

Json eventsToJson(std::span<const Event> events) {
  return jsonList(events, [](const Event& event) {
    return Json::object()
        .set("t_us", event.tUs)
        .set("t1_us", event.t1Us)
        .set("kind", event.kind)
        .set("matrix", event.matrix ? Json(*event.matrix) : Json())
        .set("text", event.text)
        .set("json", event.json);
  });
}

EventsReport readEventSidecar(const fs::path& recording) {
  EventsReport report;
  forEachNote(recording, [&report](const Json& json) {
    try {
      report.events.push_back(eventFrom(json));
    } catch (const Error&) {
      ++report.damaged;
    }
  });
  std::stable_sort(report.events.begin(), report.events.end(), [](const auto& a, const auto& b) {
    return a.tUs < b.tUs;
  });
  return report;
}

void replaceEventSidecar(const fs::path& recording, std::span<const Event> events) {
  Json list = eventsToJson(events);
  forEachNote(recording, [&list](const Json& json) {
    try {
      eventFrom(json);
    } catch (const Error&) {
      list.push(json);
    }
  });
  const fs::path path = sidecarPathOf(recording);
  if (list.size() == 0) return removeSidecar(path);
  OutputFile file(path, Overwrite::kReplace);
  file.write(sidecarText(std::move(list)));
  file.commit();
}

EventSidecar::EventSidecar(const fs::path& recording,
                           std::span<const Event> events,
                           Overwrite overwrite)
    : path_(sidecarPathOf(recording)) {
  requireWritable(recording, overwrite);
  requireWritable(path_, overwrite);
  if (events.empty()) return;
  file_ = std::make_unique<OutputFile>(path_, overwrite);
  file_->write(sidecarText(eventsToJson(events)));
}

void EventSidecar::commit() const {
  if (file_) return file_->commit();
  removeSidecar(path_);
}

}  // namespace palpate
