#include "gui/source/file_reading.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QPointer>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace palpate::gui {

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
  std::thread([question, work = std::move(work), failed = std::move(failed)] {
    Take take;
    try {
      take = work();
    } catch (const std::exception& error) {
      take = [failed, message = QString::fromUtf8(error.what())] { failed(message); };
    }
    const std::lock_guard<std::mutex> guard(question->mutex);
    if (FileReading* asker = question->asker)
      QMetaObject::invokeMethod(
          asker,
          [asker, question, take = std::move(take)] { asker->answer(question, take); },
          Qt::QueuedConnection);
  }).detach();
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

}  // namespace palpate::gui
