// What this process holds: memory, descriptors, threads. For tests that show that none of them grows.
#pragma once

#include <cstddef>

namespace palpate::testing {

struct ProcessFacts {
  std::size_t residentBytes = 0;
  std::size_t descriptors = 0;
  std::size_t threads = 0;
};

ProcessFacts processFacts();

}  // namespace palpate::testing
