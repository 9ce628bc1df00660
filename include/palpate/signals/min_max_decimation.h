// Thins a long series for drawing without changing what is seen: of all samples that fall into one
// pixel column only the first, the last, the smallest and the largest are kept. A line through them
// covers the same pixels as a line through all samples (Jugel et al., "M4: A Visualization-Oriented
// Time Series Data Aggregation", VLDB 2014).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

struct SeriesPoint {
  double x = 0.0;
  double y = 0.0;  // NaN: the line is broken here
  bool operator==(const SeriesPoint&) const = default;
};

struct DecimationOptions {
  double from = 0.0;           // what is seen, in the unit of x
  double to = 1.0;             // not below `from`
  std::size_t columns = 1000;  // pixel columns between from and to, 1..1,000,000
  // ascending: no line from sample i to sample i+1 (a gap)
  std::span<const std::size_t> breaks = {};

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// x ascending, as many y. Returns at most 4 points per column and 5 per break, ascending in x, plus
// the nearest sample on either side of the seen part, so that lines leave it where they should.
// A NaN in y breaks the line where it is kept, and is no extreme.
// Throws std::invalid_argument for bad options or different sizes of x and y.
std::vector<SeriesPoint> minMaxDecimated(std::span<const double> x,
                                         std::span<const double> y,
                                         const DecimationOptions& options);

}  // namespace palpate
