// Computes the median of a range of values.
#pragma once

#include <algorithm>
#include <iterator>
#include <ranges>
#include <type_traits>

namespace palpate {

// Values that a function may reorder: temporary ones, those handed over by std::move(), and those
// behind a view such as std::span. A named container is refused, so that its owner isn't surprised.
template <typename Values>
concept ReorderableValues = std::ranges::random_access_range<Values> &&
    (!std::is_lvalue_reference_v<Values> || std::ranges::view<std::remove_cvref_t<Values>>);

// Returns the middle value; of an even number of values, the larger of the two in the middle.
// Reorders `values`, which must have at least one value and no NaN.
template <ReorderableValues Values>
std::ranges::range_value_t<Values> upperMedian(Values&& values) {
  const auto middle = std::ranges::begin(values) + std::ranges::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

// Returns the middle value; of an even number of values, the mean of the two in the middle. The
// other rules are those of upperMedian().
template <ReorderableValues Values>
double median(Values&& values) {
  const auto begin = std::ranges::begin(values);
  const auto size = std::ranges::ssize(values);
  const auto middle = begin + size / 2;
  std::ranges::nth_element(begin, middle, begin + size);
  const auto upper = static_cast<double>(*middle);
  if (size % 2 == 1) return upper;
  return 0.5 * (static_cast<double>(*std::max_element(begin, begin + size / 2)) + upper);
}

}  // namespace palpate
