#include "palpate/recording/recording_details.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
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
constexpr std::size_t kMaxLabels = 200;

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
    if (details.labels.size() < kMaxLabels &&
        std::find(details.labels.begin(), details.labels.end(), label) == details.labels.end())
      details.labels.push_back(label);
  }
}

struct StreamSpan {
  std::int64_t items = 0;
  std::int64_t startUs = 0;  // host time of the first item, since 1970
  std::int64_t endUs = 0;    // of the last item
};

// Of a stream with items. Its first and last block are found without a look at the others: by the
// index over the blocks, or, where an unfinished recording has none, because blocks lie in the
// order of their writing. Throws FormatError.
std::optional<StreamSpan> spanOf(Stream stream, const fs::path& path, PalpateConnection& access) {
  SqliteDatabase& database = access.database();
  const bool indexed = !access.unfinished() && !access.beingWritten();
  const auto at = [&](const char* end) {
    return database.prepare(std::string("SELECT first, n, t0_us, t1_us FROM block ") +
                            (indexed ? "" : "NOT INDEXED ") +
                            "WHERE stream=" + std::to_string(static_cast<int>(stream)) +
                            " ORDER BY " + (indexed ? "first" : "id") + end + " LIMIT 1");
  };
  SqliteStatement first = at("");
  if (!first.next()) return std::nullopt;
  const std::int64_t startUs = first.integer(2);
  SqliteStatement last = at(" DESC");
  if (!last.next()) return std::nullopt;
  constexpr std::int64_t kMaximum = std::int64_t{1} << 60;
  const auto sensible = [](std::int64_t value) { return value >= 0 && value < kMaximum; };
  const std::int64_t endUs = last.integer(3);
  if (!sensible(last.integer(0)) || !sensible(last.integer(1)) || startUs < -kMaximum ||
      endUs > kMaximum || endUs < startUs)
    throw FormatError(path, "its blocks are invalid; try 'palpate recover'");
  return StreamSpan{last.integer(0) + last.integer(1), startUs, endUs};
}

void readSpans(RecordingDetails& details, PalpateConnection& access) {
  const auto frames = spanOf(Stream::kTactile, details.path, access);
  details.numFrames = frames ? frames->items : 0;
  if (frames) {
    details.startUs = frames->startUs;
    details.durationUs = frames->endUs - frames->startUs;
  }
  for (auto& [index, series] : readSeries(access.database()).sound) {
    if (index < kHandSeries) continue;
    SeriesDetails& found = details.series.emplace_back();
    found.name = std::move(series.name);
    found.columns = std::move(series.columns);
    const auto samples = spanOf(streamOfSeries(index), details.path, access);
    if (!samples) continue;
    found.samples = samples->items;
    if (samples->items > 1 && samples->endUs > samples->startUs)
      found.rateHz = static_cast<double>(samples->items - 1) * kUsPerS /
                     static_cast<double>(samples->endUs - samples->startUs);
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
  readSpans(details, access);
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
