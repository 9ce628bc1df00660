// The one QApplication, set up the same way for window, pictures and tests.
#pragma once

#include <QApplication>
#include <QSet>
#include <QString>
#include <atomic>
#include <cstddef>
#include <memory>

namespace palpate::gui {

// What is thrown while the window answers an event (no memory, a bug) costs that event, not the
// process: a hand may be moving, and its stop must be heard.
class GuardedApplication : public QApplication {
  Q_OBJECT
 public:
  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override;
  // How often something was thrown, since the start or since forgetFailures().
  std::size_t numFailures() const noexcept { return numFailures_; }
  void forgetFailures();

 signals:
  // One line for the user. Each text once, and of a few only: what fails may be a timer of 16 ms.
  void failed(const QString& message);

 private:
  void note(const char* what) noexcept;
  void showFailure(const QString& what);

  std::atomic<std::size_t> numFailures_ = 0;
  QSet<QString> reportedFailures_;
};

// Of the application that is there; 0 when it is none of ours.
std::size_t failuresAtEvents() noexcept;
void forgetFailuresAtEvents();

// Null when there is one already. Numbers stay the same in every locale.
std::unique_ptr<QApplication> makeApplication(int& argc, char** argv);

}  // namespace palpate::gui
