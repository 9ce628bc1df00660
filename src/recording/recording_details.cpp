#include "palpate/recording/recording_details.h"

#include <algorithm>
#include <array>
#include <new>
#include <string_view>
#include <utility>

#include <sys/stat.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

#include "recording/format_reader.h"
#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

using State = RecordingDetails::State;

constexpr std::array<std::pair<State, const char*>, 5> kStateNames{{
    {State::kFinished, "finished"},
    {State::kRecording, "recording"},
    {State::kUnfinished, "unfinished"},
    {State::kDamaged, "damaged"},
    {State::kUnreadable, "unreadable"},
}};

// Bounds of what a list keeps of one recording.
constexpr std::size_t kMaxTextLength = 2000;  // [bytes]
constexpr std::size_t kMostLabels = 200;

std::string bounded(std::string_view text) {
  return std::string(beginningOf(text, kMaxTextLength));
}

void addNote(std::string& notes, std::string_view text) {
  if (text.empty() || notes.size() >= kMaxTextLength) return;
  if (!notes.empty()) notes += '\n';
  notes += beginningOf(text, kMaxTextLength - std::min(kMaxTextLength, notes.size()));
}

void addEvents(RecordingDetails& details, const EventsReport& report) {
  for (const Event& event : report.events) {
    if (event.kind == "note") addNote(details.notes, event.text);
    if ((event.kind != "label" && event.kind != "segment") || event.text.empty()) continue;
    const std::string label = bounded(event.text);
    if (details.labels.size() < kMostLabels &&
        std::find(details.labels.begin(), details.labels.end(), label) == details.labels.end())
      details.labels.push_back(label);
  }
}

// The first and the last block of frames are found without a look at the others: by the index over
// the blocks, or, where an unfinished recording has none, because blocks lie in the order of their
// writing.
void readSpan(RecordingDetails& details, PalpateConnection& access) {
  SqliteDatabase& database = access.database();
  const bool indexed = !access.unfinished() && !access.beingWritten();
  SqliteStatement first = database.prepare(
      indexed ? "SELECT t0_us FROM block WHERE stream=0 ORDER BY first LIMIT 1"
              : "SELECT t0_us FROM block NOT INDEXED WHERE stream=0 ORDER BY id LIMIT 1");
  if (!first.next()) {
    details.numFrames = 0;
    return;
  }
  details.startUs = first.integer(0);
  SqliteStatement last = database.prepare(
      indexed ? "SELECT first, n, t1_us FROM block WHERE stream=0 ORDER BY first DESC LIMIT 1"
              : "SELECT first, n, t1_us FROM block NOT INDEXED WHERE stream=0 ORDER BY id DESC "
                "LIMIT 1");
  if (!last.next()) return;
  constexpr std::int64_t kMost = std::int64_t{1} << 60;
  const auto sensible = [](std::int64_t value) { return value >= 0 && value < kMost; };
  const std::int64_t end = last.integer(2);
  if (!sensible(last.integer(0)) || !sensible(last.integer(1)) || *details.startUs < -kMost ||
      end > kMost || end < *details.startUs)
    throw FormatError(details.path, "its blocks are invalid; try 'palpate recover'");
  details.numFrames = last.integer(0) + last.integer(1);
  details.durationUs = end - *details.startUs;
}

void readSeriesSpans(RecordingDetails& details, PalpateConnection& access) {
  SqliteDatabase& database = access.database();
  for (auto& [index, series] : readSeries(database).sound) {
    if (index < kHandSeries) continue;
    SqliteStatement span =
        database.prepare("SELECT sum(n), min(t0_us), max(t1_us) FROM block WHERE stream=" +
                         std::to_string(static_cast<int>(streamOfSeries(index))));
    SeriesDetails& found = details.series.emplace_back();
    found.name = std::move(series.name);
    found.columns = std::move(series.columns);
    if (!span.next()) continue;
    found.samples = std::max<std::int64_t>(span.integer(0), 0);
    const double us = static_cast<double>(span.integer(2)) - static_cast<double>(span.integer(1));
    if (found.samples > 1 && us > 0.0)
      found.rateHz = static_cast<double>(found.samples - 1) * kUsPerS / us;
  }
}

