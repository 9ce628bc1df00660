// Lets tests wait until a condition holds in another thread or process, instead of waiting for a
// fixed time.
#pragma once

#include <chrono>
#include <thread>

namespace palpate::testing {

// Checks the condition every millisecond. Returns false when it does not hold within the limit,
// which is long enough that only a fault exceeds it.
template <typename Condition>
bool awaited(Condition&& condition, std::chrono::milliseconds limit = std::chrono::seconds(20)) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace palpate::testing
