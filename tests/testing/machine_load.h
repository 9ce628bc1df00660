// How long this machine withholds the processor: what a limit in milliseconds must be given on top, where tests of
// others run beside.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "palpate/core/time.h"

namespace palpate::testing {

// A thread that wants to wake every millisecond, and notes when it did.
class MachineLoad {
 public:
  MachineLoad()
      : thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            const std::int64_t fromUs = systemClock().monotonicUs();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            const std::int64_t toUs = systemClock().monotonicUs();
            if (toUs - fromUs < 2'000) continue;
            const std::lock_guard lock(mutex_);
            late_.push_back({fromUs, toUs});
          }
        }) {}

  // The longest it overslept at a time that touches this span [monotonic us]. A thread that is kept waiting
  // may be kept waiting more than once: the sum.
  std::int64_t withheldUs(std::int64_t fromUs, std::int64_t toUs) {
    const std::lock_guard lock(mutex_);
    std::int64_t sum = 0;
    for (const Late& late : late_)
      if (late.fromUs <= toUs && late.toUs >= fromUs) sum += late.toUs - late.fromUs - 1'000;
    return sum;
  }

 private:
  struct Late {
    std::int64_t fromUs = 0, toUs = 0;
  };
  std::mutex mutex_;
  std::vector<Late> late_;
  std::jthread thread_;
};

}  // namespace palpate::testing
