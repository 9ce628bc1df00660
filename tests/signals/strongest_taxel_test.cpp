#include "palpate/signals/strongest_taxel.h"

#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::strongest_taxel_test {
namespace {

Profile rising(std::size_t frames) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < frames; ++i) {
    TactileFrame frame(sdh2().layout);
    frame.matrix(1)(7, 2) = 100.0F;
    frame.matrix(4)(3, 5) = i % 2 == 0 ? 190.0F : 0.0F;  // more at times, less in all
    frame.matrix(5)(0, 2) = 100.0F;                      // as much as the first
    builder.addFrame(static_cast<std::int64_t>(i + 1) * 10'000, frame.values);
  }
  return builder.finish({});
}

TEST(StrongestTaxel, HasTheLargestSumAndIsTheFirstOfEquals) {
  EXPECT_EQ(strongestTaxel(rising(20)), (TaxelPlace{1, 7, 2}));
  EXPECT_EQ(strongestTaxel(rising(1)), (TaxelPlace{4, 3, 5}));
  // Ten looks, spread evenly over twenty frames: the even ones.
  EXPECT_EQ(strongestTaxel(rising(20), 10), (TaxelPlace{4, 3, 5}));
}

TEST(StrongestTaxel, NobodyWhereNothingIsFelt) {
  EXPECT_EQ(strongestTaxel(rising(0)), std::nullopt);
  ProfileBuilder builder(sdh2().layout);
  builder.addFrame(1, TactileFrame(sdh2().layout).values);
  EXPECT_EQ(strongestTaxel(builder.finish({})), std::nullopt);
}

TEST(StrongestTaxel, RefusesAndCanBeCancelled) {
  EXPECT_THROW(strongestTaxel(rising(2), 0), std::invalid_argument);
  EXPECT_THROW(strongestTaxel(rising(2), 5, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace palpate::strongest_taxel_test
