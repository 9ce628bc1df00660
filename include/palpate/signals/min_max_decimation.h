// Reduces a long series for drawing without a visible change: of all samples in one pixel column
// only the first, the last, the smallest and the largest are kept. A line through them covers the
// same pixels as a line through all samples (Jugel et al., "M4: A Visualization-Oriented Time
// Series Data Aggregation", VLDB 2014).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

// One point of a line.
struct SeriesPoint {
  double x = 0.0;
  double y = 0.0;  // NaN interrupts the line
  bool operator==(const SeriesPoint&) const = default;
};

// The visible range and the width of the picture.
struct DecimationOptions {
  double from = 0.0;  // start of the visible range, in the unit of x
  double to = 1.0;    // its end, not below `from`
  // Pixel columns between from and to, 1..1,000,000.
  std::size_t columns = 1000;
  // Indices i, ascending, such that no line connects samples i and i + 1 (a gap).
  std::span<const std::size_t> breaks = {};

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Decimates a series; x ascends, and y has as many values. Returns at most 4 points per column and
// 5 per break, ascending in x, and also the nearest sample on either side of the visible range, so
// that lines continue beyond its edges. A NaN in y interrupts the line where it is kept, and is
// never an extreme. Throws std::invalid_argument for bad options or different sizes of x and y.
std::vector<SeriesPoint> minMaxDecimated(std::span<const double> x,
                                         std::span<const double> y,
                                         const DecimationOptions& options);

}  // namespace palpate
