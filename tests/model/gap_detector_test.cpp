#include "palpate/model/gap_detector.h"

#include "testing/testing.h"

namespace palpate::gap_detector_test {
namespace {

TEST(GapDetector, FindsWhatIsLongerThanASecondAndFiveIntervals) {
  GapDetector gaps;
  std::int64_t us = 1'000'000'000;
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(gaps.afterGap(us += 30'000)) << i;
  EXPECT_FALSE(gaps.afterGap(us += 1'000'000));  // a second isn't longer than a second
  EXPECT_TRUE(gaps.afterGap(us += 1'000'001));
  EXPECT_FALSE(gaps.afterGap(us += 30'000));
}

TEST(GapDetector, SlowRecordingsHaveNone) {
  GapDetector gaps;
  std::int64_t us = 0;
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(gaps.afterGap(us += 3'000'000)) << i;
  EXPECT_FALSE(gaps.afterGap(us += 15'000'000));
  EXPECT_TRUE(gaps.afterGap(us += 15'000'001));
}

TEST(GapDetector, KnowsNothingAtTheBeginning) {
  GapDetector gaps;
  EXPECT_FALSE(gaps.afterGap(0));
  EXPECT_FALSE(gaps.afterGap(1'000'000'000));
  gaps.reset();
  EXPECT_FALSE(gaps.afterGap(5));
  EXPECT_FALSE(gaps.afterGap(1'000'000'000));
}

TEST(GapDetector, ThresholdIsTheLongerOfASecondAndFiveIntervals) {
  EXPECT_EQ(gapThresholdS(0.0), 1.0);
  EXPECT_EQ(gapThresholdS(0.2), 1.0);
  EXPECT_EQ(gapThresholdS(0.25), 1.25);
  EXPECT_EQ(gapThresholdUs(std::int64_t{200'000}), 1'000'000);
  EXPECT_EQ(gapThresholdUs(std::int64_t{200'001}), 1'000'005);
  EXPECT_EQ(gapThresholdUs(200'000.5), 1'000'002.5);
}

TEST(GapDetector, LostFramesAreAGapHoweverShort) {
  GapDetector gaps;
  std::int64_t us = 0;
  gaps.setLoss();
  EXPECT_FALSE(gaps.afterGap(us)) << "nothing was before";
  EXPECT_FALSE(gaps.afterGap(us += 30'000));
  gaps.setLoss();
  EXPECT_TRUE(gaps.afterGap(us += 60'000));
  EXPECT_FALSE(gaps.afterGap(us += 30'000));
}

}  // namespace
}  // namespace palpate::gap_detector_test
