// Lets a command wait for Ctrl-C and similar signals (SIGINT, SIGTERM, SIGHUP), which would
// otherwise end the program.
#pragma once

#include <array>
#include <csignal>

namespace palpate {

// Handles SIGINT, SIGTERM and SIGHUP. At most one object may exist, and it must be created before
// the first thread. Signal handlers are used instead of blocked signals, because threads of
// libraries would receive the signal and end the program. Signals that were ignored at the start
// (nohup) stay ignored.
class Interruption {
 public:
  Interruption();
  // Restores the previous handling of the signals.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  // Waits at most `withinMs` [ms] for a signal; returns true once for each signal that arrived.
  bool waitForSignal(int withinMs);
  // A file descriptor that is readable when a signal has arrived, for loops that wait for several
  // events.
  int descriptor() const noexcept;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

}  // namespace palpate
