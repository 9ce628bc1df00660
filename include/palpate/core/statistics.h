// Computes the median of a range of values.
#pragma once

#include <algorithm>
#include <iterator>
#include <ranges>

namespace palpate {

// Returns the middle value; of an even number of values, the larger of the two in the middle.
// Reorders `values`, which must have at least one value and no NaN.
template <std::ranges::random_access_range Values>
std::ranges::range_value_t<Values> upperMedian(Values&& values) {
  const auto middle = std::ranges::begin(values) + std::ranges::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

// Returns the middle value; of an even number of values, the mean of the two in the middle. The
// other rules are those of upperMedian().
template <std::ranges::random_access_range Values>
double median(Values&& values) {
  const auto upper = static_cast<double>(upperMedian(values));
  const auto size = std::ranges::ssize(values);
  if (size % 2 == 1) return upper;
  const auto begin = std::ranges::begin(values);
  return 0.5 * (static_cast<double>(*std::max_element(begin, begin + size / 2)) + upper);
}

}  // namespace palpate
