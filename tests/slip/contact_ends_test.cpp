#include "palpate/slip/contact_ends.h"

#include <stdexcept>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::contact_ends_test {
namespace {

using testing::reading;
using testing::viewOf;

const MatrixLayout kLayout = MatrixLayout::full(14, 6, 3.4);

MatrixValues block(int top, int bottom, int left, int right, float value) {
  MatrixValues values = MatrixValues::Zero(14, 6);
  values.block(top, left, bottom - top + 1, right - left + 1).setConstant(value);
  return values;
}

TEST(ContactEnds, AreInsideForEveryShapeInTheMiddle) {
  for (const SlipShape shape : slipShapes()) {
    SyntheticSlip slip({}, 7);
    SyntheticContact contact;
    contact.shape = shape;
    contact.x = 2.5;
    contact.y = 6.5;
    EXPECT_LT(loadAtTwoSides(kLayout, viewOf(reading(slip, contact))), 1.0) << nameOf(shape);
  }
}

TEST(ContactEnds, AreOutsideWhereTheLoadGoesOnOverTwoSides) {
  EXPECT_EQ(loadAtTwoSides(kLayout, viewOf(block(5, 8, 0, 5, 900.0F))), 2.0);
  EXPECT_EQ(loadAtTwoSides(kLayout, viewOf(block(0, 13, 2, 3, 900.0F))), 2.0);
  // A load that is linear along the band: 600, 500, .. 100.
  MatrixValues linear = MatrixValues::Zero(14, 6);
  for (int x = 0; x < 6; ++x)
    linear.block(5, x, 3, 1).setConstant(100.0F * static_cast<float>(6 - x));
  EXPECT_NEAR(loadAtTwoSides(kLayout, viewOf(linear)), 700.0 / 600.0, 1e-6);
  // A bar across the upper left corner.
  MatrixValues bar = MatrixValues::Zero(14, 6);
  for (int i = 0; i < 4; ++i) bar(i, 3 - i) = bar(i, 4 - i) = 800.0F;
  EXPECT_EQ(loadAtTwoSides(kLayout, viewOf(bar)), 2.0);
}

TEST(ContactEnds, AContactCutByOneSideEndsAtTheOpposite) {
  EXPECT_EQ(loadAtTwoSides(kLayout, viewOf(block(5, 8, 3, 5, 900.0F))), 1.0);
  EXPECT_EQ(loadAtTwoSides(kLayout, viewOf(block(5, 8, 1, 4, 900.0F))), 0.0);
}

TEST(ContactEnds, ATaxelBesideAMaskedOneLiesAtASide) {
  MatrixLayout layout = kLayout;
  const MatrixValues values = block(5, 8, 1, 4, 900.0F);
  EXPECT_EQ(loadAtTwoSides(layout, viewOf(values)), 0.0);
  layout.dynamicMask[5 * 6 + 0] = 0;
  EXPECT_EQ(loadAtTwoSides(layout, viewOf(values)), 1.0);
  layout.dynamicMask[5 * 6 + 5] = 0;
  EXPECT_EQ(loadAtTwoSides(layout, viewOf(values)), 2.0);
}

TEST(ContactEnds, NothingEndsNowhere) {
  EXPECT_EQ(loadAtTwoSides(kLayout, viewOf(MatrixValues::Zero(14, 6))), 2.0);
  EXPECT_THROW(loadAtTwoSides(kLayout, viewOf(MatrixValues::Zero(13, 6))), std::invalid_argument);
}

TEST(ContactEnds, AStrongContactIsFarAboveThresholdAndNoise) {
  MatrixValues values = block(4, 8, 1, 4, 160.0F);
  EXPECT_FALSE(isStrongContact(viewOf(values), 5.0));
  // Four taxels are as many as the unknowns of the motion.
  values.block(5, 2, 2, 2).setConstant(320.0F);
  EXPECT_FALSE(isStrongContact(viewOf(values), 5.0));
  values(7, 2) = 320.0F;
  EXPECT_TRUE(isStrongContact(viewOf(values), 5.0));
  values(7, 2) = 319.0F;
  EXPECT_FALSE(isStrongContact(viewOf(values), 5.0));
  values(7, 2) = 320.0F;
  EXPECT_FALSE(isStrongContact(viewOf(values), 54.0));
  EXPECT_FALSE(isStrongContact(viewOf(MatrixValues::Zero(14, 6)), 5.0));
}

}  // namespace
}  // namespace palpate::contact_ends_test
