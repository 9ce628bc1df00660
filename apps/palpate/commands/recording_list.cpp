#include "commands/recording_list.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"
#include "palpate/library/recording_folder.h"
#include "palpate/recording/read_ahead.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_losses.h"

#include "commands/command_line.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

std::atomic<bool> lossReported = false;

std::string countText(std::size_t part, std::size_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole);
}

// Of several files the warnings of native recordings, which tell that the end is missing; those of
// MCAP files, which tell what was guessed; those of a .dsa file don't matter here.
std::vector<std::string> notedWarnings(const fs::path& file, const Profile& profile, bool several) {
  std::vector<std::string> lines;
  const std::string& format = profile.info().format;
  if (format == "mcap" || (format == "palpate" && several))
    for (const std::string& warning : profile.info().warnings)
      if (!warning.starts_with(kLostWarning)) lines.push_back(file.string() + ": " + warning);
  return lines;
}

// One loop over a list of recordings.
class ListRun {
 public:
  ListRun(const RecordingList& list, bool quiet) : list_(list), quiet_(quiet), line_("", quiet) {
    if (list.several) interruption_.emplace();
  }

  int through(const FileWork& work) {
    for (const std::string& problem : list_.problems) sayLine(problem);
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
      sayLine(outcome->problem);
      ++inPart_;
    }
    return end();
  }

  // Prints a message that is not a failure.
  void note(const std::string& message) {
    if (quiet_) return;
    line_.wipe();
    sayLine(message);
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
    sayLine(message);
    ++failed_;
  }

  int end() const {
    const std::size_t all = list_.files.size();
    if (failed_ > 1) sayLine(countText(failed_, all) + " recordings failed");
    if (failed_ == all) return kFailed;
    return failed_ + inPart_ + list_.problems.size() > 0 ? kPartlyDone : kDone;
  }

  int endInterrupted() {
    line_.wipe();
    const std::size_t done = index_ - failed_;
    sayLine("interrupted: " + countText(done, list_.files.size()) + " recordings are done");
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

// Of a small recording more text than this isn't kept until its turn comes.
constexpr std::size_t kMaxTextAhead = 4u << 20;
constexpr std::size_t kPieceOfRows = 1u << 16;  // bytes
// Why a recording can't be in a table whose columns and units are those of an earlier one.
constexpr const char* kOtherColumns =
    "its columns or units differ from those of the recordings before; write it to another table";
class TooMuchText {};

// What became of one recording before its turn.
struct TextAhead {
  bool done = false;  // otherwise the work is done when its turn comes
  std::vector<std::string> notes = {};
  std::string head = {};
  std::string text = {};
  std::string damage = {};
  std::exception_ptr failure = {};
};

// How files are opened.
enum class Reading { kWhole, kAsFarAsReadable };

std::string damageOf(const Recording& recording, Reading reading) {
  if (reading == Reading::kWhole) return lostText(recording.profile);
  const Damage& damage = recording.damage;
  return !damage.text.empty() || damage.events == 0 ? damage.text
                                                    : eventsLeftOutText(damage.events);
}

// What is written of all recordings: the head once, which must be the same for each, then texts.
struct TextForm {
  std::string between = {};
  std::string end = {};
  bool startsWithComma = false;  // each text; that of the first one is left out
};

// What the work on one recording writes, and says.
struct TextTarget {
  TextSink head;  // once, before any text
  TextSink write;
  std::vector<std::string> notes = {};
  std::vector<std::string> problems = {};
};
using TextWork = std::function<void(
    const fs::path& file, const Recording&, TextTarget& target, const Progress&)>;

std::string joined(std::string text, const std::vector<std::string>& more) {
  for (const std::string& each : more) text += (text.empty() ? "" : "; ") + each;
  return text;
}

// Runs `work` for each file: ahead of its turn for small recordings, whose text is kept until then;
// otherwise at its turn, straight to `out`.
int writeTexts(const RecordingList& list,
               bool quiet,
               const TextForm& form,
               Reading reading,
               const std::vector<std::string>& topics,
               ResultOutput& out,
               const TextWork& work) {
  ListRun run(list, quiet);
  bool begun = false, written = false;
  std::string firstHead;
  const auto read = [&](const fs::path& file, const Progress& progress, std::size_t threads) {
    return (reading == Reading::kWhole ? readRecording : readableRecording)(
        file, {threads, topics}, partOf(progress, 0.0, 0.5));
  };
  // The report on a single readable recording has its warnings.
  const auto notesOf = [&](const fs::path& file, const Recording& recording) {
    const bool reported = reading == Reading::kAsFarAsReadable && !list.several;
    return reported ? std::vector<std::string>()
                    : notedWarnings(file, recording.profile, list.several);
  };
  const auto begin = [&](const fs::path& file, const std::string& head) {
    if (begun && head != firstHead) throw Error(file.string() + ": " + kOtherColumns);
    out.write(begun ? form.between : head);
    firstHead = head;
    begun = true;
  };
  const auto put = [&](const std::string& text) {
    if (text.empty()) return;
    out.write(form.startsWithComma && !written ? text.substr(1) : text);
    written = true;
  };

  const auto atItsTurn = [&](const fs::path& file, const Progress& progress, std::size_t threads) {
    const Recording recording = read(file, progress, threads);
    for (const std::string& note : notesOf(file, recording)) run.note(note);
    run.leaveTheTerminal();
    TextTarget target{.head = [&](const std::string& head) { begin(file, head); }, .write = put};
    work(file, recording, target, partOf(progress, 0.5, 1.0));
    for (const std::string& note : target.notes) run.note(file.string() + ": " + note);
    return joined(damageOf(recording, reading), target.problems);
  };

  const auto ahead = [&](const fs::path& file, const Progress& progress, std::size_t threads) {
    TextAhead result;
    if (!isReadAhead(file)) return result;
    try {
      const Recording recording = read(file, progress, threads);
      result.notes = notesOf(file, recording);
      TextTarget target{.head = [&](const std::string& head) { result.head = head; },
                        .write =
                            [&](const std::string& text) {
                              if (result.text.size() + text.size() > kMaxTextAhead)
                                throw TooMuchText();
                              result.text += text;
                            }};
      work(file, recording, target, partOf(progress, 0.5, 1.0));
      for (const std::string& note : target.notes)
        result.notes.push_back(file.string() + ": " + note);
      result.damage = joined(damageOf(recording, reading), target.problems);
    } catch (const TooMuchText&) {
      return TextAhead();
    } catch (...) {
      result.failure = std::current_exception();
    }
    result.done = true;
    return result;
  };

  ReadAhead<TextAhead> texts(list.files, ahead);
  const int code = run.through([&](const fs::path& file, const Progress& progress) {
    TextAhead result = texts.take(progress);
    if (!result.done) {
      // What was written before a failure is kept.
      try {
        result.damage = atItsTurn(file, progress, 0);
      } catch (const OutputError&) {
        throw;
      } catch (...) {
        out.flush();
        throw;
      }
    } else {
      for (const std::string& note : result.notes) run.note(note);
      run.leaveTheTerminal();
      if (!result.failure || !result.text.empty()) {
        begin(file, result.head);
        put(result.text);
      }
    }
    // The rows of each recording at once.
    out.flush();
    if (result.failure) std::rethrow_exception(result.failure);
    return FileOutcome{.problem =
                           result.damage.empty() ? "" : file.string() + ": " + result.damage};
  });
  if (begun) out.write(form.end);
  out.flush();
  return code;
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
    if (folder.files.empty() && folder.problems.empty())
      folder.problems.push_back(noRecordingText(word));
    std::move(folder.files.begin(), folder.files.end(), std::back_inserter(list.files));
    std::move(folder.problems.begin(), folder.problems.end(), std::back_inserter(list.problems));
  }
  return list;
}

