#include "gui/source/file_reading.h"

#include <QSignalSpy>
#include <QThread>
#include <future>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "gui/testing/held_readings.h"

namespace palpate::gui::file_reading_test {
namespace {

class FileReadingTest : public ::testing::Test {
 protected:
  FileReading::Failed failed() {
    return [this](const QString& message) { said_.append(message); };
  }
  FileReading::Work reads(const QString& what) {
    return [this, what] { return [this, what] { said_.append(what); }; };
  }

  FileReading reading_;
  QStringList said_;
};

TEST_F(FileReadingTest, TheWorkRunsElsewhereAndTheAnswerComesHere) {
  QThread *worker = nullptr, *taker = nullptr;
  reading_.start(
      [&] {
        worker = QThread::currentThread();
        return [&] { taker = QThread::currentThread(); };
      },
      failed());
  EXPECT_TRUE(reading_.busy());
  EXPECT_EQ(taker, nullptr) << "never before the events are processed";
  reading_.settle();
  EXPECT_NE(worker, QThread::currentThread());
  EXPECT_EQ(taker, QThread::currentThread());
  EXPECT_FALSE(reading_.busy());
}

TEST_F(FileReadingTest, AFailureIsSaid) {
  QSignalSpy finished(&reading_, &FileReading::finished);
  reading_.start([]() -> FileReading::Take { throw std::runtime_error("a.csv: can't be opened"); },
                 failed());
  reading_.settle();
  EXPECT_EQ(said_, QStringList("a.csv: can't be opened"));
  EXPECT_EQ(finished.count(), 1);
}

TEST_F(FileReadingTest, AReplacedQuestionIsNeverAnswered) {
  HeldReadings held(1);
  reading_.start(reads("old"), failed());
  held.await(1);
  reading_.start(reads("new"), failed());
  reading_.settle();
  held.release();
  QCoreApplication::processEvents();
  EXPECT_EQ(said_, QStringList("new"));
}

TEST_F(FileReadingTest, AnAnswerThatIsUnderWayWhileItsQuestionIsReplacedIsDropped) {
  std::promise<void> read;
  reading_.start(
      [&] {
        read.set_value();
        return [this] { said_.append("old"); };
      },
      failed());
  read.get_future().wait();
  reading_.start(reads("new"), failed());
  reading_.settle();
  EXPECT_EQ(said_, QStringList("new"));
}

TEST_F(FileReadingTest, LeavingDoesNotWaitForAFileThatDoesNotAnswer) {
  HeldReadings held;
  {
    FileReading left;
    left.start(reads("old"), failed());
    held.await(1);
  }
  held.release();
  QCoreApplication::processEvents();
  EXPECT_TRUE(said_.isEmpty());
}

TEST_F(FileReadingTest, AbandonedItIsNotBusy) {
  HeldReadings held;
  reading_.start(reads("old"), failed());
  QSignalSpy finished(&reading_, &FileReading::finished);
  reading_.abandon();
  EXPECT_FALSE(reading_.busy());
  EXPECT_EQ(finished.count(), 1);
}

TEST_F(FileReadingTest, AllAreAwaitedAlsoWhenAnAnswerDestroysAnother) {
  QObject root;
  auto* first = new FileReading(&root);
  auto* second = new FileReading(&root);
  HeldReadings held(1);
  second->start(reads("second"), failed());
  held.await(1);
  first->start([&] { return [&] { delete second; }; }, failed());
  FileReading::settleAll(root);
  EXPECT_FALSE(first->busy());
  EXPECT_TRUE(said_.isEmpty());
}

TEST_F(FileReadingTest, TheEndOfTheProgramSeesThatAThreadStillReads) {
  HeldReadings held;
  reading_.start(reads("old"), failed());
  reading_.abandon();
  EXPECT_FALSE(FileReading::awaitThreads(std::chrono::milliseconds(1)));
  held.release();
  EXPECT_TRUE(FileReading::awaitThreads(std::chrono::seconds(20)));
}

TEST_F(FileReadingTest, MoreReadingsThanThereMayBeAreRefused) {
  HeldReadings held;
  std::vector<std::unique_ptr<FileReading>> all;
  for (int i = 0; i < 256; ++i) {
    all.push_back(std::make_unique<FileReading>());
    all.back()->start(reads("read"), failed());
  }
  reading_.start(reads("read"), failed());
  EXPECT_TRUE(said_.isEmpty()) << "not before the events are processed";
  reading_.settle();
  ASSERT_EQ(said_.size(), 1);
  EXPECT_TRUE(said_[0].startsWith("nothing is read: too many files"));
}

}  // namespace
}  // namespace palpate::gui::file_reading_test
