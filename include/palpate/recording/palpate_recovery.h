// What can be saved of a native recording, damaged or unfinished: every block whose checksum is
// right, also where SQLite can't reach it any more (its own integrity check misses flipped values).
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/event.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording_data.h>

namespace palpate {

// What was saved of a series beside those of the hand.
struct RecoveredSeries {
  std::string name;
  std::size_t samples = 0;
  std::size_t lost = 0;
  bool renamed = false;  // its description was lost: the name is "series_2", the columns "1", ..
};

struct PalpateRecovery {
  std::optional<Profile> profile;  // made of the intact blocks; none when no block is intact
  // Those of the recording, and one of kind "gap" for each span of items that is missing (behind
  // the last saved item: a moment at its time). In order of time.
  std::vector<Event> events;
  RecordingMeta meta;      // as readRecordingMeta(), as far as it can be read
  std::size_t frames = 0;  // saved
  std::size_t angles = 0;
  std::size_t temperatures = 0;
  // Known to be missing before, between and (where the recording tells how many there were) behind
  // the saved blocks.
  std::size_t lostFrames = 0;
  std::size_t lostAngles = 0;
  std::size_t lostTemperatures = 0;
  std::vector<RecoveredSeries> further = {};  // in order of their index, from kHandSeries on
  std::size_t damagedBlocks = 0;    // rows that SQLite gave, with a wrong checksum or content
  std::size_t blocksFromPages = 0;  // found by reading pages only
  std::size_t damagedRows = 0;  // of meta, matrix, second, event; summaries that don't fit the data
  bool unfinished = false;      // its writer stopped before the end
  bool beingWritten = false;    // by another program: everything committed so far
  bool layoutAssumed = false;   // the layout was lost, but that of the SDH-2 fits every saved frame
  bool layoutLost = false;      // no layout fits: no frame can be read
  std::string sqliteError;      // what SQLite said, when it gave up
  std::size_t savedItems() const noexcept {
    std::size_t items = frames + angles + temperatures;
    for (const RecoveredSeries& series : further) items += series.samples;
    return items;
  }
  std::size_t lostItems() const noexcept {
    std::size_t items = lostFrames + lostAngles + lostTemperatures;
    for (const RecoveredSeries& series : further) items += series.lost;
    return items;
  }
  bool anyRenamed() const noexcept {
    return std::any_of(further.begin(), further.end(), [](const auto& s) { return s.renamed; });
  }
  // Whether nothing is missing and nothing is wrong.
  bool whole() const noexcept {
    return lostItems() + damagedBlocks + blocksFromPages + damagedRows == 0 && !layoutAssumed &&
           !layoutLost && !anyRenamed() && sqliteError.empty();
  }
};

// Saves what can be saved. Where a rollback journal has to be played back, a copy in a temporary
// folder is worked on: the file itself is never touched. Throws FileError (can't be read),
// FormatError (not a native recording at all), Cancelled.
PalpateRecovery recoverPalpateProfile(const std::filesystem::path& path,
                                      const Progress& progress = {});

// Whether a native recording was never finished, no process is writing it, and it holds something
// to recover (samples, events). One whose writer died inside a commit is recognised by its journal
// and its header alone, even if it holds nothing. False for what can't be read or is no recording.
bool isUnfinishedRecording(const std::filesystem::path& path);

}  // namespace palpate
