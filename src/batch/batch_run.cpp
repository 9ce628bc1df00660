#include "palpate/batch/batch_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include <sys/resource.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/recording/recording.h"

#include "batch/batch_journal.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

using State = BatchResult::State;
constexpr std::chrono::milliseconds kWatchInterval(100);
constexpr std::uintmax_t kMinWeight = 1u << 10;  // a recording is work however small it is
constexpr int kBackgroundNice = 10;
constexpr double kMinFraction = 0.01;  // an estimate of less says nothing

// What --resume does about a result. kOurs: files of an earlier run, which may be replaced.
enum class Known { kNew, kWhole, kOurs };

bool isFinished(const JournalEntry& entry) { return entry.targetStamp || !entry.results.empty(); }

// The files of an entry, as they were written: its own or, when it was begun only, those that it
// was about to replace.
std::vector<WrittenFile> filesOf(const JournalEntry& entry) {
  if (!isFinished(entry)) return entry.replaceable;
  if (!entry.results.empty()) return entry.results;
  return {{entry.target, *entry.targetStamp}};
}

Known knownAs(const BatchJournal& journal, const JournalEntry& now, const BatchItem& item) {
  const JournalEntry* before = journal.find(item.target);
  if (!before) return Known::kNew;
  // The result of another recording or command must be protected like any user file.
  const auto command = [](const std::string& options) {
    return options.substr(0, options.find(';'));
  };
  if (before->source != now.source || command(before->options) != command(now.options))
    return Known::kNew;
  const std::vector<WrittenFile> files = filesOf(*before);
  // Begun, and nothing was there: a file that is there now may be somebody's.
  if (files.empty()) return Known::kNew;
  bool same = isFinished(*before) && before->options == now.options &&
              before->sourceStamp == now.sourceStamp;
  for (const WrittenFile& file : files) {
    const std::optional<FileStamp> there = stampOf(journal.pathOf(file.path));
    if (there && *there != file.stamp) return Known::kNew;
    same = same && there;
  }
  return same ? Known::kWhole : Known::kOurs;
}

class BatchRun {
 public:
  BatchRun(const BatchPlan& plan, const BatchTask& task, const BatchOptions& options)
      : plan_(plan),
        task_(task),
        options_(options),
        journal_(plan.folder),
        parts_(std::make_unique<std::atomic<double>[]>(plan.items.size())),
        finished_(plan.items.size(), false) {
    report_.results.resize(plan.items.size());
    report_.status.total = plan.items.size();
    for (const BatchItem& item : plan.items) {
      std::error_code failure;
      const std::uintmax_t size = fs::file_size(item.source, failure);
      sizes_.push_back(failure ? 0 : size);
      weight_ += static_cast<double>(std::max(sizes_.back(), kMinWeight));
    }
  }

  BatchReport through(const BatchSink& sink, const BatchWatch& watch) {
    std::size_t threads = options_.threads;
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    threads = std::min(threads, plan_.items.size());
    readThreads_ = threads > 1 ? 1 : 0;
    startUs_ = systemClock().monotonicUs();
    {
      std::vector<std::jthread> workers;
      try {
        while (workers.size() < threads) {
          workers.emplace_back([this] { work(); });
          ++running_;
        }
        await(sink, watch);
      } catch (...) {  // the sink or the watch threw, or a thread could not be started
        cancelled_ = true;
        throw;
      }
    }
    report_.cancelled = cancelled_;
    report_.status = status();
    return std::move(report_);
  }

 private:
  void work() {
    // Of this thread only. Where it is refused, the batch is no less right.
    if (options_.inBackground) ::setpriority(PRIO_PROCESS, 0, kBackgroundNice);
    for (;;) {
      const std::size_t index = next_++;
      if (index >= plan_.items.size() || cancelled_) break;
      std::unique_lock<std::mutex> alone(large_, std::defer_lock);
      if (sizes_[index] > kLargeBatchBytes) alone.lock();
      if (cancelled_) break;
      const BatchResult result = tried(index);
      const std::lock_guard lock(mutex_);
      report_.results[index] = result;
      finished_[index] = true;
      changed_.notify_one();
    }
    const std::lock_guard lock(mutex_);
    ++ended_;
    changed_.notify_one();
  }

  BatchResult tried(std::size_t index) {
    const BatchItem& item = plan_.items[index];
    try {
      return done(index);
    } catch (const Cancelled&) {
      return {};
    } catch (const std::bad_alloc&) {
      return {State::kFailed, item.source.string() + ": out of memory"};
    } catch (const std::exception& error) {
      return {State::kFailed, error.what()};
    }
  }

