// Runs a batch: the same work for every recording of a plan, on several threads. The command line
// and the window use it.
//
// The folder of the results holds the journal ".palpate_batch", a JSON line per result: when it was
// begun, and once it is whole, of which bytes (size and time of change of the source) and with
// which options it was made. It is locked while a batch runs: a second one into the same folder
// fails at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <palpate/batch/batch_plan.h>
#include <palpate/core/option_check.h>
#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/core/text_table.h>

namespace palpate {

// What the work says of one recording.
struct BatchAnswer {
  std::string said = {};     // "64 frames"
  std::string problem = {};  // why it was done only in part, in one line; else empty
  // The files that were written, where there can be several for a recording; empty: item.target.
  std::vector<std::filesystem::path> results = {};
};

struct BatchTask {
  // Everything that the bytes of the results depend on beside the recording and the result's
  // ending. --resume compares it.
  std::string options;
  // Writes item.target, whole or not at all; or the files that the answer names, of which those in
  // item.earlier may be replaced in any case. Called from several threads at once. `threads`: to
  // read with, as openRecording(). Throws Error, Cancelled.
  std::function<BatchAnswer(
      const BatchItem& item, Overwrite overwrite, const Progress& progress, std::size_t threads)>
      work;
  // Whether it writes the files that its answer names instead of item.target.
  bool namesResults = false;
};

struct BatchOptions {
  // Recordings at the same time; 0: as many as the machine runs at once.
  static constexpr OptionRange kThreads{1, 256};
  std::size_t threads = 0;
  Overwrite overwrite = Overwrite::kRefuse;
  // A result is not made again when the journal says that it was made with the same options, of
  // this recording as it is now, and it is still the file that was written. One that is out of
  // date, or was interrupted before the journal knew that it is whole, is replaced. Any other file
  // is replaced only with Overwrite::kReplace.
  bool resume = false;
  // Its threads leave the processor to the others of the machine: beside a window that shows a
  // hand.
  bool inBackground = false;
};

struct BatchResult {
  enum class State { kNotDone, kDone, kInPart, kSkipped, kFailed };
  State state = State::kNotDone;
  // What was done, or why it failed or was done in part, in one line.
  std::string text = {};
  // The files that were written, or skipped because they are whole.
  std::vector<std::filesystem::path> files = {};
};
// "done", "done in part", "skipped", "failed", "not done".
const char* nameOf(BatchResult::State state) noexcept;

struct BatchStatus {
  std::size_t total = 0;
  std::size_t done = 0;  // in part, too
  std::size_t inPart = 0;
  std::size_t skipped = 0;
  std::size_t failed = 0;
  // 0..1, by the sizes of the recordings, with the part that is done of those in work.
  double fraction = 0.0;
  double perSecond = 0.0;  // recordings done or failed; those skipped take no time
  // [s], estimated; nothing while too little is done.
  std::optional<double> remainingS = {};
};

struct BatchReport {
  std::vector<BatchResult> results;  // as the items of the plan
  BatchStatus status = {};
  bool cancelled = false;
};

// Both are called in the caller's thread: for each result in the order of the items, and ten times
// a second; returning false cancels what is in work.
using BatchSink = std::function<void(std::size_t index, const BatchResult& result)>;
using BatchWatch = std::function<bool(const BatchStatus& status)>;

// Recordings above this size are done one at a time, beside the small ones.
inline constexpr std::uintmax_t kLargeBatchBytes = 8u << 20;

// Makes the results. What fails doesn't stop the others; what is finished stays after a
// cancellation. Throws FileError when the folder can't be made or written, or another batch writes
// into it; passes on what `sink` and `watch` throw.
BatchReport runBatch(const BatchPlan& plan,
                     const BatchTask& task,
                     const BatchOptions& options = {},
                     const BatchSink& sink = {},
                     const BatchWatch& watch = {});

// "12 of 609, 3 failed, 41.2/s, 14 s left".
std::string statusText(const BatchStatus& status);
// A row per state with its number, then at most `maxReasons` of the reasons; ends in a line break.
std::string summaryText(const BatchPlan& plan, const BatchReport& report, std::size_t maxReasons);
// A row for each recording: source, result, state, text, files. `result` is the file (of several
// the first one; of none the one that was planned), `files` is their number.
TextTable reportTable(const BatchPlan& plan, const BatchReport& report);

}  // namespace palpate
