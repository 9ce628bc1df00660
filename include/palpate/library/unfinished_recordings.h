// Finds the native recordings of a folder whose writer died before it could finish them (the
// computer lost its power, the program was killed), so that they can be offered for recovery. Only
// reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <palpate/core/progress.h>

namespace palpate {

struct UnfinishedRecording {
  std::filesystem::path path;
  std::int64_t changedUs = 0;  // time of the last change [us since 1970]
  std::uintmax_t sizeBytes = 0;
};

// The files *.palpate of FOLDER itself that were never finished, that no process is writing, and
// that hold something to recover (samples, events); the one changed last is the first. Left out
// are: what can't be read or is no recording, hidden files, symbolic links (what they lead to has a
// folder of its own), and recordings beside which lies what was recovered from them. One that died
// inside a commit is recognised by its journal and its header alone, and listed even if it holds
// nothing. A folder that isn't there has none. Throws FileError (it can't be listed),
// Cancelled.
std::vector<UnfinishedRecording> findUnfinished(const std::filesystem::path& folder,
                                                const Progress& progress = {});

// Where to save what is recovered of NAME.palpate: NAME_recovered.palpate beside it, or
// NAME_recovered-2.palpate, ..: a name that nothing has. Makes nothing.
std::filesystem::path recoveredPathOf(const std::filesystem::path& recording);

}  // namespace palpate
