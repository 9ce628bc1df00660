#include "palpate/recording/event_store.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <map>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/recording_lock.h"

#include "recording/event_sidecar.h"
#include "recording/format_reader.h"
#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

using EventKey = std::
    tuple<std::int64_t, std::int64_t, std::string, std::optional<int>, std::string, std::string>;
// How often each event stands in a list.
using EventCounts = std::map<EventKey, int>;

EventKey keyOf(const Event& event) {
  return {event.tUs, event.t1Us, event.kind, event.matrix, event.text, event.json};
}

EventCounts countsOf(std::span<const Event> events) {
  EventCounts counts;
  for (const Event& event : events) ++counts[keyOf(event)];
  return counts;
}

EventCounts happened(std::span<const Event> events) {
  EventCounts counts;
  for (const Event& event : events)
    if (!isUserEvent(event)) ++counts[keyOf(event)];
  return counts;
}

void eventStoreRequireStorable(const EventsReport& asRead, std::span<const Event> events) {
  for (const Event& event : events) {
    if (event.kind.empty()) throw std::invalid_argument("event: has no kind");
    if (event.t1Us < event.tUs) throw std::invalid_argument("event: ends before it begins");
    if (event.kind.size() + event.text.size() + event.json.size() > kMaxEventBytes)
      throw std::invalid_argument("event: longer than " + std::to_string(kMaxEventBytes) +
                                  " bytes");
  }
  if (happened(asRead.events) != happened(events))
    throw std::invalid_argument("events: what happened while recording can't be changed");
}

// What stands there now, against what was read. False: it is the new list already (a commit that
// reported a failure may have reached the disk all the same). Throws FileError.
bool needsSaving(const fs::path& path,
                 std::span<const Event> now,
                 const EventsReport& asRead,
                 std::span<const Event> events) {
  const EventCounts there = countsOf(now);
  if (there == countsOf(events)) return false;
  if (there != countsOf(asRead.events))
    throw FileError(path,
                    "its notes have since been changed by someone else; open it again and repeat "
                    "the change, so that theirs aren't lost");
  return true;
}

void requireThere(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw FileError(path, "has since been deleted or moved; its notes can't be saved there");
}

// Throws FileError where a file, or the folder that must take its journal or sidecar, is read-only.
void requireWritableBy(const fs::path& recording, const fs::path& file) {
  constexpr const char* kAdvice = "; save a copy elsewhere and note it there";
  if (::access(file.c_str(), F_OK) == 0 && ::access(file.c_str(), W_OK) != 0)
    throw FileError(recording,
                    "is read-only (" + std::generic_category().message(errno) + ")" + kAdvice);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw FileError(recording,
                    "is in a folder that can't be written (" +
                        std::generic_category().message(errno) + ")" + kAdvice);
}

std::unique_ptr<RecordingLock> locked(const fs::path& recording, const fs::path& file) {
  try {
    return std::make_unique<RecordingLock>(file);
  } catch (const FileError&) {
    if (!RecordingLock::isHeld(file)) throw;
    throw FileError(
        recording,
        "is being recorded, or its notes are being saved by another program; save again "
        "when that is done");
  }
}

// Rows that are in the new list stay as they are; the others go, and what is new gets numbers
// behind all that ever were.
void replaceRows(SqliteDatabase& database, std::span<const Event> events) {
  EventCounts wanted = countsOf(events);
  std::vector<std::int64_t> obsolete;
  forEachEventRow(database, [&](std::int64_t id, Event&& event) {
    const auto found = wanted.find(keyOf(event));
    if (found == wanted.end() || found->second == 0)
      obsolete.push_back(id);
    else
      --found->second;
  });
  std::int64_t id = database.integerOf("SELECT max(id) FROM event");
  if (id > INT64_MAX - static_cast<std::int64_t>(events.size()))
    throw FormatError(database.path(), "has an event with an invalid number");
  SqliteStatement remove = database.prepare("DELETE FROM event WHERE id=?");
  for (const std::int64_t row : obsolete) remove.bind(1, row).run();
  RowWriter rows(database);
  for (const Event& event : events) {
    int& missing = wanted.at(keyOf(event));
    if (missing == 0) continue;
    --missing;
    rows.event(++id, event);
  }
}

// Throws FileError unless it is a finished native recording. Reads only: a journal of an unfinished
// one is not played back.
void requireFinished(const fs::path& path) {
  const PalpateConnection access(path);
  if (access.beingWritten())
    throw FileError(path, "is being recorded; save its notes when it is finished");
  if (access.unfinished())
    throw FileError(path,
                    "was never finished; recover it first ('palpate recover'), and save the notes "
                    "in the recovered recording");
}

}  // namespace

void saveEventRows(const fs::path& given,
                   const EventsReport& asRead,
                   std::span<const Event> events,
                   const SaveEventsOptions& options) {
  std::error_code ignored;
  // Journal and lock lie beside the file itself, not beside a link to it.
  const fs::path path = fs::is_symlink(given, ignored) ? fs::canonical(given, ignored) : given;
  requireWritableBy(path, path);
  requireFinished(path);
  const auto lock = locked(path, path);
  const auto file = fileIdOf(path);
  SqliteDatabase database(path, SqliteDatabase::Mode::kReadWrite, options.vfs);
  const std::uintmax_t size = fs::file_size(path, ignored);
  database.limitWork(ignored ? 0 : size);
  // EXTRA: what was said to be saved stays so when the power goes.
  database.execute("PRAGMA cell_size_check=ON; PRAGMA synchronous=EXTRA");
  try {
    database.execute("BEGIN IMMEDIATE");
    checkTables(database);
    // It may be another file by now.
    if (readMeta(database)["finished"] != "1") throw FileError(path, "has since been replaced");
    const EventsReport now = readEventRows(database);
    if (needsSaving(path, now.events, asRead, events)) {
      replaceRows(database, events);
      database.execute("COMMIT");
    } else {
      database.rollBack();
    }
  } catch (...) {
    database.rollBack();
    throw;
  }
  if (fileIdOf(path) != file)
    throw FileError(path, "was deleted or replaced while its notes were being saved");
}

void saveEventSidecar(const fs::path& path,
                      const EventsReport& asRead,
                      std::span<const Event> events,
                      const SaveEventsOptions&) {
  const fs::path sidecar = sidecarPathOf(path);
  requireWritableBy(path, sidecar);
  const auto lock = locked(path, sidecar);
  const EventsReport now = readEventSidecar(path);
  if (needsSaving(path, now.events, asRead, events)) replaceEventSidecar(path, events);
}

fs::path sidecarPathOf(const fs::path& recording) {
  fs::path path = recording;
  path += ".notes.json";
  return path;
}

bool isUserEvent(const Event& event) {
  constexpr std::array<std::string_view, 8> kNoted{
      "label", "mark", "note", "new_baseline", "recipe", "segment", "sensor_settings", "tare"};
  return std::find(kNoted.begin(), kNoted.end(), event.kind) != kNoted.end();
}

void saveEvents(const fs::path& path,
                const EventsReport& asRead,
                std::span<const Event> events,
                const SaveEventsOptions& options) {
  eventStoreRequireStorable(asRead, events);
  requireThere(path);
  const FormatReader& reader = readerOf(path);
  if (!reader.saveEvents)
    throw FileError(path,
                    std::string("notes can't be added to ") + reader.kind +
                        "; convert it to .palpate and add them there");
  reader.saveEvents(path, asRead, events, options);
}

}  // namespace palpate