  BatchResult done(std::size_t index) {
    const BatchItem& item = plan_.items[index];
    if (!item.problem.empty()) return {State::kFailed, item.problem};
    JournalEntry entry = journal_.entryFor(item.target, item.source, task_.options);
    Overwrite overwrite = options_.overwrite;
    BatchItem now = item;
    if (options_.resume) {
      const Known known = knownAs(journal_, entry, item);
      const JournalEntry* before = journal_.find(item.target);
      if (known == Known::kWhole) return skipped(item, *before);
      if (known == Known::kOurs) entry.replaceable = filesOf(*before);
      // Only files that were written may be replaced.
      for (const WrittenFile& file : entry.replaceable)
        if (!task_.namesResults && file.path == entry.target)
          overwrite = Overwrite::kReplace;
        else
          now.earlier.push_back(journal_.pathOf(file.path));
    }
    requireOther(item.source, item.target);
    makeFolder(item.target.parent_path());
    if (now.earlier.empty()) requireWritable(item.target, overwrite);
    journal_.add(entry);
    entry.replaceable.clear();
    const BatchAnswer answer = task_.work(
        now,
        overwrite,
        [this, index](double fraction) {
          parts_[index] = std::clamp(fraction, 0.0, 1.0);
          return !cancelled_;
        },
        readThreads_);
    const bool isOne = answer.results.empty();
    if (isOne) entry.targetStamp = stampOf(item.target);
    for (const fs::path& result : answer.results)
      entry.results.push_back({journal_.relative(result), stampOf(result).value_or(FileStamp())});
    journal_.add(entry);
    const std::vector<fs::path> files = isOne ? std::vector{item.target} : answer.results;
    if (!answer.problem.empty())
      return {State::kInPart,
              answer.problem + (isOne || answer.said.empty() ? "" : "; " + answer.said),
              files};
    const fs::path& named = isOne ? item.target : item.source;
    const auto left = static_cast<std::size_t>(
        std::count_if(now.earlier.begin(), now.earlier.end(), [&](const fs::path& file) {
          const auto& made = answer.results;
          return std::find(made.begin(), made.end(), file) == made.end() && stampOf(file);
        }));
    return {State::kDone,
            named.string() + (answer.said.empty() ? "" : ": ") + answer.said +
                (left > 0 ? "; " + counted(left, "file") + " of an earlier run left over" : ""),
            files};
  }

  BatchResult skipped(const BatchItem& item, const JournalEntry& before) const {
    BatchResult result{.state = State::kSkipped};
    for (const WrittenFile& file : filesOf(before))
      result.files.push_back(journal_.pathOf(file.path));
    result.text = before.results.empty()
                      ? item.target.string() + ": is whole"
                      : item.source.string() + ": " + counted(result.files.size(), "file") +
                            (result.files.size() == 1 ? " is" : " are") + " whole";
    return result;
  }

  static void makeFolder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) throw FileError(folder, "can't be created: " + failure.message());
  }

  // Waits in the caller's thread; passes results on in their order.
  void await(const BatchSink& sink, const BatchWatch& watch) {
    std::unique_lock lock(mutex_);
    std::size_t told = 0;
    std::int64_t nextWatchUs = 0;
    for (;;) {
      const bool ended = ended_ == running_;
      while (told < finished_.size() && finished_[told]) {
        const BatchResult result = report_.results[told];
        lock.unlock();
        if (sink && result.state != State::kNotDone) sink(told, result);
        ++told;
        lock.lock();
      }
      if (ended) break;
      const std::int64_t nowUs = systemClock().monotonicUs();
      if (watch && nowUs >= nextWatchUs) {
        const BatchStatus now = status();
        lock.unlock();
        if (!watch(now)) cancelled_ = true;
        lock.lock();
        nextWatchUs = nowUs + std::chrono::microseconds(kWatchInterval).count();
        continue;
      }
      changed_.wait_for(lock, kWatchInterval);
    }
    // After a cancellation results behind one that was not done.
    for (; told < finished_.size(); ++told) {
      const BatchResult result = report_.results[told];
      if (sink && result.state != State::kNotDone) sink(told, result);
    }
  }

  // With mutex_ locked, or after all threads have ended.
  BatchStatus status() const {
    BatchStatus now;
    now.total = plan_.items.size();
    double passed = 0.0;
    double skipped = 0.0;
    for (std::size_t i = 0; i < now.total; ++i) {
      const auto weight = static_cast<double>(std::max(sizes_[i], kMinWeight));
      const State state = report_.results[i].state;
      now.inPart += state == State::kInPart;
      now.done += state == State::kDone || state == State::kInPart;
      now.skipped += state == State::kSkipped;
      now.failed += state == State::kFailed;
      passed += weight * (state == State::kNotDone ? parts_[i].load() : 1.0);
      if (state == State::kSkipped) skipped += weight;
    }
    if (weight_ > 0.0) now.fraction = std::min(1.0, passed / weight_);
    constexpr double kSPerUs = 1e-6;
    const double elapsedS = static_cast<double>(systemClock().monotonicUs() - startUs_) * kSPerUs;
    if (elapsedS > 0.0) now.perSecond = static_cast<double>(now.done + now.failed) / elapsedS;
    // What was skipped took no time and says nothing about the rest.
    const double own = passed - skipped;
    if (own > kMinFraction * (weight_ - skipped))
      now.remainingS = elapsedS * std::max(0.0, weight_ - passed) / own;
    return now;
  }

  const BatchPlan& plan_;
  const BatchTask& task_;
  const BatchOptions options_;
  BatchJournal journal_;
  std::vector<std::uintmax_t> sizes_;
  double weight_ = 0.0;
  std::size_t readThreads_ = 0;
  std::int64_t startUs_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> cancelled_ = false;
  std::unique_ptr<std::atomic<double>[]> parts_;  // done of each recording, 0..1
  std::mutex large_;                              // held while a large recording is in work

  std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  BatchReport report_;
  std::vector<bool> finished_;
  std::size_t running_ = 0;  // threads that were started; the caller's thread only
  std::size_t ended_ = 0;
};

}  // namespace

