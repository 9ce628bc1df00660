// Memory, file descriptors and threads of this process, for tests that show that none of them
// grows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

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

// Runs work in a process of its own. Returns the highest memory of that process, or of one that it
// has started and waited for [bytes]; fails unless the work returns true.
std::uint64_t memoryOf(const std::function<bool()>& work);

// False with sanitizers, which use memory of their own, so that residentBytes says nothing about
// the program.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;
#else
constexpr bool kMemoryIsOurs = true;
#endif

}  // namespace palpate::testing