std::string lostLine(const fs::path& file, const Profile& profile) {
  const std::string lost = lostText(profile);
  return lost.empty() ? lost : file.string() + ": " + lost;
}

void reportLoss(const std::string& line) {
  sayLine(line);
  lossReported = true;
}

int reportOpened(const fs::path& file, const Profile& profile, bool quiet) {
  if (!quiet)
    for (const std::string& line : notedWarnings(file, profile, false)) sayLine(line);
  const std::string lost = lostLine(file, profile);
  if (lost.empty()) return kDone;
  reportLoss(lost);
  return kPartlyDone;
}

Recording openReported(const fs::path& file,
                       ProgressLine& line,
                       bool quiet,
                       const Progress& progress) {
  line.setLabel("reading " + file.string());
  Recording recording = readRecording(file, {}, progress ? progress : line.callback());
  line.wipe();
  reportOpened(file, recording.profile, quiet);
  return recording;
}

int partlyDoneAfterLoss(int code) { return code == kDone && lossReported ? kPartlyDone : code; }

int forEachRecording(const RecordingList& list, bool quiet, const FileWork& work) {
  return ListRun(list, quiet).through(work);
}

int forEachVerified(const RecordingList& list, bool quiet, const VerifyWork& work) {
  ReadAhead<VerifyReport> reports(list.files, &verifyRecording);
  return ListRun(list, quiet).through([&](const fs::path& file, const Progress& progress) {
    return work(file, reports.take(progress));
  });
}