const char* nameOf(State state) noexcept {
  switch (state) {
    case State::kDone:
      return "done";
    case State::kInPart:
      return "done in part";
    case State::kSkipped:
      return "skipped";
    case State::kFailed:
      return "failed";
    case State::kNotDone:
      break;
  }
  return "not done";
}

BatchReport runBatch(const BatchPlan& plan,
                     const BatchTask& task,
                     const BatchOptions& options,
                     const BatchSink& sink,
                     const BatchWatch& watch) {
  if (plan.items.empty()) return {};
  return BatchRun(plan, task, options).through(sink, watch);
}

std::string statusText(const BatchStatus& status) {
  std::string text = std::to_string(status.done + status.skipped + status.failed) + " of " +
                     std::to_string(status.total);
  if (status.failed > 0) text += ", " + std::to_string(status.failed) + " failed";
  if (status.perSecond > 0.0) text += ", " + fixedText(status.perSecond, 1) + "/s";
  if (!status.remainingS) return text;
  constexpr std::int64_t kSPerMin = 60;
  const auto left = static_cast<std::int64_t>(std::ceil(*status.remainingS));
  if (left < 2 * kSPerMin) return text + ", " + std::to_string(left) + " s left";
  return text + ", " + std::to_string((left + kSPerMin - 1) / kSPerMin) + " min left";
}

std::string summaryText(const BatchPlan& plan, const BatchReport& report, std::size_t maxReasons) {
  const BatchStatus& status = report.status;
  std::string text;
  const auto row = [&](const std::string& name, std::size_t count) {
    std::string line = name;
    line.resize(14, ' ');
    const std::string number = std::to_string(count);
    if (number.size() < 6) line += std::string(6 - number.size(), ' ');
    text += line + number + "\n";
  };
  row("done", status.done - status.inPart);
  if (status.inPart > 0) row("done in part", status.inPart);
  row("skipped", status.skipped);
  row("failed", status.failed);
  const std::size_t rest = plan.items.size() - status.done - status.skipped - status.failed;
  if (rest > 0) row("not done", rest);
  std::size_t reasons = 0;
  for (const BatchResult& result : report.results) {
    if (result.state != State::kFailed && result.state != State::kInPart) continue;
    if (++reasons <= maxReasons) text += "  " + escapedLine(result.text) + "\n";
  }
  if (reasons > maxReasons)
    text += "  and " + std::to_string(reasons - maxReasons) + " more, all in the report\n";
  return text;
}

TextTable reportTable(const BatchPlan& plan, const BatchReport& report) {
  return {.header = {"source", "result", "state", "text", "files"},
          .numRows = report.results.size(),
          .row = [&plan, &report](std::size_t i) -> std::vector<std::string> {
            const BatchResult& result = report.results[i];
            const fs::path& named =
                result.files.empty() ? plan.items[i].target : result.files.front();
            return {plan.items[i].source.string(),
                    named.string(),
                    nameOf(result.state),
                    result.text,
                    std::to_string(result.files.size())};
          }};
}

}  // namespace palpate
