// Waiting for what other threads or processes do: for the condition, never for a time.
#pragma once

#include <chrono>
#include <thread>

namespace palpate::testing {

// Looks every millisecond. False: not within the limit, so long that nothing but a fault lasts
// longer.
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
