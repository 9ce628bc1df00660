// Chooses the range of a chart's vertical axis from the values that are visible.
#pragma once

#include <optional>

namespace palpate {

// from < to, in the unit of the values.
struct AxisRange {
  double from = 0.0;
  double to = 1.0;
  bool operator==(const AxisRange&) const = default;
};

// The smallest and the largest visible value; low <= high.
struct ValueExtent {
  double low = 0.0;
  double high = 0.0;
};

struct AxisRangeOptions {
  // The axis begins at 0 unless values are below (counts, forces); otherwise it begins near the
  // lowest value (angles, temperatures).
  bool fromZero = true;
  // An axis that doesn't begin at 0 spans this at least [unit of the values], so that the noise of
  // something constant doesn't fill the chart; 0: it follows values of any size.
  double minExtent = 1.0;
  // Values can't exceed this (saturation): the axis doesn't go further than needed to show it.
  std::optional<double> ceiling = std::nullopt;
};

// The least 1, 2 or 5 times a power of ten at or above `value`; 1e-9 at least.
double niceAbove(double value);

// Range for a chart that stands still: all values, with 6 % of room. No values: 0..1.06.
// `minExtent`: as in AxisRangeOptions.
AxisRange fittedRange(const std::optional<ValueExtent>& values,
                      bool fromZero,
                      double minExtent = 0.0);

// Range for a rolling chart. It changes only in steps, and becomes smaller only when the values
// take less than 35 % of it, so that the axis stays still most of the time.
class RollingRange {
 public:
  // Takes the extent of the visible values; returns the range, 0..1 before there are any values.
  AxisRange update(const std::optional<ValueExtent>& values, const AxisRangeOptions& options);
  void reset() { range_.reset(); }

 private:
  std::optional<AxisRange> range_;
};

}  // namespace palpate
