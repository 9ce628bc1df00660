#include "palpate/batch/batch_run.h"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::batch_run_test {
namespace {

namespace fs = std::filesystem;
using State = BatchResult::State;

// Copies recordings, which are any files here.
class BatchRuns : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "in");
    for (int i = 0; i < 20; ++i) {
      const std::string stem = "r" + std::to_string(10 + i);
      testing::writeFile(folder_ / ("in/" + stem + ".dsa"), stem);
    }
    plan_ = planBatch({folder_ / "in"}, BatchTemplate((folder_ / "out/{name}.csv").string()));
  }
  BatchTask copying(const std::string& options = "copy") {
    return {
        .options = options,
        .work = [this](const BatchItem& item, Overwrite overwrite, const Progress&, std::size_t) {
          ++works_;
          const std::string bytes = testing::readFile(item.source);
          if (bytes == "bad") throw FileError(item.source, "is bad");
          OutputFile out(item.target, overwrite);
          out.write(bytes);
          out.commit();
          return BatchAnswer{.said = "copied"};
        }};
  }
  std::size_t worksOf(const BatchOptions& options, const std::string& name = "copy") {
    works_ = 0;
    last_ = runBatch(plan_, copying(name), options);
    return works_;
  }

  testing::TemporaryFolder folder_;
  BatchPlan plan_;
  BatchReport last_;
  std::atomic<std::size_t> works_ = 0;
};

TEST_F(BatchRuns, TellsResultsInTheOrderOfTheItems) {
  for (const std::size_t threads : {1U, 4U}) {
    std::vector<std::size_t> told;
    const BatchReport report =
        runBatch(plan_,
                 copying(),
                 {.threads = threads, .overwrite = Overwrite::kReplace},
                 [&](std::size_t index, const BatchResult& result) {
                   told.push_back(index);
                   EXPECT_EQ(result.text, plan_.items[index].target.string() + ": copied");
                 });
    ASSERT_EQ(told.size(), 20U);
    for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], i);
    EXPECT_EQ(report.status.done, 20U);
    EXPECT_DOUBLE_EQ(report.status.fraction, 1.0);
    EXPECT_FALSE(report.cancelled);
  }
  EXPECT_EQ(testing::readFile(folder_ / "out/r13.csv"), "r13");
}

TEST_F(BatchRuns, WhatFailsDoesNotStopTheOthers) {
  testing::writeFile(folder_ / "in/r12.dsa", "bad");
  fs::remove(folder_ / "in/r15.dsa");  // vanished since it was found
  EXPECT_EQ(worksOf({}), 20U);
  EXPECT_EQ(last_.status.done + last_.status.failed, 20U);
  EXPECT_EQ(last_.results[2].state, State::kFailed);
  EXPECT_NE(last_.results[2].text.find("r12.dsa"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "out/r12.csv"));
}

TEST_F(BatchRuns, ReplacesNothingUnlessAsked) {
  fs::create_directories(folder_ / "out");
  testing::writeFile(folder_ / "out/r10.csv", "mine");
  worksOf({});
  EXPECT_EQ(last_.results[0].state, State::kFailed);
  worksOf({.resume = true});  // not a result of a batch
  EXPECT_EQ(last_.results[0].state, State::kFailed);
  EXPECT_EQ(testing::readFile(folder_ / "out/r10.csv"), "mine");
  worksOf({.overwrite = Overwrite::kReplace});
  EXPECT_EQ(testing::readFile(folder_ / "out/r10.csv"), "r10");
}

TEST_F(BatchRuns, ResumesWithWhatIsMissingOrOutOfDate) {
  EXPECT_EQ(worksOf({}), 20U);
  EXPECT_EQ(worksOf({.resume = true}), 0U);
  EXPECT_EQ(last_.status.skipped, 20U);

  fs::remove(folder_ / "out/r11.csv");
  testing::writeFile(folder_ / "in/r12.dsa", "longer");
  EXPECT_EQ(worksOf({.resume = true}), 2U);
  EXPECT_EQ(testing::readFile(folder_ / "out/r12.csv"), "longer");

  EXPECT_EQ(worksOf({.resume = true}, "copy; other options"), 20U);
  EXPECT_EQ(last_.status.done, 20U);
  // Results of another command are not replaced.
  EXPECT_EQ(worksOf({.resume = true}, "signals; other options"), 0U);
  EXPECT_EQ(last_.status.failed, 20U);
  EXPECT_EQ(worksOf({.resume = true}, "copy; other options"), 0U);
  // A result that somebody changed is not replaced.
  testing::writeFile(folder_ / "out/r13.csv", "somebody's");
  EXPECT_EQ(worksOf({.resume = true}), 19U);
  EXPECT_EQ(last_.results[3].state, State::kFailed);
  EXPECT_EQ(testing::readFile(folder_ / "out/r13.csv"), "somebody's");
}

