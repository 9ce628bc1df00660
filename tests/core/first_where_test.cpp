#include "palpate/core/first_where.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace palpate::first_where_test {
namespace {

TEST(FirstWhere, FindsWhatUpperBoundFinds) {
  std::vector<int> values;
  for (int size = 0; size <= 9; ++size) {
    for (int wanted = -1; wanted <= 10; ++wanted) {
      const auto place = std::upper_bound(values.begin(), values.end(), wanted);
      EXPECT_EQ(firstWhere(values.size(), [&](std::size_t i) { return values[i] > wanted; }),
                static_cast<std::size_t>(place - values.begin()))
          << size << ' ' << wanted;
    }
    values.push_back(size / 3 * 2);  // some are equal
  }
}

TEST(FirstWhere, AsksNoIndexOutsideAndFew) {
  constexpr std::size_t kCount = 1'000'000;
  int asked = 0;
  EXPECT_EQ(firstWhere(kCount,
                       [&](std::size_t i) {
                         EXPECT_LT(i, kCount);
                         ++asked;
                         return false;
                       }),
            kCount);
  EXPECT_LE(asked, 20);
}

}  // namespace
}  // namespace palpate::first_where_test
