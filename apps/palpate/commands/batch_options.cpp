#include "commands/batch_options.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include <unistd.h>

#include "palpate/core/escaped_line.h"
#include "palpate/core/file_name.h"
#include "palpate/core/interruption.h"
#include "palpate/core/text_table.h"

#include "commands/commands.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxReasons = 10;

// The line of progress on a terminal.
class BatchLine {
 public:
  explicit BatchLine(bool quiet) : enabled_(!quiet && ::isatty(STDERR_FILENO) == 1) {}
  ~BatchLine() { wipe(); }
  BatchLine(const BatchLine&) = delete;
  BatchLine& operator=(const BatchLine&) = delete;
  void show(const BatchStatus& status) {
    if (!enabled_) return;
    std::fprintf(stderr, "\r%s\033[K", statusText(status).c_str());
    std::fflush(stderr);
    shown_ = true;
  }
  void wipe() {
    if (shown_) std::fputs("\r\033[K", stderr);
    shown_ = false;
  }

 private:
  bool enabled_;
  bool shown_ = false;
};

int codeOf(const BatchPlan& plan, const BatchReport& report) {
  const BatchStatus& status = report.status;
  const std::size_t whole = status.done + status.skipped;
  if (whole == 0) return kFailed;
  const bool all = whole == plan.items.size() && status.inPart == 0 && plan.problems.empty();
  return all ? kDone : kPartlyDone;
}

}  // namespace

std::vector<OptionSpec> withBatchOptions(std::vector<OptionSpec> options) {
  const std::vector<OptionSpec> batch = {{"output,o",
                                          "TEMPLATE",
                                          "write a file for each recording, as out/{name}.csv; "
                                          "also {folder}, {ending}, {date}, {time}; "
                                          "docs/manual/many_recordings.md"},
                                         {"force", "", "replace files that exist"}};
  options.insert(options.end(), batch.begin(), batch.end());
  return withResumeOptions(std::move(options));
}

std::vector<OptionSpec> withResumeOptions(std::vector<OptionSpec> options) {
  const std::vector<OptionSpec> batch = {
      {"resume", "", "with -o: continue; files that are complete are kept"},
      rangedWhole("threads",
                  "N",
                  "with -o: recordings at the same time",
                  BatchOptions::kThreads,
                  "one per core"),
      {"report", "FILE.csv", "with -o: write a table with the result of each recording"}};
  options.insert(options.end(), batch.begin(), batch.end());
  return options;
}

bool hasBatchOptions(const CommandLine& given) {
  return given.has("resume") || given.has("threads") || given.has("report");
}

void refuseBatchOptions(const CommandLine& given) {
  for (const char* name : {"resume", "threads", "report"})
    if (given.has(name))
      throw UsageError("--" + std::string(name) + " needs -o TEMPLATE, as -o out/{name}.csv");
}

BatchTemplate batchTemplateOf(const CommandLine& given, const std::vector<std::string>& endings) {
  const std::string text = *given.text("output");
  try {
    const BatchTemplate names(text);
    if (endings.empty()) return names;
    const std::string ending = lowerEndingOf("x" + names.ending());
    if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return names;
    std::string list;
    for (const std::string& each : endings) list += (list.empty() ? "" : ", ") + each;
    throw UsageError("-o '" + text + "' must end in " + list);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("-o: ") + error.what());
  }
}

int runBatchCommand(const CommandLine& given,
                    const BatchTemplate& names,
                    const BatchTask& task,
                    const BatchCommand& command) {
  BatchOptions options;
  options.threads =
      static_cast<std::size_t>(given.integer("threads", BatchOptions::kThreads).value_or(0));
  options.overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  options.resume = given.has("resume");
  const std::optional<std::string> table = given.text("report");
  const Overwrite overwriteTable =
      options.resume || given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  if (table) requireWritable(*table, overwriteTable);

  Interruption interruption;
  std::vector<fs::path> paths = command.paths;
  if (paths.empty()) paths.assign(given.words().begin(), given.words().end());
  const BatchPlan plan = planBatch(
      paths, names, [&](double) { return !interruption.waitForSignal(0); }, command.sameResults);
  for (const std::string& problem : plan.problems) sayLine(problem);
  BatchLine line(given.quiet());
  StandardOutput out;
  const BatchReport report = runBatch(
      plan,
      task,
      options,
      [&](std::size_t, const BatchResult& result) {
        using State = BatchResult::State;
        const bool bad = result.state == State::kFailed || result.state == State::kInPart;
        if (bad) {
          line.wipe();
          sayLine(result.text);
        } else if (!given.quiet()) {
          line.wipe();
          out.write(escapedLine(result.text) + "\n");
          out.finish();
        }
      },
      [&](const BatchStatus& status) {
        line.show(status);
        return !interruption.waitForSignal(0);
      });
  line.wipe();
  if (table) writeTable(reportTable(plan, report), *table, overwriteTable);
  if (report.cancelled)
    sayLine("interrupted: " + std::to_string(report.status.done + report.status.skipped) + " of " +
            std::to_string(plan.items.size()) + " are done; continue with --resume");
  if (!command.summary && report.status.failed > 1)
    sayLine(std::to_string(report.status.failed) + " of " + std::to_string(plan.items.size()) +
            " recordings failed");
  if (command.summary && !given.quiet() && plan.items.size() > 1) {
    out.write(summaryText(plan, report, kMaxReasons));
    out.finish();
  }
  return codeOf(plan, report);
}

}  // namespace palpate::commands
