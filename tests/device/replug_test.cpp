// Unplugged and plugged in again, short form (reliability R8).
#include "device/replug.h"

#include "testing/time_limit.h"

namespace palpate::testing::replug_test {
namespace {

TEST(Replug, TheHandIsMissedAndFoundAgain) {
  const ReplugFigures figures = replugHands(8, 2);
  EXPECT_EQ(figures.cycles, 8);
  EXPECT_LT(figures.mostNoticedMs, timeLimit(500.0));
  EXPECT_LT(figures.mostReturnMs, timeLimit(1000.0));
}

}  // namespace
}  // namespace palpate::testing::replug_test
