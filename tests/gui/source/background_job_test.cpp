#include "gui/source/background_job.h"

#include <QCoreApplication>
#include <QSignalSpy>
#include <latch>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include <palpate/core/error.h>

namespace palpate::gui::background_job_test {
namespace {

class BackgroundJobTest : public ::testing::Test {
 protected:
  BackgroundJob job_;
  QSignalSpy failed_{&job_, &BackgroundJob::failed};
  QSignalSpy cancelled_{&job_, &BackgroundJob::cancelled};
  QSignalSpy finished_{&job_, &BackgroundJob::finished};
};

TEST_F(BackgroundJobTest, JobsRunOneAfterTheOther) {
  QStringList done;
  for (const char* name : {"a", "b", "c"})
    job_.start(
        name, [](const Progress&) {}, [&done, name] { done << name; });
  job_.settle();
  EXPECT_EQ(done, (QStringList{"a", "b", "c"}));
  EXPECT_EQ(finished_.count(), 1);
}

TEST_F(BackgroundJobTest, AFailureIsReportedAndTheNextJobRuns) {
  bool isDone = false;
  job_.start(
      "a", [](const Progress&) { throw Error("the disk is full"); }, [] { FAIL(); });
  job_.start(
      "b", [](const Progress&) {}, [&] { isDone = true; });
  job_.settle();
  ASSERT_EQ(failed_.count(), 1);
  EXPECT_EQ(failed_.at(0).at(0).toString(), "the disk is full");
  EXPECT_TRUE(isDone);
}

TEST_F(BackgroundJobTest, CancelEndsTheRunningJobAndDropsThoseThatWait) {
  std::latch running(1);
  job_.start("a", [&](const Progress& progress) {
    running.count_down();
    while (progress(0.5)) std::this_thread::yield();
    throw Cancelled();
  });
  job_.start(
      "b", [](const Progress&) {}, [] { FAIL(); });
  running.wait();
  job_.cancel();
  job_.settle();
  ASSERT_EQ(cancelled_.count(), 1);
  EXPECT_EQ(cancelled_.at(0).at(0).toString(), "a");
  EXPECT_EQ(failed_.count(), 0);
}

// Who has asked something else meanwhile doesn't want to hear that the first answer failed
// (window F8).
TEST_F(BackgroundJobTest, AJobThatFailsAfterItWasCancelledIsCancelled) {
  std::latch running(1), end(1);
  bool isDone = false;
  job_.start("old", [&](const Progress&) {
    running.count_down();
    end.wait();
    throw Error("the old file is damaged");
  });
  running.wait();
  job_.cancel();
  job_.start(
      "new", [](const Progress&) {}, [&] { isDone = true; });
  end.count_down();
  job_.settle();
  EXPECT_EQ(failed_.count(), 0);
  EXPECT_EQ(cancelled_.count(), 1);
  EXPECT_TRUE(isDone);
}

// What it wrote is whole then, or was removed.
TEST_F(BackgroundJobTest, LeavingCancelsAndWaits) {
  std::latch running(1);
  bool isOver = false;
  {
    BackgroundJob left;
    left.start("a", [&](const Progress& progress) {
      running.count_down();
      while (progress(0.5)) std::this_thread::yield();
      isOver = true;
    });
    running.wait();
  }
  EXPECT_TRUE(isOver);
}

// Window F7.
TEST_F(BackgroundJobTest, WhereOnlyIsReadLeavingWaitsForNothing) {
  const auto end = std::make_shared<std::latch>(1);
  {
    BackgroundJob left(BackgroundJob::Leaving::kAtOnce);
    left.start(
        "a", [end](const Progress&) { end->wait(); }, [] { FAIL(); });
    left.start("b", [](const Progress&) { FAIL(); });
  }
  EXPECT_FALSE(Abandonable::awaitThreads(std::chrono::milliseconds(1))) << "it still hangs";
  end->count_down();
  EXPECT_TRUE(Abandonable::awaitThreads(std::chrono::seconds(20)));
  QCoreApplication::processEvents();
}

}  // namespace
}  // namespace palpate::gui::background_job_test
