// One callback for the progress of long work and for its cancellation.
#pragma once

#include <cstddef>
#include <functional>

#include <palpate/core/error.h>

namespace palpate {

// Called from time to time from the working thread with the fraction done, 0..1 (best estimate).
// Return false to cancel the work: it soon throws Cancelled and leaves no incomplete results.
using Progress = std::function<bool(double fraction)>;

// The progress of a part of some work, from..to of the whole. It may be kept longer than
// `progress`.
inline Progress partOf(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [progress, from, to](double fraction) { return progress(from + (to - from) * fraction); };
}

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
