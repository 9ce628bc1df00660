// Runs long work without Python's global lock, so that other Python threads continue and Ctrl-C
// ends the work with KeyboardInterrupt.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include <pybind11/pybind11.h>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"

namespace palpate::python {

class Interruptions {
 public:
  // Checks for Ctrl-C from time to time; may be called from any thread that does not hold the lock.
  Progress progress();
  // Throws the stored Python exception, if there is one. The caller holds the lock.
  void rethrow();

 private:
  std::atomic<std::int64_t> nextUs_ = 0;
  std::optional<pybind11::error_already_set> came_;
};

// Runs `work(progress)` without the lock and returns its result; `work` must not use Python
// objects.
template <typename Work>
auto unlocked(const Work& work) {
  Interruptions interruptions;
  try {
    const pybind11::gil_scoped_release released;
    return work(interruptions.progress());
  } catch (const Cancelled&) {
    interruptions.rethrow();
    throw;
  }
}

}  // namespace palpate::python
