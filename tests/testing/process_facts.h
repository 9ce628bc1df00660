// Memory, file descriptors and threads of this process, for tests that show that none of them
// grows.
#pragma once

#include <cstddef>

namespace palpate::testing {

// The values of one moment.
struct ProcessFacts {
  std::size_t residentBytes = 0;
  std::size_t descriptors = 0;
  std::size_t threads = 0;
};

ProcessFacts processFacts();
// The minimum of each value over 50 ms, which excludes what is open only for a moment (a journal, a
// folder being synced).
ProcessFacts leastProcessFacts();

// False with sanitizers, which use memory of their own, so that residentBytes says nothing about
// the program.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;
#else
constexpr bool kMemoryIsOurs = true;
#endif

}  // namespace palpate::testing
