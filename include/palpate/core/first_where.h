// Binary search in what is computed, not stored.
#pragma once

#include <cstddef>

namespace palpate {

// The first index of 0..count - 1 for which `holds(index)` is true, or `count` without one. `holds`
// must be false up to some index and true from there on.
template <typename Predicate>
std::size_t firstWhere(std::size_t count, const Predicate& holds) {
  std::size_t first = 0;
  while (count > 0) {
    const std::size_t half = count / 2;
    if (holds(first + half)) {
      count = half;
    } else {
      first += half + 1;
      count -= half + 1;
    }
  }
  return first;
}

}  // namespace palpate
