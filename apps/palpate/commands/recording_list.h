// The recordings that the words of a command name (files, and folders with everything below them),
// and a loop over them: a bad file does not stop the others, Ctrl-C ends the loop between two rows.
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
  // In the order of the words; the files of a folder are sorted by path, and each path starts with
  // the given word.
  std::vector<std::filesystem::path> files;
  // One line each: an unreadable folder, a folder without recordings.
  std::vector<std::string> problems;
  // Several words, or a folder: the output is one table that names the files.
  bool several = false;
};

// Searches folders with recordingsBelow(). Problems on the disk never throw.
RecordingList recordingsIn(const Arguments& words);

// The result of one file.
struct FileOutcome {
  // A line for standard output; may be empty.
  std::string said = {};
  // Why the file was done only in part, for standard error; else empty.
  std::string problem = {};
};
// Throws Error when the file cannot be processed, Cancelled when the progress returns false.
using FileWork = std::function<FileOutcome(const std::filesystem::path& file, const Progress&)>;
using ProfileWork =
    std::function<void(const std::filesystem::path& file, const Profile&, const Progress&)>;
using VerifyWork =
    std::function<FileOutcome(const std::filesystem::path& file, const VerifyReport&)>;
using ReadableWork = std::function<void(
    const std::filesystem::path& file, const ReadableRecording&, const Progress&)>;

// Runs `work` for every file, one at a time, and prints on standard error one line for each file
// that failed. Returns the exit code: 0 all done; 1 none done (or no file); 3 some done, also after
// an interruption (then the number of done files is printed). Passes on exceptions that no file
// caused: UsageError, OutputError.
int forEachRecording(const RecordingList& list, bool quiet, const FileWork& work);
// As forEachRecording(), with every recording checked. Here and below small recordings are read
// several at a time ahead of the work, which is still done one at a time and in order.
int forEachVerified(const RecordingList& list, bool quiet, const VerifyWork& work);
// As forEachRecording(), with every recording opened; a damaged one fails. With several files,
// prints which recordings are unfinished or still being written.
int forEachProfile(const RecordingList& list, bool quiet, const ProfileWork& work);
// As forEachRecording(), with every recording read completely; of a damaged one the readable part
// is used, and the rest is reported.
int forEachReadable(const RecordingList& list, bool quiet, const ReadableWork& work);

}  // namespace palpate::commands
