#include "palpate/signals/axis_range.h"

#include <algorithm>
#include <cmath>

namespace palpate {
namespace {

constexpr double kHeadroom = 1.06;
// The range becomes smaller when the values take less than this share of it.
constexpr double kShrinkBelow = 0.35;
// Steps into which the ends of a range that doesn't begin at 0 are rounded, per extent of the
// values.
constexpr double kStepsPerExtent = 4.0;

AxisRange steppedFromZero(const ValueExtent& values, std::optional<double> ceiling) {
  AxisRange range{0.0, 0.0};
  if (values.high > 0.0) range.to = niceAbove(values.high * kHeadroom);
  if (values.low < 0.0) range.from = -niceAbove(-values.low * kHeadroom);
  if (ceiling && values.high <= *ceiling) range.to = std::min(range.to, *ceiling * kHeadroom);
  return range;
}

AxisRange steppedAround(const ValueExtent& values, double minExtent) {
  // A constant still has an axis: a thousandth of a large value, or one unit.
  double extent =
      std::max({values.high - values.low, minExtent, 1e-3 * std::max(-values.low, values.high)});
  if (!(extent > 0.0)) extent = 1.0;
  const double step = niceAbove(extent / kStepsPerExtent);
  AxisRange range{std::floor(values.low / step) * step, std::ceil(values.high / step) * step};
  if (values.low - range.from < 0.1 * step) range.from -= step;
  if (range.to - values.high < 0.1 * step) range.to += step;
  return range;
}

}  // namespace

double niceAbove(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-9))));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= value) return factor * power;
  return 10.0 * power;
}

AxisRange fittedRange(const std::optional<ValueExtent>& values, bool fromZero, double minExtent) {
  auto [low, high] = values.value_or(ValueExtent{});
  if (fromZero) low = std::min(low, 0.0);
  if (const double more = minExtent - (high - low); !fromZero && values && more > 0.0) {
    low -= more / 2.0;
    high += more / 2.0;
  }
  if (!(high > low)) high = low + 1.0;
  const double air = (high - low) * (kHeadroom - 1.0);
  return {fromZero && low == 0.0 ? 0.0 : low - air, high + air};
}

AxisRange RollingRange::update(const std::optional<ValueExtent>& values,
                               const AxisRangeOptions& options) {
  if (!values) return range_.value_or(AxisRange{});
  ValueExtent seen = *values;
  if (options.fromZero) seen = {std::min(seen.low, 0.0), std::max(seen.high, 0.0)};
  const bool fits = range_ && seen.low >= range_->from && seen.high <= range_->to &&
                    seen.high - seen.low >= kShrinkBelow * (range_->to - range_->from);
  if (fits) return *range_;
  const AxisRange wanted = options.fromZero ? steppedFromZero(seen, options.ceiling)
                                            : steppedAround(seen, options.minExtent);
  // A constant would otherwise move its own axis with each small change.
  const bool holds = range_ && seen.low >= range_->from && seen.high <= range_->to;
  if (holds && wanted.to - wanted.from >= kShrinkBelow * (range_->to - range_->from) &&
      !options.fromZero)
    return *range_;
  if (!(wanted.to > wanted.from)) {
    range_.reset();
    return {};
  }
  range_ = wanted;
  return wanted;
}

}  // namespace palpate
