// Ctrl-C, a closed terminal, a machine that is shut down: the window hears of it and ends as if it was closed, so
// that a hand that moves is stopped and a recording finished.
#pragma once

#include <QObject>
#include <array>
#include <csignal>

class QSocketNotifier;

namespace palpate::gui {

// One at a time. Signals that are ignored stay ignored; what was there before comes back at the end.
class Termination : public QObject {
  Q_OBJECT
 public:
  explicit Termination(QObject* parent = nullptr);
  ~Termination() override;

 signals:
  void asked();  // SIGINT, SIGTERM, SIGHUP; in the thread of this object

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
  QSocketNotifier* notifier_;
};

}  // namespace palpate::gui
