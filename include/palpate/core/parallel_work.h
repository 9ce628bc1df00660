// Work that falls into independent pieces, shared between threads.
#pragma once

#include <cstddef>
#include <functional>

#include <palpate/core/progress.h>

namespace palpate {

// Calls work(i) once for every i < count, from up to `threads` threads at a time (0: as many as the machine has cores;
// with one, or one piece, in the caller's). Pieces are begun in order; what they write must not overlap. The progress is
// called in the caller's thread only. The first exception of a piece (of the lowest i among those that threw) is thrown
// again when all threads have ended; Cancelled when the progress returned false: pieces begun are finished, no other is
// begun.
void forEachParallel(std::size_t count,
                     const std::function<void(std::size_t index)>& work,
                     std::size_t threads = 0,
                     const Progress& progress = {});

}  // namespace palpate
