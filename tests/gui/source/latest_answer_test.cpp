#include "gui/source/latest_answer.h"

#include <QCoreApplication>
#include <QSignalSpy>
#include <atomic>
#include <latch>
#include <thread>

#include <gtest/gtest.h>

namespace palpate::gui::latest_answer_test {
namespace {
using std::chrono_literals::operator""s;

// Questions are names: "old..." runs until it is cancelled, or `end_` is counted down.
class LatestAnswerTest : public ::testing::Test {
 protected:
  using Words = LatestAnswer<QString, QString>;

  ~LatestAnswerTest() override {
    release();
    work_.reset();
    EXPECT_TRUE(Abandonable::awaitThreads(20s));
  }
  void release() {
    if (!released_) end_.count_down();
    released_ = true;
  }
  // Hangs for the old question, whatever its progress says.
  void hang() {
    running_.count_down();
    end_.wait();
  }

  std::latch running_{1}, end_{1};
  bool released_ = false;
  std::atomic<int> atOnce_ = 0, most_ = 0;
  QStringList said_;
  std::function<QString(const QString&, const Progress&, const Words::Tell&)> answers_ =
      [](const QString& question, const Progress&, const Words::Tell&) {
        return "answer to " + question;
      };
  std::unique_ptr<Words> work_ = std::make_unique<Words>(
      [this](const QString& question, const Progress& progress, const Words::Tell& tell) {
        most_ = std::max(most_.load(), ++atOnce_);
        struct Leave {
          std::atomic<int>& count;
          ~Leave() { --count; }
        } leave{atOnce_};
        return answers_(question, progress, tell);
      },
      [this](const QString& answer) { said_.append(answer); },
      [this](const QString& why) { said_.append("failed: " + why); });
};

TEST_F(LatestAnswerTest, TellsWhatIsKnownAndThenAnswers) {
  answers_ = [](const QString&, const Progress&, const Words::Tell& tell) {
    tell("a part");
    return QString("all");
  };
  work_->ask("new");
  EXPECT_TRUE(work_->busy());
  work_->settle();
  EXPECT_EQ(said_, (QStringList{"a part", "all"}));
  EXPECT_FALSE(work_->busy());
}

TEST_F(LatestAnswerTest, AFailureOfTheNewestIsSaid) {
  answers_ = [](const QString&, const Progress&, const Words::Tell&) -> QString {
    throw Error("the file is damaged");
  };
  work_->ask("new");
  work_->settle();
  EXPECT_EQ(said_, QStringList("failed: the file is damaged"));
}

TEST_F(LatestAnswerTest, ANewQuestionCancelsTheRunningOne) {
  answers_ = [this](const QString& question, const Progress& progress, const Words::Tell& tell) {
    if (question != "old") return "answer to " + question;
    running_.count_down();
    while (progress(0.5)) std::this_thread::yield();
    tell("a part of the old");
    throw Cancelled();
  };
  QSignalSpy started(work_.get(), &Words::started);
  QSignalSpy finished(work_.get(), &Words::finished);
  work_->ask("old");
  running_.wait();
  work_->ask("new");
  work_->settle();
  EXPECT_EQ(said_, QStringList("answer to new"));
  EXPECT_EQ(started.count(), 1) << "it was busy all the time";
  EXPECT_EQ(finished.count(), 1);
}

TEST_F(LatestAnswerTest, AFailureOfAnOlderOneSaysNothing) {
  answers_ = [this](const QString& question, const Progress&, const Words::Tell&) -> QString {
    if (question != "old") return "answer to " + question;
    hang();
    throw Error("the old file is damaged");
  };
  work_->ask("old");
  running_.wait();
  work_->ask("new");
  release();
  work_->settle();
  EXPECT_EQ(said_, QStringList("answer to new"));
}

TEST_F(LatestAnswerTest, OneIsWorkedOnAtATimeAndThoseBetweenNever) {
  QStringList begun;
  answers_ = [&](const QString& question, const Progress&, const Words::Tell&) {
    begun.append(question);
    if (question == "old") hang();
    return "answer to " + question;
  };
  work_->ask("old");
  running_.wait();
  for (const char* question : {"1", "2", "3", "new"}) work_->ask(question);
  release();
  work_->settle();
  ASSERT_TRUE(Abandonable::awaitThreads(20s));
  EXPECT_EQ(said_, QStringList("answer to new"));
  EXPECT_EQ(begun, (QStringList{"old", "new"}));
  EXPECT_EQ(most_, 1);
}

TEST_F(LatestAnswerTest, WhereNothingIsKeptANewQuestionWaitsForNoneThatHangs) {
  const auto end = std::make_shared<std::latch>(1);
  const auto hangs = std::make_shared<std::atomic<bool>>(false);
  Words work(
      [end, hangs](const QString& question, const Progress&, const Words::Tell&) {
        if (question == "dead folder") *hangs = true, end->wait();
        return question;
      },
      [this](const QString& answer) { said_ << answer; },
      [](const QString&) { FAIL(); },
      nullptr,
      Words::Turns::kAtOnce);
  work.ask("dead folder");
  while (!*hangs) std::this_thread::yield();
  work.ask("another");
  work.settle();
  EXPECT_EQ(said_, QStringList("another"));
  end->count_down();
  ASSERT_TRUE(Abandonable::awaitThreads(20s));
  QCoreApplication::processEvents();
  EXPECT_EQ(said_, QStringList("another")) << "the answer for the dead folder comes too late";
}

TEST_F(LatestAnswerTest, LeavingDoesNotWaitForWorkThatHangs) {
  answers_ = [this](const QString&, const Progress&, const Words::Tell&) {
    hang();
    return QString("old");
  };
  work_->ask("old");
  running_.wait();
  work_.reset();
  EXPECT_FALSE(Abandonable::awaitThreads(std::chrono::milliseconds(1)));
  release();
  ASSERT_TRUE(Abandonable::awaitThreads(20s));
  QCoreApplication::processEvents();
  EXPECT_TRUE(said_.isEmpty());
}

}  // namespace
}  // namespace palpate::gui::latest_answer_test
