// Sorting networks for the median of four taxels at once. They only compare and swap: no branch
// depends on a value, and all values fit into the registers.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "filter/lanes.h"

namespace palpate::detail {

struct SortedTriple {
  FourLanes low;
  FourLanes mid;
  FourLanes high;
};

inline SortedTriple sorted(FourLanes a, FourLanes b, FourLanes c) {
  order(a, b);
  order(b, c);
  order(a, b);
  return {a, b, c};
}

// Median of nine values in three sorted columns: the median of the largest low, the median mid and
// the smallest high value (Smith 1996).
inline FourLanes median9(const SortedTriple& a, const SortedTriple& b, const SortedTriple& c) {
  return middle(most(most(a.low, b.low), c.low),
                middle(a.mid, b.mid, c.mid),
                least(least(a.high, b.high), c.high));
}

using Nine = std::array<FourLanes, 9>;

// Writes the exchanges out one by one; a loop would keep the values in memory.
template <const auto& kPairs, std::size_t N, std::size_t... kIndex>
inline void exchange(std::array<FourLanes, N>& v, std::index_sequence<kIndex...>) {
  (order(v[kPairs[kIndex][0]], v[kPairs[kIndex][1]]), ...);
}

using Pairs25 = std::array<std::array<std::size_t, 2>, 25>;
// The shortest known network that sorts nine values, 7 layers deep.
inline constexpr Pairs25 kSortNine = {{{0, 3}, {1, 7}, {2, 5}, {4, 8}, {0, 7}, {2, 4}, {3, 8},
                                       {5, 6}, {0, 2}, {1, 3}, {4, 5}, {7, 8}, {1, 4}, {3, 6},
                                       {5, 7}, {0, 1}, {2, 4}, {3, 5}, {6, 8}, {2, 3}, {4, 5},
                                       {6, 7}, {1, 2}, {3, 4}, {5, 6}}};
using Pairs9 = std::array<std::array<std::size_t, 2>, 9>;
// Merges two sorted runs of four into one of eight (Batcher).
inline constexpr Pairs9 kMergeFours = {
    {{0, 4}, {1, 5}, {2, 6}, {3, 7}, {2, 4}, {3, 5}, {1, 2}, {3, 4}, {5, 6}}};

inline void sort(Nine& v) { exchange<kSortNine>(v, std::make_index_sequence<25>()); }

// Median of 27 values in three sorted columns of nine. Sorting the three values of each rank leaves
// both directions sorted; then 7 of the 27 values are certainly too small and 7 too large. The
// median is the 7th of the other 13: four of the lowest values of a rank, five of the middle ones,
// four of the highest.
inline FourLanes median27(const Nine& a, const Nine& b, const Nine& c) {
  // Two sorted runs of four: highest of ranks 0..3, lowest of 5..8.
  std::array<FourLanes, 8> outer;
  std::array<FourLanes, 5> mids;  // of ranks 2..6
  for (std::size_t i = 0; i < 4; ++i) outer[i] = most(most(a[i], b[i]), c[i]);
  for (std::size_t i = 0; i < 4; ++i) outer[i + 4] = least(least(a[i + 5], b[i + 5]), c[i + 5]);
  for (std::size_t i = 0; i < 5; ++i) mids[i] = middle(a[i + 2], b[i + 2], c[i + 2]);
  exchange<kMergeFours>(outer, std::make_index_sequence<9>());
  // The 7th value of two sorted runs: for every way to take i values of one run and 7 - i of the
  // other, find the largest value; the smallest of these is the 7th.
  FourLanes seventh = outer[6];
  for (std::size_t j = 1; j <= 5; ++j) seventh = least(seventh, most(outer[6 - j], mids[j - 1]));
  return seventh;
}

}  // namespace palpate::detail
