#include "gui/source/abandonable.h"

#include <QCoreApplication>
#include <QSignalSpy>
#include <latch>
#include <memory>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace palpate::gui::abandonable_test {
namespace {
using std::chrono_literals::operator""s;
using std::chrono_literals::operator""ms;

class AbandonableTest : public ::testing::Test {
 protected:
  ~AbandonableTest() override { EXPECT_TRUE(Abandonable::awaitThreads(20s)); }
  Abandonable::Failed failed() {
    return [this](const QString& message) { said_.append(message); };
  }
  Abandonable::Take says(const QString& what) {
    return [this, what] { said_.append(what); };
  }
  // Work that hangs until `end` is counted down, then answers.
  Abandonable::Work hangs(const std::shared_ptr<std::latch>& end, const QString& answer) {
    return [this, end, answer](const Abandonable::Asker&) {
      end->wait();
      return says(answer);
    };
  }

  std::unique_ptr<Abandonable> work_ = std::make_unique<Abandonable>();
  QStringList said_;
};

TEST_F(AbandonableTest, WhatIsToldBeforeTheAnswerComesBeforeIt) {
  QSignalSpy started(work_.get(), &Abandonable::started);
  QSignalSpy finished(work_.get(), &Abandonable::finished);
  work_->start(
      [this](const Abandonable::Asker& asker) {
        asker.tell(says("first"));
        asker.tell(says("second"));
        return says("answer");
      },
      failed());
  EXPECT_TRUE(said_.isEmpty()) << "never before the events are processed";
  work_->settle();
  EXPECT_EQ(said_, (QStringList{"first", "second", "answer"}));
  EXPECT_EQ(started.count(), 1);
  EXPECT_EQ(finished.count(), 1);
}

TEST_F(AbandonableTest, ProgressComesInStepsOfAHundredth) {
  QSignalSpy progressed(work_.get(), &Abandonable::progressed);
  work_->start(
      [](const Abandonable::Asker& asker) -> Abandonable::Take {
        for (int i = 0; i <= 100'000; ++i) EXPECT_TRUE(asker.progress(i / 100'000.0));
        return {};
      },
      failed());
  work_->settle();
  EXPECT_GE(progressed.count(), 99);
  EXPECT_LE(progressed.count(), 101);
}

TEST_F(AbandonableTest, AbandonedItHearsItAndNothingIsHeardOfIt) {
  std::latch running(1);
  bool isWanted = true;
  work_->start(
      [&](const Abandonable::Asker& asker) -> Abandonable::Take {
        running.count_down();
        while (asker.progress(0.5)) std::this_thread::yield();
        isWanted = false;
        asker.tell(says("told"));
        throw std::runtime_error("the old file is damaged");
      },
      failed());
  running.wait();
  work_->abandon();
  EXPECT_FALSE(work_->busy());
  ASSERT_TRUE(Abandonable::awaitThreads(20s));
  QCoreApplication::processEvents();
  EXPECT_FALSE(isWanted);
  EXPECT_TRUE(said_.isEmpty());
}

TEST_F(AbandonableTest, AReplacedOneThatEndsLaterIsNotHeard) {
  const auto end = std::make_shared<std::latch>(1);
  QSignalSpy finished(work_.get(), &Abandonable::finished);
  work_->start(hangs(end, "old"), failed());
  work_->start([this](const auto&) { return says("new"); }, failed());
  work_->settle();
  end->count_down();
  ASSERT_TRUE(Abandonable::awaitThreads(20s));
  QCoreApplication::processEvents();
  EXPECT_EQ(said_, QStringList("new"));
  EXPECT_EQ(finished.count(), 1);
}

TEST_F(AbandonableTest, LeavingWaitsForNothing) {
  const auto end = std::make_shared<std::latch>(1);
  work_->start(hangs(end, "old"), failed());
  work_.reset();
  EXPECT_FALSE(Abandonable::awaitThreads(1ms)) << "it still hangs";
  end->count_down();
  ASSERT_TRUE(Abandonable::awaitThreads(20s));
  QCoreApplication::processEvents();
  EXPECT_TRUE(said_.isEmpty());
}

TEST_F(AbandonableTest, StoppedItStillAnswers) {
  std::latch running(1);
  work_->start(
      [&](const Abandonable::Asker& asker) {
        running.count_down();
        while (asker.progress(0.5)) std::this_thread::yield();
        return says("ended");
      },
      failed());
  running.wait();
  work_->stop();
  work_->join();
  EXPECT_TRUE(said_.isEmpty());
  work_->settle();
  EXPECT_EQ(said_, QStringList("ended"));
}

TEST_F(AbandonableTest, AnAnswerMayDestroyIt) {
  work_->start([this](const auto&) { return [this] { work_.reset(); }; }, failed());
  while (work_) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

TEST_F(AbandonableTest, WhatNobodyAsksForIsCountedToo) {
  std::latch end(1);
  EXPECT_TRUE(Abandonable::run([&] { end.wait(); }));
  EXPECT_FALSE(Abandonable::awaitThreads(1ms));
  end.count_down();
  // The thread uses `end` until it has woken.
  EXPECT_TRUE(Abandonable::awaitThreads(20s));
}

}  // namespace
}  // namespace palpate::gui::abandonable_test
