// Creates the QApplication with the same settings for the window, for pictures of the command line,
// and for tests.
#pragma once

#include <QApplication>
#include <QSet>
#include <QString>
#include <atomic>
#include <cstddef>
#include <memory>

namespace palpate::gui {

// Catches exceptions thrown while an event is handled (no memory, a bug), so that only that event
// is lost and not the process: a hand may be moving, and Stop must still work.
class GuardedApplication : public QApplication {
  Q_OBJECT
 public:
  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override;
  // Number of exceptions since the start or since forgetFailures().
  std::size_t numFailures() const noexcept { return numFailures_; }
  void forgetFailures();

 signals:
  // One line for the user. Every text is emitted only once, and only a few texts at all: the
  // failing event may come from a timer of 16 ms.
  void failed(const QString& message);

 private:
  void note(const char* what) noexcept;
  void showFailure(const QString& what);

  std::atomic<std::size_t> numFailures_ = 0;
  QSet<QString> reportedFailures_;
};

// Number of failures of the present application; 0 when it isn't a GuardedApplication.
std::size_t failuresAtEvents() noexcept;
void forgetFailuresAtEvents();

// Creates the application; null when there is one already. Numbers are written the same way in
// every locale.
std::unique_ptr<QApplication> makeApplication(int& argc, char** argv);

}  // namespace palpate::gui
