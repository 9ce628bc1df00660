#include "palpate/model/tactile_frame.h"

#include <limits>
#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::tactile_frame_test {
namespace {

TEST(TactileFrame, MatricesAreViewsRowByRow) {
  TactileFrame frame(sdh2().layout);
  ASSERT_EQ(frame.values.size(), 486u);
  // Offsets of the .dsa survey: 0, 84, 162, 246, 324, 408; index = offset + y * 6 + x.
  frame.values[162 + 3 * 6 + 4] = 7.0F;
  EXPECT_EQ(frame.matrix(2)(3, 4), 7.0F);
  frame.matrix(5)(12, 5) = 9.0F;
  EXPECT_EQ(frame.values[485], 9.0F);
  EXPECT_EQ(frame.matrix(1).rows(), 13);
  EXPECT_EQ(frame.matrix(0).rows(), 14);
  EXPECT_THROW(frame.matrix(6), std::out_of_range);
}

TEST(TactileFrame, KnowsWhetherItHoldsCounts) {
  TactileFrame frame(sdh2().layout);
  EXPECT_TRUE(frame.isCounts());
  frame.values[3] = 4095.0F;
  EXPECT_TRUE(frame.isCounts());
  for (float bad : {4096.0F, -1.0F, 0.5F, std::numeric_limits<float>::quiet_NaN()}) {
    frame.values[3] = bad;
    EXPECT_FALSE(frame.isCounts()) << bad;
  }
}

}  // namespace
}  // namespace palpate::tactile_frame_test
