// Histogram of the values of a signal, for the selection in the timeline.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

// Counts of the finite values in bins of equal width. Bin i has the values from low + i width up to
// low + (i + 1) width; the last bin also has the largest value, as in numpy.histogram.
struct Histogram {
  double low = 0.0;    // smallest value
  double width = 0.0;  // of a bin, above 0; 1 when all values are the same (low is 0.5 below then)
  std::vector<std::size_t> counts;  // empty without a finite value
  std::size_t notFinite = 0;        // values that are left out
};

inline constexpr std::size_t kMaxHistogramBins = 1000;

// `bins`: 1..1000; 0 chooses a number after Freedman and Diaconis 1981 (width 2 IQR / n^(1/3)), at
// least that of Sturges (1 + lg2 n), as numpy's "auto", at most 200. Throws std::invalid_argument
// for another number.
Histogram histogramOf(std::span<const double> values, std::size_t bins = 0);

}  // namespace palpate
