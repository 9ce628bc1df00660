// The formats of recordings: a row for each. Nothing else in the program asks which format a file
// has; how to add one: docs/architecture.md.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/recording/mcap_recording.h>
#include <palpate/recording/recording_data.h>

namespace palpate {

// What is saved beside a profile and its events, in the formats that have a place for it.
struct SaveExtras {
  RecordingMeta meta = {};     // into a .palpate, an .h5, a .mat and an .mcap
  ExportExtras exported = {};  // as RecordingContent::extras
  McapWriteOptions mcap = {};  // of an .mcap
  bool unitsRow = false;       // of a .csv: see writeCsv()
};
// What a saved recording could not hold as it was.
struct SaveReport {
  std::size_t movedStamps = 0;                     // of a .dsa: see DsaWriteReport
  std::vector<std::filesystem::path> beside = {};  // of a .csv: the files of further series
};

// All that is needed to save a recording.
struct SaveJob {
  RecordingContent content;
  const std::filesystem::path& path;
  Overwrite overwrite;
  const Progress& progress;
  const SaveExtras& extras;
};

struct FormatReader;  // private: recording/format_reader.h

struct RecordingFormat {
  const char* name;                      // as in ProfileInfo::format: "palpate"
  const char* purpose;                   // for lists: "Palpate recording"
  std::span<const char* const> endings;  // with the dot: ".palpate"
  // Made for other programs: filtered if asked for, and none that filters are applied to again.
  bool isExport = false;
  bool takesSeries = false;              // ExportExtras
  bool holdsFurther = false;             // series beside those of the hand
  bool holdsReadings = false;            // TactileFrame::readings; others hold what presses
  bool takesUnitsRow = false;            // SaveExtras::unitsRow
  bool takesMcap = false;                // SaveExtras::mcap
  const FormatReader* reader = nullptr;  // null: such files are written, not read
  bool hasEnding(std::string_view ending) const noexcept {
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
  }
  // Writes the file, whole or not at all. Throws FileError, Cancelled.
  SaveReport (*save)(const SaveJob& job) = nullptr;
};

// All of them, in the order of lists.
std::span<const RecordingFormat* const> recordingFormats() noexcept;
// All endings, in the order of lists.
std::vector<std::string> recordingEndings();
// The format of a name by its ending, in small or capital letters. Throws FileError naming them
// all.
const RecordingFormat& formatOf(const std::filesystem::path& path);

}  // namespace palpate
