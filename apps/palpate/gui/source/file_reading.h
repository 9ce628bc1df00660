// Reads a file that the user named, and what it holds, in a thread that nobody waits for: the
// window stays awake while the file is large, and can be left while a network folder or a device
// doesn't answer.
#pragma once

#include <QObject>
#include <QString>
#include <chrono>
#include <functional>
#include <memory>

namespace palpate::gui {

class FileReading : public QObject {
  Q_OBJECT
 public:
  // Takes over what was read; called in the thread of this object.
  using Take = std::function<void()>;
  // Runs in a thread of its own, perhaps longer than this object lives: it must use nothing but
  // what it holds itself.
  using Work = std::function<Take()>;
  using Failed = std::function<void(const QString& message)>;

  explicit FileReading(QObject* parent = nullptr) : QObject(parent) {}
  // Waits for nothing; no answer comes any more.
  ~FileReading() override;

  // Starts to read in place of what is being read; the answer to that never comes. Either the Take
  // that `work` returns is called, or `failed` with the message of its exception, or of why it
  // can't be begun; neither before start() returns.
  void start(Work work, Failed failed);
  void abandon();
  bool busy() const noexcept { return question_ != nullptr; }
  // Wait for the answer, or for all answers of readings below `root`, with events.
  void settle();
  static void settleAll(const QObject& root);

  // Waits until all threads that read have ended, at most so long; returns whether they have. Call
  // it at the end of the program: what they use mustn't be destroyed under them.
  static bool awaitThreads(std::chrono::milliseconds longest);
  // Is called in the thread before each work; for tests, which hold it there. Null: nothing is.
  static void setGate(std::function<void()> gate);

 signals:
  // The answer came, or nobody waits for it any more.
  void finished();

 private:
  struct Question;
  void answer(const std::shared_ptr<Question>& question, const Take& take);

  std::shared_ptr<Question> question_;
};

}  // namespace palpate::gui
