// Reads a file that the user named, and what it holds, in a thread that nobody waits for: the
// window stays awake while the file is large, and can be left while a network folder or a device
// doesn't answer.
#pragma once

#include <QObject>
#include <QString>
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
  // that `work` returns is called, or `failed` with the message of its exception.
  void start(Work work, Failed failed);
  void abandon();
  bool busy() const noexcept { return question_ != nullptr; }
  // Waits for the answer, with events; for tests.
  void settle();

 signals:
  // The answer came, or nobody waits for it any more.
  void finished();

 private:
  struct Question;
  void answer(const std::shared_ptr<Question>& question, const Take& take);

  std::shared_ptr<Question> question_;
};

}  // namespace palpate::gui
