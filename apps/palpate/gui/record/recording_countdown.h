// Counts seconds down before a recording begins.
#pragma once

#include <QObject>
#include <QTimer>
#include <functional>

namespace palpate::gui {

class RecordingCountdown : public QObject {
  Q_OBJECT
 public:
  explicit RecordingCountdown(QObject* parent = nullptr);

  // `begin` is called after `seconds` (1 or more), unless the countdown is cancelled before. An
  // earlier countdown is cancelled.
  void start(int seconds, std::function<void()> begin);
  // Returns whether there was anything to cancel.
  bool cancel();
  bool running() const noexcept { return leftS_ > 0; }
  // Seconds left; 0: no countdown runs.
  int leftS() const noexcept { return leftS_; }

  // Called by the timer each second; public for tests.
  void tick();

 signals:
  // Emitted before changed(); `begin` isn't called any more.
  void cancelled();
  // leftS() has changed: a second has passed, or the countdown begins, ends or is cancelled.
  void changed();

 private:
  QTimer timer_;
  int leftS_ = 0;
  std::function<void()> begin_;
};

}  // namespace palpate::gui
