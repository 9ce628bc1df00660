// Checks without waiting whether the hand has answered a command. Private to this module.
#pragma once

#include <chrono>
#include <future>

namespace palpate {

// `answer` is a std::future or std::shared_future.
template <typename Future>
bool isReady(const Future& answer) {
  return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace palpate
