// What this process holds: memory, descriptors, threads. For tests that show that none of them
// grows.
#pragma once

#include <cstddef>

namespace palpate::testing {

struct ProcessFacts {
  std::size_t residentBytes = 0;
  std::size_t descriptors = 0;
  std::size_t threads = 0;
};

ProcessFacts processFacts();
// The least of each over 50 ms: without what is open for a moment only (a journal, a folder being
// synced).
ProcessFacts leastProcessFacts();

// Sanitizers keep memory of their own: then residentBytes says nothing about ours.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;
#else
constexpr bool kMemoryIsOurs = true;
#endif

}  // namespace palpate::testing
