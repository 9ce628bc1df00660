#include "gui/source/file_reading.h"

#include <QSignalSpy>
#include <QThread>
#include <future>
#include <stdexcept>

#include <gtest/gtest.h>

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

// A file that doesn't answer, as one of a dead network folder.
class DeadFile {
 public:
  ~DeadFile() {
    end();
    ended_.get_future().wait();
  }
  FileReading::Work read(std::function<void()> taken) {
    return [this, gate = gate_.get_future().share(), taken] {
      gate.wait();
      ended_.set_value();
      return taken;
    };
  }
  void end() {
    if (!std::exchange(open_, true)) gate_.set_value();
  }

 private:
  std::promise<void> gate_, ended_;
  bool open_ = false;
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
  DeadFile dead;
  reading_.start(dead.read([this] { said_.append("old"); }), failed());
  reading_.start(reads("new"), failed());
  reading_.settle();
  dead.end();
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
  DeadFile dead;
  {
    FileReading left;
    left.start(dead.read([this] { said_.append("old"); }), failed());
  }
  dead.end();
  QCoreApplication::processEvents();
  EXPECT_TRUE(said_.isEmpty());
}

TEST_F(FileReadingTest, AbandonedItIsNotBusy) {
  DeadFile dead;
  reading_.start(dead.read([] {}), failed());
  QSignalSpy finished(&reading_, &FileReading::finished);
  reading_.abandon();
  EXPECT_FALSE(reading_.busy());
  EXPECT_EQ(finished.count(), 1);
}

}  // namespace
}  // namespace palpate::gui::file_reading_test