// Whether the journal has the whole line of a result.
bool isTold(const std::string& journal, const std::string& name) {
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = journal.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    const std::string line = journal.substr(begin, end - begin);
    if (line.find('"' + name + '"') != std::string::npos &&
        line.find("target_size") != std::string::npos)
      return true;
  }
  return false;
}

// F11 of the attack: without the line of the result the file in its place may be anybody's.
TEST_F(BatchRuns, AFileWhoseResultIsNotInTheJournalIsNeverReplaced) {
  worksOf({.threads = 1});
  const fs::path journal = folder_ / "out/.palpate_batch";
  const std::string whole = testing::readFile(journal);
  const std::size_t end = whole.rfind("target_size");
  ASSERT_NE(end, std::string::npos);
  const std::size_t begin = whole.rfind('\n', end) + 1;
  std::string damaged = whole;
  damaged[end] = '#';
  for (const std::string& text : {whole.substr(0, begin), whole.substr(0, end), damaged}) {
    testing::writeFile(folder_ / "out/r29.csv", "somebody's");
    testing::writeFile(journal, text);
    EXPECT_EQ(worksOf({.resume = true}), 0U);
    EXPECT_EQ(last_.status.skipped, 19U);
    EXPECT_EQ(last_.status.failed, 1U);
    EXPECT_EQ(testing::readFile(folder_ / "out/r29.csv"), "somebody's");
    // Nor by a second attempt.
    EXPECT_EQ(worksOf({.resume = true}), 0U);
    EXPECT_EQ(testing::readFile(folder_ / "out/r29.csv"), "somebody's");
  }
  worksOf({.overwrite = Overwrite::kReplace});
  EXPECT_EQ(testing::readFile(folder_ / "out/r29.csv"), "r29");
}

// What was about to be replaced is still known afterwards.
TEST_F(BatchRuns, AResultThatWasBeingMadeAgainIsMadeAgainAfterAKill) {
  worksOf({.threads = 1});
  const fs::path journal = folder_ / "out/.palpate_batch";
  testing::writeFile(folder_ / "in/r12.dsa", "longer");
  const std::string old = testing::readFile(folder_ / "out/r12.csv");
  const std::size_t before = testing::readFile(journal).size();
  EXPECT_EQ(worksOf({.threads = 1, .resume = true}), 1U);
  std::string text = testing::readFile(journal);
  text.resize(text.find('\n', before) + 1);  // only the line that says it was begun
  testing::writeFile(journal, text);
  // The new one has come, but no line: it isn't what was to be replaced.
  EXPECT_EQ(worksOf({.resume = true}), 0U);
  EXPECT_EQ(last_.status.failed, 1U);
  // Killed before it came.
  fs::remove(folder_ / "out/r12.csv");
  EXPECT_EQ(worksOf({.resume = true}), 1U);
  EXPECT_EQ(last_.status.failed, 0U);
  EXPECT_EQ(testing::readFile(folder_ / "out/r12.csv"), "longer");
  testing::writeFile(folder_ / "in/r12.dsa", "longer still");
  const std::size_t again = testing::readFile(journal).size();
  const auto changed = fs::last_write_time(folder_ / "out/r12.csv");
  EXPECT_EQ(worksOf({.threads = 1, .resume = true}), 1U);
  text = testing::readFile(journal);
  text.resize(text.find('\n', again) + 1);
  testing::writeFile(journal, text);
  testing::writeFile(folder_ / "out/r12.csv", "longer");
  fs::last_write_time(folder_ / "out/r12.csv", changed);
  EXPECT_EQ(worksOf({.resume = true}), 1U) << "the old result is still there";
  EXPECT_EQ(testing::readFile(folder_ / "out/r12.csv"), "longer still");
}

