// The recordings that the words of a command name (files, and folders with everything below them),
// and loops over them: a bad file does not stop the others, Ctrl-C ends a loop between two rows.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording.h>

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/table_command.h"

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
using OpenedWork =
    std::function<void(const std::filesystem::path& file, const Recording&, const Progress&)>;
using VerifyWork =
    std::function<FileOutcome(const std::filesystem::path& file, const VerifyReport&)>;

// Writes text, in the order of the recordings. Throws OutputError.
using TextSink = std::function<void(const std::string& text)>;
// These are called from several threads at once, each with another file.
using OpenedText = std::function<void(
    const std::filesystem::path& file, const Recording&, const TextSink& write, const Progress&)>;
// What stands between the texts of the recordings.
struct TextFrame {
  std::string begin = {};    // once, in front of the first recording that is done or wrote text
  std::string between = {};  // in front of every further one
};

// The line that says what a recording lost when it was read (lostText()); empty: nothing.
std::string lostLine(const std::filesystem::path& file, const Profile& profile);
// Prints on standard error what was guessed, unless quiet, and what was lost when a recording of
// another program was opened. Returns kPartlyDone where something was lost, else kDone.
int reportOpened(const std::filesystem::path& file, const Profile& profile, bool quiet);
// Opens a recording with `line` ("reading FILE", wiped at the end) and then calls reportOpened():
// a loss is part of the program's exit code. With `progress` it is used instead of that of `line`.
Recording openReported(const std::filesystem::path& file,
                       ProgressLine& line,
                       bool quiet,
                       const Progress& progress = {});
// Prints what a result lacks, with --quiet, too.
void reportLoss(const std::string& line);
// `code`, the exit code of the program; kPartlyDone in the place of kDone after reportLoss() or a
// loss that reportOpened() has printed.
int partlyDoneAfterLoss(int code);

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
int forEachOpened(const RecordingList& list, bool quiet, const OpenedWork& work);

// As forEachOpened(), for work that writes text to `out`, with every recording read completely; of
// a damaged one the readable part is used, and the rest is reported. Of small recordings the work
// is done several at a time, too; the output and the messages are the same as if it were done one
// after the other. What a recording wrote before it failed is kept. `topics`: ReadOptions::topics.
int writeReadableTexts(const RecordingList& list,
                       bool quiet,
                       const TextFrame& frame,
                       ResultOutput& out,
                       const OpenedText& work,
                       const std::vector<std::string>& topics = {});

// Makes the result table of a recording; called from several threads at once.
using TableOfRecording = std::function<std::unique_ptr<ResultTable>(
    const std::filesystem::path& file, const Recording&, const Progress&)>;
struct TableRun {
  TableOfRecording of;
  TableTextOptions text = {};
  // Every recording is read completely; of a damaged one the readable part is used.
  bool readable = false;
};
// As writeReadableTexts(): one table of all recordings on standard output, in whose last column
// `file` each row of several recordings names its own. A recording with other columns or units than
// the first one fails.
int writeTables(const RecordingList& list, bool quiet, const TableRun& run);

// Says on standard error, before a profile is saved as `out`, what will be missing there.
void reportLeftOut(const Profile& profile, const std::filesystem::path& out);

}  // namespace palpate::commands
