// Ctrl-C and its kin (SIGINT, SIGTERM, SIGHUP) as something to wait for, instead of the end of the
// program.
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
  ~Interruption();  // the signals do again what they did before
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  // Waits at most `withinMs` [ms] for a signal; returns true once for each signal that arrived.
  bool waitForSignal(int withinMs);
  // Can be read when one came: for a loop that waits for more than this.
  int descriptor() const noexcept;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

}  // namespace palpate
