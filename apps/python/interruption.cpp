#include "python/interruption.h"

#include "palpate/core/time.h"

namespace palpate::python {
namespace {

constexpr std::int64_t kLookEveryUs = 50'000;

}  // namespace

Progress Interruptions::progress() {
  return [this](double) {
    const std::int64_t nowUs = systemClock().monotonicUs();
    if (nowUs < nextUs_.load(std::memory_order_relaxed)) return true;
    nextUs_.store(nowUs + kLookEveryUs, std::memory_order_relaxed);
    const pybind11::gil_scoped_acquire locked;
    if (came_) return false;
    if (PyErr_CheckSignals() == 0) return true;  // only the main thread sees signals
    came_.emplace();
    return false;
  };
}

void Interruptions::rethrow() {
  if (came_) throw pybind11::error_already_set(*came_);
}

}  // namespace palpate::python
