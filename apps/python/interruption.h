// Long work without Python's lock: other Python threads go on, and Ctrl-C ends it with
// KeyboardInterrupt.
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
  // Looks for Ctrl-C now and then; may be called from any thread that doesn't hold Python's lock.
  Progress progress();
  // Throws what came, if something did. Takes Python's lock to be held.
  void rethrow();

 private:
  std::atomic<std::int64_t> nextUs_ = 0;
  std::optional<pybind11::error_already_set> came_;
};

// What `work(progress)` returns, done without Python's lock: it must touch no Python object.
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
