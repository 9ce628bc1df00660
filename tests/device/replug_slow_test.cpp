// 500 times unplugged and plugged in again (reliability R8).
#include "device/replug.h"

namespace palpate::testing::replug_slow_test {
namespace {

class ReplugSlow : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Half, ReplugSlow, ::testing::Range(0, 2));

TEST_P(ReplugSlow, TwoHundredAndFiftyCycles) {
  const ReplugFigures figures = replugHands(250, 2);
  EXPECT_EQ(figures.cycles, 250);
  EXPECT_LT(figures.mostNoticedMs, 500.0);
  EXPECT_LT(figures.mostReturnMs, 1000.0);
}

}  // namespace
}  // namespace palpate::testing::replug_slow_test
