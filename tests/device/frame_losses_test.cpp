#include "palpate/device/frame_losses.h"

#include "testing/testing.h"

namespace palpate::frame_losses_test {
namespace {

TEST(FrameLosses, TheTextSaysOnlyWhatHappened) {
  EXPECT_EQ(textOf({}), "");
  EXPECT_EQ(textOf({.lost = 1}), "1 frame lost on the way");
  EXPECT_EQ(textOf({.refused = 2, .lastRefused = "line 8: a\nb"}),
            "2 refused (the last: line 8: a\\nb)");
  EXPECT_EQ(
      textOf({.lost = 31, .refused = 2, .outOfRange = 3, .lastOutOfRange = "value 1 is 9360"}),
      "31 frames lost on the way, 2 refused, 3 frames with values outside the hand's range "
      "(the last: value 1 is 9360)");
}

}  // namespace
}  // namespace palpate::frame_losses_test
