// The files that belong to one recording, and how a finished one gets another name or is deleted
// with all of them. A recording that is being written is never touched.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace palpate {

// Whether another program, or this one, is writing into a native recording now. Makes nothing;
// false for a file that isn't there, and for other formats.
bool isBeingWritten(const std::filesystem::path& recording);

// The recording and the files beside it that belong to it, as far as they are there: NAME.mcap, its
// journal NAME.palpate-journal, and the notes of a .dsa (NAME.dsa.notes.json). The recording itself
// stands first.
std::vector<std::filesystem::path> filesOfRecording(const std::filesystem::path& recording);

// Gives the parts of a finished recording (of one that was never split: one file) another name, and
// the files that belong to them, in the same folder. `stem` is the new name without its ending; the
// further parts keep what their names have more than the first one's: NAME_002 becomes STEM_002.
// Returns the new paths of the parts. Nothing is ever replaced. Throws std::invalid_argument (no
// parts; `stem` is empty, hidden or has a slash), FileError (a part isn't there, is being written
// or was never finished; a name is taken; the disk): then all files have their old names.
std::vector<std::filesystem::path> renameRecording(std::span<const std::filesystem::path> parts,
                                                   const std::string& stem);

// Throws FileError if a part is being written; parts that aren't there are passed over.
void requireNotBeingWritten(std::span<const std::filesystem::path> parts);

// Removes NAME.palpate.lock of each part, where a killed writer has left it and nobody holds it.
void removeFreeLocks(std::span<const std::filesystem::path> parts);

// Deletes the parts with all files that belong to them, for good; parts that aren't there are
// passed over. Throws FileError: a part is being written (then nothing is deleted), or a file can't
// be deleted.
void deleteRecording(std::span<const std::filesystem::path> parts);

}  // namespace palpate
