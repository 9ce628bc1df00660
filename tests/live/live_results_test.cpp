#include "palpate/live/live_results.h"

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::live_results_test {
namespace {

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

}  // namespace
}  // namespace palpate::live_results_test