// Those of an opened recording.
void takeDetails(const Recording& recording, RecordingDetails& details) {
  const auto valueOf = [&](const char* key) {
    const auto found = recording.meta.find(key);
    return found == recording.meta.end() ? std::string() : found->second;
  };
  details.operatorName = bounded(valueOf("operator"));
  details.object = bounded(valueOf("object"));
  details.run = bounded(valueOf("run"));
  addNote(details.notes, valueOf("notes"));
  const Profile& profile = recording.profile;
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    details.series.push_back({profile.series()[i].name,
                              static_cast<std::int64_t>(profile.numSamples(i)),
                              profile.meanSampleRateHz(i),
                              profile.series()[i].columns});
  details.numFrames = static_cast<std::int64_t>(profile.numFrames());
  if (profile.numFrames() == 0) return;
  details.startUs = profile.frameTimeUs(0);
  details.durationUs = profile.durationUs();
}

void fail(RecordingDetails& details, State state, std::string message) {
  details.state = state;
  details.message = std::move(message);
}

// Runs a piece of reading; what goes wrong is said in the details.
template <typename Work>
void attemptRecordingDetails(RecordingDetails& details, Work work) {
  try {
    work();
  } catch (const Cancelled&) {
    throw;
  } catch (const FormatError& error) {
    fail(details, State::kDamaged, error.what());
  } catch (const Error& error) {
    fail(details, State::kUnreadable, error.what());
  } catch (const std::bad_alloc&) {
    fail(details,
         State::kUnreadable,
         details.path.string() + ": too large for this computer's memory");
  }
}

}  // namespace

void addPalpateDetails(RecordingDetails& details) {
  PalpateConnection access(details.path);
  const MetaRows& meta = access.meta();
  details.operatorName = bounded(meta["operator"]);
  details.object = bounded(meta["object"]);
  details.run = bounded(meta["run"]);
  addNote(details.notes, meta["notes"]);
  if (access.beingWritten()) details.state = State::kRecording;
  if (access.unfinished()) {
    details.state = State::kUnfinished;
    details.message = "its writer stopped before the end; it can be recovered";
  }
  addEvents(details, readEventRows(access.database()));
  readSpan(details, access);
  readSeriesSpans(details, access);
}

std::string SeriesDetails::text() const {
  std::string text = name + ": ";
  for (const Column& column : columns)
    text += (&column == &columns.front() ? "" : ", ") + column.name +
            (column.unit.empty() ? "" : " [" + column.unit + "]");
  return escapedLine(text + (rateHz > 0.0 ? ", " + fixedText(rateHz, 1) + " Hz" : ""));
}

const char* nameOf(State state) {
  for (const auto& [known, name] : kStateNames)
    if (known == state) return name;
  return "";
}

std::optional<State> detailsStateFrom(const std::string& name) {
  for (const auto& [state, known] : kStateNames)
    if (name == known) return state;
  return std::nullopt;
}

RecordingDetails readDetails(const fs::path& path, const Progress& progress, std::size_t threads) {
  RecordingDetails details;
  details.path = path;
  struct stat facts {};
  if (::stat(path.c_str(), &facts) == 0) {
    details.sizeBytes = static_cast<std::uintmax_t>(facts.st_size);
    details.changedUs =
        std::int64_t{facts.st_mtim.tv_sec} * 1'000'000 + facts.st_mtim.tv_nsec / 1000;
  }
  const FormatReader* reader = nullptr;
  attemptRecordingDetails(details, [&] {
    const RecordingFormat* format = recognisedFormat(path);
    if (!format) format = &kDsaFormat;
    details.form = format->name;
    reader = format->reader;
    if (reader->addDetails) return reader->addDetails(details);
    const Recording recording = reader->open(path, {.threads = threads}, progress);
    takeDetails(recording, details);
    addEvents(details, {recording.events});
    details.message = recording.damage.eventsFault();
  });
  if (reader && reader->eventsBeside && details.state != State::kFinished)
    attemptRecordingDetails(details, [&] { addEvents(details, reader->events(path)); });
  return details;
}

}  // namespace palpate
