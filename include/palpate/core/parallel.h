// Independent pieces of work on several threads. What comes out doesn't depend on how many there
// are, as long as each piece writes only its own place.
#pragma once

#include <cstddef>
#include <functional>

#include <palpate/core/progress.h>

namespace palpate {

// Calls work(i) once for each i in 0..count-1, from up to `threads` threads (0: as many as the
// machine runs at once). `progress` is called in the caller's thread with the part that is done.
// When a piece throws, or the progress returns false, no further piece begins; after those that run
// have ended the exception of the lowest such piece is thrown, else Cancelled.
void forEachInParallel(std::size_t count,
                       const std::function<void(std::size_t index)>& work,
                       const Progress& progress = {},
                       std::size_t threads = 0);

}  // namespace palpate