TEST_F(BatchRuns, GoesOnBehindAJournalThatEndsAnywhere) {
  worksOf({.threads = 1});
  const std::string journal = testing::readFile(folder_ / "out/.palpate_batch");
  for (const std::size_t length : {std::size_t{0}, journal.size() / 2, journal.size() - 1}) {
    fs::remove_all(folder_ / "out");
    worksOf({.threads = 1});
    const std::string whole = testing::readFile(folder_ / "out/.palpate_batch");
    // Killed here: the results whose lines are not whole are not there yet.
    const std::string cut = whole.substr(0, std::min(length, whole.size() - 1));
    testing::writeFile(folder_ / "out/.palpate_batch", cut);
    for (const BatchItem& item : plan_.items)
      if (!isTold(cut, item.target.filename().string())) fs::remove(item.target);
    worksOf({.resume = true});
    EXPECT_EQ(last_.status.failed, 0U) << length;
    EXPECT_EQ(last_.status.done + last_.status.skipped, 20U) << length;
    EXPECT_EQ(worksOf({.resume = true}), 0U) << length;
  }
}

TEST_F(BatchRuns, StopsWhenItIsCancelledAndKeepsWhatIsDone) {
  BatchTask task = copying();
  std::atomic<bool> begun = false;
  const auto copy = task.work;
  task.work =
      [&](const BatchItem& item, Overwrite overwrite, const Progress& progress, std::size_t n) {
        if (item.source.stem() != "r15") return copy(item, overwrite, progress, n);
        begun = true;
        for (;;) {
          if (!progress(0.5)) throw Cancelled();
          std::this_thread::yield();
        }
      };
  const BatchReport report =
      runBatch(plan_, task, {.threads = 2}, {}, [&](const BatchStatus&) { return !begun; });
  EXPECT_TRUE(report.cancelled);
  EXPECT_EQ(report.results[5].state, State::kNotDone);
  EXPECT_EQ(report.status.failed, 0U);
  EXPECT_FALSE(fs::exists(folder_ / "out/r15.csv"));
  EXPECT_EQ(testing::readFile(folder_ / "out/r10.csv"), "r10");
  worksOf({.resume = true});
  EXPECT_EQ(last_.status.done + last_.status.skipped, 20U);
  EXPECT_GE(last_.status.skipped, 5U);
}

TEST_F(BatchRuns, ASecondBatchIntoTheSameFolderIsRefused) {
  BatchTask task = copying();
  const auto copy = task.work;
  std::string refusal;
  task.work =
      [&](const BatchItem& item, Overwrite overwrite, const Progress& progress, std::size_t n) {
        if (item.source.stem() == "r10") {
          try {
            runBatch(plan_, copying());
          } catch (const FileError& error) {
            refusal = error.what();
          }
        }
        return copy(item, overwrite, progress, n);
      };
  EXPECT_EQ(runBatch(plan_, task).status.done, 20U);
  EXPECT_NE(refusal.find("another batch"), std::string::npos) << refusal;
}

TEST_F(BatchRuns, SaysWhenTheFolderCanNotBeMade) {
  testing::writeFile(folder_ / "out", "a file");
  EXPECT_THROW(runBatch(plan_, copying()), FileError);
  EXPECT_EQ(testing::readFile(folder_ / "out"), "a file");
}

TEST_F(BatchRuns, PassesOnWhatTheSinkThrows) {
  EXPECT_THROW(runBatch(plan_, copying(), {}, [](auto, const auto&) { throw Error("full"); }),
               Error);
}

TEST_F(BatchRuns, CountsWhatBecameOfThem) {
  testing::writeFile(folder_ / "in/r12.dsa", "bad");
  testing::writeFile(folder_ / "in/r13.dsa", "bad");
  worksOf({});
  const std::string text = summaryText(plan_, last_, 1);
  EXPECT_EQ(text.find("done              18\nskipped            0\nfailed             2\n  "), 0U)
      << text;
  EXPECT_NE(text.find("r12.dsa"), std::string::npos) << text;
  EXPECT_EQ(text.find("r13.dsa"), std::string::npos) << text;
  EXPECT_NE(text.find("and 1 more"), std::string::npos) << text;
  const TextTable table = reportTable(plan_, last_);
  ASSERT_EQ(table.numRows, 20U);
  EXPECT_EQ(table.row(3)[2], "failed");
  EXPECT_EQ(table.row(4)[2], "done");
}

TEST(StatusText, SaysHowFarItIs) {
  EXPECT_EQ(statusText({.total = 609, .done = 12, .failed = 3, .perSecond = 41.24}),
            "15 of 609, 3 failed, 41.2/s");
  EXPECT_EQ(statusText({.total = 9, .skipped = 2, .perSecond = 1.0, .remainingS = 13.2}),
            "2 of 9, 1.0/s, 14 s left");
  EXPECT_EQ(statusText({.total = 9, .perSecond = 0.0, .remainingS = 121.0}), "0 of 9, 3 min left");
}

}  // namespace
}  // namespace palpate::batch_run_test
