// Goes through all recordings of a folder and tells of each what readDetails() tells. What was read
// once is kept in a cache file, and read again only when the recording (or the sidecar with its
// notes) has changed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/recording/recording_details.h>

namespace palpate {

// Called in the thread that goes through the folder.
struct CatalogSink {
  std::function<void(std::size_t numFiles)> listed = {};  // once, before the first recording
  // one after the other; first those that the cache knows, each by its path
  std::function<void(RecordingDetails&& details)> take = {};
};

struct CatalogReport {
  std::size_t numFiles = 0;
  std::size_t numRead = 0;                     // not from the cache
  std::vector<std::string> problems;           // a line for each folder that can't be looked into
  std::vector<std::filesystem::path> folders;  // that were looked into
  bool local = false;  // on a disk of this computer, which reports when something in it changes
  std::string cacheProblem;  // why nothing could be kept; empty: all is well
};

// Recordings as recordingsBelow() (library/recording_folder.h) lists them. `cacheFolder` is made
// where it isn't there; empty: nothing is kept. A cache that is damaged, or of another version, is
// made anew. Never throws for what it meets on the disk; throws Cancelled: what was read until then
// is kept.
CatalogReport catalogRecordings(const std::filesystem::path& folder,
                                const std::filesystem::path& cacheFolder,
                                const CatalogSink& sink,
                                const Progress& progress = {});

// Where the cache of a folder lies: library_<hash of its path>.json.
std::filesystem::path catalogCachePath(const std::filesystem::path& folder,
                                       const std::filesystem::path& cacheFolder);

}  // namespace palpate
