#include "palpate/core/statistics.h"

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "testing/testing.h"

// Expected values: Python's statistics.median_high() and statistics.median().
namespace palpate::statistics_test {
namespace {

const std::vector<double> kOdd = {3.5, -1.25, 7.0, 0.5, 2.75, 100.0, -8.0};
const std::vector<double> kEven = {3.5, -1.25, 7.0, 0.5, 2.75, 100.0, -8.0, 1.5};

TEST(Statistics, MedianOfAnOddNumberOfValuesIsTheOneInTheMiddle) {
  EXPECT_EQ(upperMedian(std::vector(kOdd)), 2.75);
  EXPECT_EQ(median(std::vector(kOdd)), 2.75);
}

TEST(Statistics, MedianOfAnEvenNumberIsTheMeanOfTheTwoInTheMiddleUpperMedianTheLarger) {
  EXPECT_EQ(upperMedian(std::vector(kEven)), 2.75);
  EXPECT_EQ(median(std::vector(kEven)), 2.125);
}

TEST(Statistics, KnowsOneValueTwoAndEqualOnes) {
  EXPECT_EQ(upperMedian(std::vector{4.0}), 4.0);
  EXPECT_EQ(median(std::vector{4.0}), 4.0);
  EXPECT_EQ(upperMedian(std::vector{4.0, -1.0}), 4.0);
  EXPECT_EQ(median(std::vector{4.0, -1.0}), 1.5);
  EXPECT_EQ(upperMedian(std::vector{2.0, 9.0, 2.0, 2.0}), 2.0);
  EXPECT_EQ(median(std::vector{2.0, 9.0, 2.0, 2.0}), 2.0);
}

TEST(Statistics, MedianOfWholeNumbersIsNotRounded) {
  const std::vector<std::int64_t> values = {10'000, 9'999, 33'333, 1};
  EXPECT_EQ(upperMedian(std::vector(values)), 10'000);
  EXPECT_EQ(median(std::vector(values)), 9'999.5);
}

TEST(Statistics, TakesAPartOfAnArrayAndLeavesTheRest) {
  std::array<std::int64_t, 6> values = {5, 1, 4, 2, -7, 99};
  EXPECT_EQ(upperMedian(std::span(values).first(4)), 4);
  EXPECT_EQ(values[4], -7);
  EXPECT_EQ(values[5], 99);
  std::deque<float> queue = {0.5F, 0.25F, 8.0F};
  EXPECT_EQ(upperMedian(std::move(queue)), 0.5F);
}

template <typename Values>
constexpr bool kTakes = requires(Values&& values) {
  upperMedian(std::forward<Values>(values));
};
template <typename Values>
constexpr bool kTakesForMedian = requires(Values&& values) {
  median(std::forward<Values>(values));
};

// They reorder what they are given: a container must be handed over or copied, a view may be named.
TEST(Statistics, TheMedianReordersNoNamedContainer) {
  static_assert(kTakes<std::vector<double>> && kTakesForMedian<std::vector<double>>);
  static_assert(!kTakes<std::vector<double>&> && !kTakesForMedian<std::vector<double>&>);
  static_assert(!kTakes<std::deque<float>&> && !kTakes<std::array<int, 3>&>);
  static_assert(kTakes<std::span<double>&> && kTakesForMedian<std::span<double>&>);
  std::vector<double> values = {3.0, 1.0, 2.0, 0.0};
  std::span<double> view(values);
  EXPECT_EQ(median(view), 1.5);
}

}  // namespace
}  // namespace palpate::statistics_test
