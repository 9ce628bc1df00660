// When the machine stood still: the proof that a late answer was late for no reason of ours.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace palpate::testing {

// For what must happen at a certain moment [CLOCK_MONOTONIC, us].
void sleepUntilUs(std::int64_t monotonicUs);

// Times of wake-ups that were late. All times are those of CLOCK_MONOTONIC [us], as systemClock().monotonicUs().
class LateWakeUps {
 public:
  // A thread wanted to wake at `dueUs` and woke at `wokeUs`; meanwhile its own process, all threads together, computed
  // for `ownWorkUs`. What the process itself computed is not held against the machine.
  void note(std::int64_t dueUs, std::int64_t wokeUs, std::int64_t ownWorkUs);
  // How much of this stretch of time the machine stood still.
  std::int64_t standstillUs(std::int64_t beginUs, std::int64_t endUs) const;

 private:
  struct Standstill {
    std::int64_t beginUs, endUs;
    std::int64_t lengthUs;  // without the process's own work
  };
  std::vector<Standstill> standstills_;  // in the order of time
};

// A thread that wakes every millisecond, at the same priority as all others, and notes when it could not.
class Heartbeat {
 public:
  Heartbeat();
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;
  // Waits for the first wake-up after `endUs`.
  std::int64_t standstillUs(std::int64_t beginUs, std::int64_t endUs);

 private:
  void beat();

  std::mutex mutex_;
  std::condition_variable beaten_;
  LateWakeUps late_;
  std::int64_t lastUs_ = 0;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace palpate::testing
