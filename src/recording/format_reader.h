// How the recordings of a format are read: the part of its row that only this module uses.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/progress.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_details.h"
#include "palpate/recording/second_summary.h"

namespace palpate {

// What can be saved of a recording.
struct Salvage {
  std::optional<Recording> recording = {};  // none: nothing can be read
  bool isWhole = false;
  std::string missing = {};  // for a note in what is saved; empty: nothing is missing
  std::string message = {};  // one line: what is saved, or why nothing is
};

struct FormatReader {
  using Path = std::filesystem::path;
  // Whether a file with this ending begins as one of this format.
  bool (*recognises)(std::string_view begin, const std::string& ending);
  Recording (*open)(const Path& path, const ReadOptions& options, const Progress& progress);
  // Reads it through, as far as it can be read. Throws as open() where nothing can be read.
  Recording (*openReadable)(const Path& path, const ReadOptions& options, const Progress& progress);
  VerifyReport (*verify)(const Path& path, std::size_t threads, const Progress& progress);
  // Null: cantRecover says why.
  Salvage (*salvage)(const Path& path,
                     const ReadOptions& options,
                     const Progress& progress) = nullptr;
  const char* cantRecover = nullptr;
  // The events, and what was said of the recording, without its samples. Throw as open().
  EventsReport (*events)(const Path& path);
  RecordingMeta (*meta)(const Path& path);
  // Null: files of this kind ("an HDF5 file") take no events.
  void (*saveEvents)(const Path& path,
                     const EventsReport& asRead,
                     std::span<const Event> events,
                     const SaveEventsOptions& options) = nullptr;
  const char* kind = nullptr;
  // Fills in what a list shows, faster than by opening the recording; null: it is opened.
  void (*addDetails)(RecordingDetails& details) = nullptr;
  // Null: computed of the frames.
  std::vector<SecondSummary> (*seconds)(const Path& path) = nullptr;
  bool eventsBeside = false;  // in a file of their own, whatever state the recording is in
  bool hasTopics = false;
};

// The rows, each in the folder of its format.
extern const RecordingFormat kDsaFormat, kPalpateFormat, kHdf5Format, kMcapFormat;
extern const RecordingFormat kCsvFormat, kNpzFormat, kJsonLinesFormat, kMatFormat;

// The format of a file that is there: by its first bytes; where they are those of no recording
// (damaged), by the ending of its name. Null: another program's file. Throws FileError.
const RecordingFormat* recognisedFormat(const std::filesystem::path& path);
// The same; files of other programs are taken for a .dsa, whose reader says what they are.
const FormatReader& readerOf(const std::filesystem::path& path);

constexpr std::string_view kSqliteStart{"SQLite format 3\0", 16};

// "12 frames, 3 angle samples, 0 temperature samples"; of a profile with further series also
// ", 40 wrist samples".
std::string countsText(std::size_t frames, std::size_t angles, std::size_t temperatures);
std::string countsText(const Profile& profile);
// Opens every block once: the samples of a recording may be read when they are asked for.
void readThrough(const Profile& profile, const Progress& progress);
// A message without the name of its file, which the caller prints in front of it.
std::string withoutName(const std::filesystem::path& path, const std::string& message);
// A sound recording, with what its events lack as its damage.
Recording withEventDamage(Recording recording);
// Of event_store.h, and of the lists of recordings: what each format does there.
void saveEventRows(const std::filesystem::path& path,
                   const EventsReport& asRead,
                   std::span<const Event> events,
                   const SaveEventsOptions& options);
void saveEventSidecar(const std::filesystem::path& path,
                      const EventsReport& asRead,
                      std::span<const Event> events,
                      const SaveEventsOptions& options);
void addPalpateDetails(RecordingDetails& details);
std::vector<SecondSummary> readPalpateSeconds(const std::filesystem::path& path);

}  // namespace palpate
