#include "gui/source/file_reading.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QPointer>
#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace palpate::gui {
namespace {

// More at once means that their files don't answer.
constexpr std::size_t kMaxReadings = 256;

struct ReadingThreads {
  std::mutex mutex;
  std::condition_variable ended;
  std::size_t running = 0;
  std::function<void()> gate;
};

// Never destroyed: threads may run longer than the statics live.
ReadingThreads& readingThreads() {
  static auto* const all = new ReadingThreads;
  return *all;
}

class CountedThread {
 public:
  ~CountedThread() {
    ReadingThreads& all = readingThreads();
    const std::lock_guard guard(all.mutex);
    --all.running;
    all.ended.notify_all();
  }
  // Null: there are as many as there may be.
  static std::shared_ptr<CountedThread> begin() {
    ReadingThreads& all = readingThreads();
    const std::lock_guard guard(all.mutex);
    if (all.running >= kMaxReadings) return nullptr;
    ++all.running;
    return std::shared_ptr<CountedThread>(new CountedThread);
  }

 private:
  CountedThread() = default;
};

void passGate() {
  std::function<void()> gate;
  {
    const std::lock_guard guard(readingThreads().mutex);
    gate = readingThreads().gate;
  }
  if (gate) gate();
}

}  // namespace

struct FileReading::Question {
  std::mutex mutex;
  FileReading* asker;  // null: nobody waits for the answer any more
};

FileReading::~FileReading() {
  blockSignals(true);
  abandon();
}

void FileReading::start(Work work, Failed failed) {
  abandon();
  auto question = std::make_shared<Question>();
  question->asker = this;
  question_ = question;
  const auto answerWith = [question](const Take& take) {
    const std::lock_guard<std::mutex> guard(question->mutex);
    if (FileReading* asker = question->asker)
      QMetaObject::invokeMethod(
          asker, [asker, question, take] { asker->answer(question, take); }, Qt::QueuedConnection);
  };
  const auto refuse = [&](const QString& why) { answerWith([failed, why] { failed(why); }); };
  auto counted = CountedThread::begin();
  if (!counted) return refuse("nothing is read: too many files that don't answer are being read");
  try {
    std::thread([counted, answerWith, work, failed]() mutable {
      Take take;
      try {
        passGate();
        take = work();
      } catch (const std::exception& error) {
        take = [failed, message = QString::fromUtf8(error.what())] { failed(message); };
      }
      work = {};
      answerWith(take);
      take = {};
      failed = {};
      counted.reset();
    }).detach();
  } catch (const std::system_error& error) {
    refuse(QString("nothing is read: no thread can be made: ") + error.what());
  }
}

void FileReading::answer(const std::shared_ptr<Question>& question, const Take& take) {
  if (question != question_) return;
  question_.reset();
  // What takes it may destroy this object.
  const QPointer<FileReading> self(this);
  take();
  if (self) emit finished();
}

void FileReading::abandon() {
  if (!question_) return;
  {
    const std::lock_guard<std::mutex> guard(question_->mutex);
    question_->asker = nullptr;
  }
  question_.reset();
  emit finished();
}

void FileReading::settle() {
  const QPointer<FileReading> self(this);
  while (self && busy()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

void FileReading::settleAll(const QObject& root) {
  // An answer may destroy other readings: they are looked for anew after each.
  for (;;) {
    const auto all = root.findChildren<FileReading*>();
    const auto busy = std::find_if(
        all.begin(), all.end(), [](const FileReading* reading) { return reading->busy(); });
    if (busy == all.end()) return;
    (*busy)->settle();
  }
}

bool FileReading::awaitThreads(std::chrono::milliseconds longest) {
  ReadingThreads& all = readingThreads();
  std::unique_lock guard(all.mutex);
  return all.ended.wait_for(guard, longest, [&] { return all.running == 0; });
}

void FileReading::setGate(std::function<void()> gate) {
  const std::lock_guard guard(readingThreads().mutex);
  readingThreads().gate = std::move(gate);
}

}  // namespace palpate::gui
