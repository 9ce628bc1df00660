// Runs independent pieces of work on several threads. The result does not depend on the number of
// threads if each piece writes only its own data.
#pragma once

#include <cstddef>
#include <functional>

#include <palpate/core/progress.h>

namespace palpate {

// Calls work(i) once for each i in 0..count-1, from up to `threads` threads (0: as many as the
// machine runs at once). `progress` is called in the caller's thread with the fraction done. When a
// piece throws, or `progress` returns false, no further piece begins. After the running pieces have
// ended, the exception of the piece with the lowest index is thrown, or Cancelled when none threw.
void forEachInParallel(std::size_t count,
                       const std::function<void(std::size_t index)>& work,
                       const Progress& progress = {},
                       std::size_t threads = 0);

}  // namespace palpate
