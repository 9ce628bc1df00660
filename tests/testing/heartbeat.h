// Measures when the machine stood still, so that a test can show that a late answer was not caused
// by the program.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace palpate::testing {

// Sleeps until that moment of CLOCK_MONOTONIC [us].
void sleepUntilUs(std::int64_t monotonicUs);

// Collects late wake-ups of threads on several cores. All times are those of CLOCK_MONOTONIC [us],
// as systemClock().monotonicUs().
class LateWakeUps {
 public:
  // A thread was due to wake at `dueUs` and woke at `wokeUs`; in that time all threads of its
  // process together computed for `ownWorkUs`, which does not count as a standstill of the machine.
  void note(std::int64_t dueUs, std::int64_t wokeUs, std::int64_t ownWorkUs);
  // How long at least one core stood still between two times; overlapping standstills of several
  // cores count once.
  std::int64_t standstillUs(std::int64_t beginUs, std::int64_t endUs) const;

 private:
  struct Standstill {
    std::int64_t beginUs, endUs;
  };
  std::vector<Standstill> standstills_;
};

// Runs one thread on each core that wakes every millisecond, at normal priority, and records late
// wake-ups. Each thread is bound to its core: an unbound one would move to another core and notice
// only a standstill of all cores, while the tested chains of threads need every core that one of
// their threads runs on.
class Heartbeat {
 public:
  // Returns when the thread of each core has woken once.
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
  // The last wake-up of each thread.
  std::vector<std::int64_t> lastUs_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace palpate::testing
