#include "commands/recording_list.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"
#include "palpate/recording/read_ahead.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_folder.h"

#include "commands/command_line.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

void sayRecordingList(const std::string& message) {
  std::fprintf(stderr, "palpate: %s\n", escapedLine(message).c_str());
}

std::string countText(std::size_t part, std::size_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole);
}

// One loop over a list of recordings.
class ListRun {
 public:
  ListRun(const RecordingList& list, bool quiet) : list_(list), quiet_(quiet), line_("", quiet) {
    if (list.several) interruption_.emplace();
  }

  int through(const FileWork& work) {
    for (const std::string& problem : list_.problems) sayRecordingList(problem);
    for (index_ = 0; index_ < list_.files.size(); ++index_) {
      if (interrupted()) return endInterrupted();
      const fs::path& file = list_.files[index_];
      line_.setLabel(list_.several ? countText(index_ + 1, list_.files.size()) + ": " +
                                         escapedLine(file.filename().string())
                                   : escapedLine(file.string()));
      const std::optional<FileOutcome> outcome = tried(work);
      if (interrupted_) return endInterrupted();
      line_.wipe();
      if (!outcome) continue;
      if (!outcome->said.empty()) {
        std::printf("%s\n", outcome->said.c_str());
        std::fflush(stdout);  // each line at once, also into a pipe
      }
      if (outcome->problem.empty()) continue;
      sayRecordingList(outcome->problem);
      ++inPart_;
    }
    return end();
  }

  // Prints a message that is not a failure.
  void note(const std::string& message) {
    if (quiet_ || !list_.several) return;
    line_.wipe();
    sayRecordingList(message);
  }
  // Prints the warnings of native recordings, which tell that the end is missing; those of a .dsa
  // file don't matter here.
  void noteWarnings(const fs::path& file, const Profile& profile) {
    if (profile.info().format != "palpate") return;
    for (const std::string& warning : profile.info().warnings) note(file.string() + ": " + warning);
  }
  // Stops showing progress when rows go to a terminal: they would appear behind the percentage, and
  // they show the progress themselves.
  void leaveTheTerminal() {
    if (::isatty(STDOUT_FILENO) != 1) return;
    line_.wipe();
    shows_ = false;
  }

 private:
  bool interrupted() {
    if (!interrupted_ && interruption_) interrupted_ = interruption_->waitForSignal(0);
    return interrupted_;
  }

  Progress progress() {
    shows_ = true;
    return [this, show = line_.callback()](double fraction) {
      if (interrupted()) return false;
      if (shows_ && show)
        show((static_cast<double>(index_) + fraction) / static_cast<double>(list_.files.size()));
      return true;
    };
  }

  // Nothing when the file failed.
  std::optional<FileOutcome> tried(const FileWork& work) {
    try {
      return work(list_.files[index_], progress());
    } catch (const UsageError&) {
      throw;
    } catch (const OutputError&) {
      throw;
    } catch (const std::bad_alloc&) {
      fail(list_.files[index_].string() + ": out of memory");
    } catch (const std::exception& error) {
      if (!interrupted_) fail(error.what());
    }
    return std::nullopt;
  }

  void fail(const std::string& message) {
    line_.wipe();
    sayRecordingList(message);
    ++failed_;
  }

  int end() const {
    const std::size_t all = list_.files.size();
    if (failed_ > 1) sayRecordingList(countText(failed_, all) + " recordings failed");
    if (failed_ == all) return kFailed;
    return failed_ + inPart_ + list_.problems.size() > 0 ? kPartlyDone : kDone;
  }

  int endInterrupted() {
    line_.wipe();
    const std::size_t done = index_ - failed_;
    sayRecordingList("interrupted: " + countText(done, list_.files.size()) +
                     " recordings are done");
    return done > 0 ? kPartlyDone : kFailed;
  }

  const RecordingList& list_;
  bool quiet_;
  ProgressLine line_;
  // Absent for a single file: Ctrl-C then ends the process as usual.
  std::optional<Interruption> interruption_;
  std::size_t index_ = 0;
  std::size_t failed_ = 0;
  std::size_t inPart_ = 0;
  bool interrupted_ = false;
  bool shows_ = true;
};

// Progress of half of the work, starting at `begin`.
Progress halfOf(const Progress& progress, double begin) {
  return [&progress, begin](double fraction) { return progress(begin + 0.5 * fraction); };
}

}  // namespace

RecordingList recordingsIn(const Arguments& words) {
  RecordingList list;
  list.several = words.size() > 1;
  for (const std::string& word : words) {
    std::error_code ignored;
    if (!fs::is_directory(word, ignored)) {
      list.files.emplace_back(word);
      continue;
    }
    list.several = true;
    RecordingFolder folder = recordingsBelow(word);
    if (folder.files.empty() && folder.problems.empty()) {
      const FileError error(word, "no recording (.palpate, .dsa) in this folder or its subfolders");
      folder.problems.emplace_back(error.what());
    }
    std::move(folder.files.begin(), folder.files.end(), std::back_inserter(list.files));
    std::move(folder.problems.begin(), folder.problems.end(), std::back_inserter(list.problems));
  }
  return list;
}

int forEachRecording(const RecordingList& list, bool quiet, const FileWork& work) {
  return ListRun(list, quiet).through(work);
}

int forEachVerified(const RecordingList& list, bool quiet, const VerifyWork& work) {
  ReadAhead<VerifyReport> reports(list.files, &verifyRecording);
  return ListRun(list, quiet).through([&](const fs::path& file, const Progress& progress) {
    return work(file, reports.take(progress));
  });
}

int forEachProfile(const RecordingList& list, bool quiet, const ProfileWork& work) {
  ListRun run(list, quiet);
  ReadAhead<Profile> profiles(list.files, &openRecording);
  return run.through([&](const fs::path& file, const Progress& progress) {
    const Profile profile = profiles.take(halfOf(progress, 0.0));
    run.noteWarnings(file, profile);
    run.leaveTheTerminal();
    work(file, profile, halfOf(progress, 0.5));
    return FileOutcome();
  });
}

int forEachReadable(const RecordingList& list, bool quiet, const ReadableWork& work) {
  ListRun run(list, quiet);
  ReadAhead<ReadableRecording> recordings(list.files, &readableRecording);
  return run.through([&](const fs::path& file, const Progress& progress) {
    const ReadableRecording recording = recordings.take(halfOf(progress, 0.0));
    run.noteWarnings(file, recording.profile);
    run.leaveTheTerminal();
    work(file, recording, halfOf(progress, 0.5));
    return FileOutcome{.problem =
                           recording.damage.empty() ? "" : file.string() + ": " + recording.damage};
  });
}

}  // namespace palpate::commands