int forEachOpened(const RecordingList& list, bool quiet, const OpenedWork& work) {
  ListRun run(list, quiet);
  const auto read = [](const fs::path& file, const Progress& progress, std::size_t threads) {
    return readRecording(file, {.threads = threads}, progress);
  };
  ReadAhead<Recording> recordings(list.files, read);
  return run.through([&](const fs::path& file, const Progress& progress) {
    const Recording recording = recordings.take(partOf(progress, 0.0, 0.5));
    for (const std::string& note : notedWarnings(file, recording.profile, list.several))
      run.note(note);
    run.leaveTheTerminal();
    work(file, recording, partOf(progress, 0.5, 1.0));
    return FileOutcome{.problem = lostLine(file, recording.profile)};
  });
}

int writeReadableTexts(const RecordingList& list,
                       bool quiet,
                       const TextFrame& frame,
                       ResultOutput& out,
                       const OpenedText& work,
                       const std::vector<std::string>& topics) {
  return writeTexts(list,
                    quiet,
                    {.between = frame.between},
                    Reading::kAsFarAsReadable,
                    topics,
                    out,
                    [&](const fs::path& file,
                        const Recording& recording,
                        TextTarget& target,
                        const Progress& progress) {
                      bool first = true;
                      const auto write = [&](const std::string& text) {
                        if (std::exchange(first, false)) target.head(frame.begin);
                        target.write(text);
                      };
                      work(file, recording, write, progress);
                      write({});
                    });
}

int writeTables(const RecordingList& list, bool quiet, const TableRun& run) {
  TableTextOptions options = run.text;
  if (list.several) options.addedName = "file";
  const bool isJson = options.form == TableForm::kJson;
  ResultOutput out;
  return writeTexts(list,
                    quiet,
                    {.end = isJson ? kJsonTableEnd : "", .startsWithComma = isJson},
                    run.readable ? Reading::kAsFarAsReadable : Reading::kWhole,
                    {},
                    out,
                    [&](const fs::path& file,
                        const Recording& recording,
                        TextTarget& target,
                        const Progress& progress) {
                      const std::unique_ptr<ResultTable> table = run.of(file, recording, progress);
                      const TableText text(*table, options, file.string());
                      target.head(text.begin());
                      std::string rows;
                      for (std::vector<Cell> cells; table->next(cells);) {
                        text.appendRow(rows, cells);
                        if (rows.size() < kPieceOfRows) continue;
                        target.write(rows);
                        rows.clear();
                      }
                      target.write(rows);
                      target.notes = table->notes();
                      target.problems = table->problems();
                    });
}

void reportLeftOut(const Profile& profile, const std::filesystem::path& out) {
  const std::string text = leftOutText(profile, out);
  if (!text.empty()) sayLine(out.string() + ": " + text);
}

}  // namespace palpate::commands
