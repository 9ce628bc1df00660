// The recordings that the words of a command name (files as they are, folders with all that lies
// below them), and the way through them: one bad file doesn't stop the others, Ctrl-C ends between
// two rows.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording.h>

#include "commands/commands.h"

namespace palpate::commands {

struct RecordingList {
  // In the order of the words; those below a folder sorted by path, each named as the word given
  // joined with the rest.
  std::vector<std::filesystem::path> files;
  // A line each: a folder that can't be looked into, a folder without recordings.
  std::vector<std::string> problems;
  // More than one word, or a folder: one table over all, which names the files.
  bool several = false;
};

// Of folders what recordingsBelow() finds. Never throws for what it meets on the disk.
RecordingList recordingsIn(const Arguments& words);

// What came of one file.
struct FileOutcome {
  std::string said = {};     // a line for standard output; empty: none
  std::string problem = {};  // done in part: why, for standard error; empty: all is well
};
// Throws Error when the file can't be done, Cancelled when the progress returns false.
using FileWork = std::function<FileOutcome(const std::filesystem::path& file, const Progress&)>;
using ProfileWork =
    std::function<void(const std::filesystem::path& file, const Profile&, const Progress&)>;
using ReadableWork = std::function<void(
    const std::filesystem::path& file, const ReadableRecording&, const Progress&)>;

// Does the work for every file; only one is in memory at a time. Says on standard error, a line
// each, what went wrong with which file. Returns the exit code: 0 all done; 1 none (or there is no
// file); 3 some, also when it was interrupted (then it says how many were done). Throws what is no
// file's fault: UsageError, OutputError.
int forEachRecording(const RecordingList& list, bool quiet, const FileWork& work);
// The same with every recording opened; a damaged one fails. That one is unfinished or still being
// written is said, where there are several.
int forEachProfile(const RecordingList& list, bool quiet, const ProfileWork& work);
// The same with every recording read through; of a damaged one what can be read is taken, and the
// rest is told.
int forEachReadable(const RecordingList& list, bool quiet, const ReadableWork& work);

}  // namespace palpate::commands
