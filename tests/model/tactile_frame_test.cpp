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

TEST(TaxelPeak, FindsTheLargestTaxelOfAllMatricesAndItsPlace) {
  TactileFrame frame(sdh2().layout);
  frame.matrix(0)(2, 1) = 90.0F;
  frame.matrix(3)(12, 5) = 91.0F;
  frame.matrix(5)(0, 0) = 12.0F;
  const TaxelPeak peak = taxelPeak(frame);
  EXPECT_EQ(peak.matrix, 3u);
  EXPECT_EQ(peak.row, 12);
  EXPECT_EQ(peak.column, 5);
  EXPECT_EQ(peak.counts, 91.0F);
}

TEST(TaxelPeak, OfEqualsIsTheFirstInWireOrder) {
  TactileFrame frame(sdh2().layout);
  frame.matrix(4)(0, 3) = 50.0F;
  frame.matrix(2)(13, 5) = 50.0F;
  EXPECT_EQ(taxelPeak(frame).matrix, 2u);
  EXPECT_EQ(taxelPeak(frame).row, 13);
}

TEST(IsTouched, AboveZero) {
  static_assert(isTouched(1e-30F) && isTouched(1.0) && !isTouched(-1.0));
  for (const float value : {0.0F, -0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_FALSE(isTouched(value)) << value;
    EXPECT_FALSE(isTouched(static_cast<double>(value))) << value;
  }
  MatrixValues values(2, 2);
  values << 0.0F, 1.0F, -1.0F, 2.0F;
  EXPECT_EQ(areTouched(values.array()).count(), 2);
  EXPECT_TRUE(areTouched(values.array())(0, 1));
}

TEST(TaxelPeak, OfAnUntouchedSensorIsZero) {
  EXPECT_EQ(taxelPeak(TactileFrame(sdh2().layout)).counts, 0.0F);
}

TEST(TaxelPeak, SeesEveryTaxel) {
  for (std::size_t place = 0; place < sdh2().layout->numCells(); ++place) {
    TactileFrame frame(sdh2().layout);
    frame.values[place] = 7.0F;
    ASSERT_EQ(taxelPeak(frame).counts, 7.0F) << place;
  }
}

TEST(TaxelPeak, OfOneMatrixNamesItUntouchedToo) {
  TactileFrame frame(sdh2().layout);
  frame.matrix(3)(12, 5) = 91.0F;
  frame.matrix(4)(1, 2) = 4.0F;
  EXPECT_EQ(taxelPeak(frame, 4).counts, 4.0F);
  EXPECT_EQ(taxelPeak(frame, 4).row, 1);
  EXPECT_EQ(taxelPeak(frame, 5).matrix, 5u);
  EXPECT_EQ(taxelPeak(frame, 5).counts, 0.0F);
}

}  // namespace
}  // namespace palpate::tactile_frame_test
