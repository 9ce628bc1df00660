#include "palpate/model/active_taxels.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/model/matrix_layout.h"

namespace palpate::active_taxels_test {
namespace {

// A filtered frame keeps the values of taxels that were touched, also where the filter makes them
// negative or 0; the others are +0.
TEST(ActiveTaxels, NegativeOnesAreKeptButNotActive) {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 4, 1.0)});
  TactileFrame frame(layout);
  frame.values = {3.0F, 0.0F, 0.0F, 0.0F};
  EXPECT_TRUE(isActive(frame, 0));
  EXPECT_FALSE(isActive(frame, 1));
  EXPECT_TRUE(isKept(frame, 1)) << "as recorded, all are";
  frame.setFiltered({-2.5F, 7.5F, -3.5F, 2.5F}, {true, true, false, false});
  EXPECT_FALSE(isActive(frame, 0));
  EXPECT_TRUE(isKept(frame, 0));
  EXPECT_TRUE(isActive(frame, 1));
  for (const std::size_t place : {std::size_t{2}, std::size_t{3}}) {
    EXPECT_FALSE(isActive(frame, place));
    EXPECT_FALSE(isKept(frame, place));
  }
}

}  // namespace
}  // namespace palpate::active_taxels_test
