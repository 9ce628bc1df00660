// The recordings that lie in a folder and in all folders below it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <palpate/core/progress.h>

namespace palpate {

struct RecordingFolder {
  // sorted, each named as the folder given joined with the rest
  std::vector<std::filesystem::path> files;
  std::vector<std::string> problems;           // a line for each folder that can't be looked into
  std::vector<std::filesystem::path> folders;  // that were looked into, itself among them; sorted
};

// Counted are: files whose name ends in .dsa or .palpate (in any case), and files without an ending
// that begin as a native recording does. Left out: hidden files and folders, sidecars, locks,
// journals, and links that lead back to where they stand or to what is in the list already (a link
// to anything else is followed). A file that is damaged, unfinished or no recording at all is in
// the list: whoever reads it says so. Throws nothing for what it meets on the disk; Cancelled when
// the progress (asked for every name, always with 0) returns false.
RecordingFolder recordingsBelow(const std::filesystem::path& folder, const Progress& progress = {});
// Why a folder is refused in which there is none, with its name.
std::string noRecordingText(const std::filesystem::path& folder);

}  // namespace palpate
