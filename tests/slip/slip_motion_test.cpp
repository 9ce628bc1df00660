#include "palpate/slip/slip_motion.h"

#include "testing/testing.h"

namespace palpate::slip_motion_test {
namespace {

TEST(SlipMotion, IsNothingUntilItIsMeasured) {
  const SlipMotion motion;
  EXPECT_FALSE(motion.valid);
  EXPECT_FALSE(motion.refValid);
  EXPECT_FALSE(motion.rotation.valid);
  EXPECT_FALSE(motion.rotation.refValid);
  EXPECT_EQ(motion.dx, 0.0);
  EXPECT_EQ(motion.refDy, 0.0);
  EXPECT_EQ(motion.confidence, 0.0);
}

}  // namespace
}  // namespace palpate::slip_motion_test
