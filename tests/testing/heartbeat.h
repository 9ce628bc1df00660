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

// Times of wake-ups that were late, of threads on several cores. All times are those of
// CLOCK_MONOTONIC [us], as systemClock().monotonicUs().
class LateWakeUps {
 public:
  // A thread wanted to wake at `dueUs` and woke at `wokeUs`; meanwhile its own process, all threads
  // together, computed for `ownWorkUs`. What the process itself computed is not held against the
  // machine.
  void note(std::int64_t dueUs, std::int64_t wokeUs, std::int64_t ownWorkUs);
  // How much of this stretch of time a core stood still: what was so on several cores at once
  // counts once.
  std::int64_t standstillUs(std::int64_t beginUs, std::int64_t endUs) const;

 private:
  struct Standstill {
    std::int64_t beginUs, endUs;
  };
  std::vector<Standstill> standstills_;
};

// On each core a thread that wants to wake every millisecond, at the same priority as all others,
// and notes when it could not. A thread that is free to go elsewhere would only notice when all
// cores stand still; what is tested is a chain of threads that needs each of its links.
class Heartbeat {
 public:
  // Returns when each core's thread has woken once.
  Heartbeat();
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;
  // Waits for the first wake-up of each core after `endUs`.
  std::int64_t standstillUs(std::int64_t beginUs, std::int64_t endUs);

 private:
  void beat(std::size_t at, int core);

  std::mutex mutex_;
  std::condition_variable beaten_;
  LateWakeUps late_;
  std::vector<std::int64_t> lastUs_;  // by thread
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace palpate::testing
