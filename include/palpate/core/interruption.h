// Ctrl-C and its kin (SIGINT, SIGTERM, SIGHUP) as something to wait for, instead of the end of the program.
#pragma once

#include <array>
#include <csignal>

namespace palpate {

// One at a time, from before the first thread of ours until its end. A handler, not a blocked signal: libraries
// have threads of their own, which would take it, and the program would be killed. What was ignored when we were
// started (nohup) stays so.
class Interruption {
 public:
  Interruption();
  ~Interruption();  // the signals do again what they did before
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  // Waits so long at most; whether one came, once for each call that says so.
  bool came(int withinMs);
  // Can be read when one came: for a loop that waits for more than this.
  int descriptor() const noexcept;

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

}  // namespace palpate
