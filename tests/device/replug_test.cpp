// Unplugged and plugged in again, short form (reliability R8).
#include "device/replug.h"

namespace palpate::testing::replug_test {
namespace {

TEST(Replug, TheHandIsMissedAndFoundAgain) {
  const ReplugFigures figures = replugHands(8, 2);
  EXPECT_EQ(figures.cycles, 8);
  EXPECT_LT(figures.mostNoticedMs, 500.0);
  EXPECT_LT(figures.mostReturnMs, 1000.0);
}

}  // namespace
}  // namespace palpate::testing::replug_test
