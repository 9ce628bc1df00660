// Reports the progress of work that consists of steps.
#pragma once

#include <cstddef>

#include <palpate/core/error.h>
#include <palpate/core/progress.h>

namespace palpate {

// Call before step `step` (from 0) of `count`; reports every `every`th step. Throws Cancelled when
// the callback cancels the work.
inline void reportProgress(const Progress& progress,
                           std::size_t step,
                           std::size_t count,
                           std::size_t every = 1) {
  if (progress && step % every == 0 &&
      !progress(static_cast<double>(step) / static_cast<double>(count)))
    throw Cancelled();
}

}  // namespace palpate
