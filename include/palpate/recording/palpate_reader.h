// Reads a native recording `*.palpate` (docs/notes/palpate_format.md) with random access: the block
// index lies in memory, blocks are read and checked on demand.
//
// A finished recording is opened read-only where it lies. An unfinished one (its writer died) is
// copied with its rollback journal to a temporary folder and opened there; one that is being
// written is read in place, as far as it has been committed when it was opened.
#pragma once

#include <filesystem>

#include <palpate/core/progress.h>
#include <palpate/recording/recording_data.h>

namespace palpate {

// Reads a native recording as a whole, by one opening: an unfinished one is copied at each. Throws
// FileError, FormatError (no native recording, or so damaged that its index or layout is gone;
// 'palpate recover' may help), Cancelled. A block whose checksum is wrong is found when it is read:
// Profile::readFrame then throws FormatError; it is never shown as data.
Recording readPalpate(const std::filesystem::path& path, const Progress& progress = {});

// The event table of a recording. Throws FileError, FormatError.
EventsReport readPalpateEvents(const std::filesystem::path& path);

}  // namespace palpate
