#include "palpate/slip/slip_windows.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/laboratory/synthetic_slip.h"

namespace palpate::slip_windows_test {
namespace {

class Feed {
 public:
  explicit Feed(std::int64_t stepUs) : stepUs_(stepUs) {}
  const SlipEvidence& read(const SyntheticContact& contact, std::span<const double> joints = {}) {
    slip_.read(contact, MatrixMap(values_.data(), 14, 6));
    return add(joints);
  }
  const SlipEvidence& nothing() {
    values_.setZero();
    return add({});
  }
  const SlipEvidence& add(std::span<const double> joints) {
    timeUs_ += stepUs_;
    return windows.add(ConstMatrixMap(values_.data(), 14, 6), timeUs_, joints);
  }
  void wait(std::int64_t us) { timeUs_ += us; }
  MatrixValues& values() { return values_; }

  SlipWindows windows{MatrixLayout::full(14, 6, 3.4)};

 private:
  std::int64_t stepUs_;
  std::int64_t timeUs_ = 1'400'000'000'000'000;
  SyntheticSlip slip_{SyntheticSensor{}};
  MatrixValues values_ = MatrixValues::Zero(14, 6);
};

// The contact moves by 0.1 taxel per frame: a window of n frames measures n / 10 taxels.
TEST(SlipWindows, ReachThreeTenAndThirtyFramesBack) {
  Feed feed(32'000);
  for (int i = 0; i < 40; ++i) {
    const SlipEvidence& evidence = feed.read({.y = 4.0 + 0.1 * i});
    EXPECT_EQ(evidence.contactAge, static_cast<std::size_t>(i + 1));
    for (std::size_t w = 0; w < kSlipWindows; ++w) {
      const auto frames = static_cast<int>(kWindowFrames[w]);
      EXPECT_EQ(evidence.windows[w].filled, i >= frames) << i;
      if (i >= frames) {
        EXPECT_NEAR(evidence.windows[w].centroidY, 0.1 * frames, 0.08);
      }
    }
  }
}

TEST(SlipWindows, CountTimeWhereFramesAreFast) {
  Feed feed(3'333);  // 300 Hz: one in seven is kept, 23.3 ms; 0.01 taxel per frame
  for (int i = 0; i < 400; ++i) feed.read({.y = 4.0 + 0.01 * i});
  const SlipEvidence& evidence = feed.windows.evidence();
  // 3 kept frames back: 2 to 3 times seven frames.
  EXPECT_GE(evidence.windows[kShortWindow].centroidY, 0.14 - 0.06);
  EXPECT_LE(evidence.windows[kShortWindow].centroidY, 0.28 + 0.06);
  EXPECT_NEAR(evidence.windows[kLongWindow].centroidY, 2.1, 0.15);
  EXPECT_NEAR(static_cast<double>(evidence.contactAge), 400.0 / 7.0, 1.0);
}

TEST(SlipWindows, CountFramesWhereTheyAreSlow) {
  Feed feed(3'300'000);  // 0.3 Hz
  for (int i = 0; i < 12; ++i) feed.read({.y = 5.0 + 0.1 * i});
  EXPECT_TRUE(feed.windows.evidence().windows[kMiddleWindow].filled);
  EXPECT_NEAR(feed.windows.evidence().windows[kShortWindow].centroidY, 0.3, 0.06);
}

TEST(SlipWindows, EmptyAfterAGap) {
  Feed feed(32'000);
  for (int i = 0; i < 20; ++i) feed.read({});
  feed.wait(147'000'000);
  const SlipEvidence& evidence = feed.read({});
  EXPECT_TRUE(feed.windows.afterGap());
  EXPECT_TRUE(evidence.computable);
  EXPECT_EQ(evidence.contactAge, 1U);
  EXPECT_FALSE(evidence.windows[kShortWindow].filled);
}

TEST(SlipWindows, EmptyWhenContactIsLost) {
  Feed feed(32'000);
  for (int i = 0; i < 20; ++i) feed.read({});
  EXPECT_FALSE(feed.nothing().computable);
  EXPECT_FALSE(feed.read({}).windows[kShortWindow].filled);
  for (int i = 0; i < 3; ++i) feed.read({});
  EXPECT_TRUE(feed.windows.evidence().windows[kShortWindow].filled);
}

TEST(SlipWindows, NeedFourTaxelsAndSomeLoad) {
  Feed feed(32'000);
  for (int x = 0; x < 4; ++x) feed.values()(5, x) = 101.0F;
  EXPECT_TRUE(feed.add({}).computable);
  feed.values()(5, 0) = 97.0F;  // load 400
  EXPECT_FALSE(feed.add({}).computable);
  feed.values()(5, 0) = 0.0F;
  feed.values()(5, 1) = 3000.0F;
  EXPECT_FALSE(feed.add({}).computable);
}

TEST(SlipWindows, TakeWhatIsNoNumberForNothing) {
  Feed feed(32'000);
  for (int x = 0; x < 5; ++x) feed.values()(5, x) = 500.0F;
  feed.values()(5, 5) = std::numeric_limits<float>::quiet_NaN();
  feed.values()(6, 0) = -300.0F;
  feed.values()(6, 1) = std::numeric_limits<float>::infinity();
  for (int i = 0; i < 12; ++i) feed.add({});
  EXPECT_EQ(feed.windows.moments().active, 5);
  feed.windows.evaluateHypotheses(kMiddleWindow);
  EXPECT_TRUE(std::isfinite(feed.windows.evidence().windows[kMiddleWindow].hypotheses.pMoved));
}

TEST(SlipWindows, SeeJointsMove) {
  Feed feed(32'000);
  for (int i = 0; i < 12; ++i) {
    const double joints[2] = {10.0, 20.0 - 0.5 * i};
    feed.read({}, joints);
  }
  EXPECT_NEAR(feed.windows.evidence().windows[kShortWindow].jointsDeg, 1.5, 1e-9);
  EXPECT_NEAR(feed.windows.evidence().windows[kMiddleWindow].jointsDeg, 5.0, 1e-9);
}

TEST(SlipWindows, LetTwoFramesCompete) {
  Feed feed(32'000);
  for (int i = 0; i < 20; ++i) feed.read({.y = 5.0 + 0.08 * i});
  // The window is not filled: nothing is computed.
  feed.windows.evaluateHypotheses(kLongWindow);
  EXPECT_FALSE(feed.windows.evidence().windows[kLongWindow].hypotheses.computed);
  feed.windows.evaluateHypotheses(kMiddleWindow);
  const SlipHypothesisResult& result = feed.windows.evidence().windows[kMiddleWindow].hypotheses;
  ASSERT_TRUE(result.computed);
  EXPECT_NEAR(result.motion.dy, 0.8, 0.05);
  EXPECT_GT(result.pMoved, 0.9);
}

TEST(SlipWindows, RefuseOtherSizesAndOptions) {
  Feed feed(32'000);
  const MatrixValues other = MatrixValues::Zero(13, 6);
  EXPECT_THROW(feed.windows.add(ConstMatrixMap(other.data(), 13, 6), 0), std::invalid_argument);
  EXPECT_THROW(
      SlipWindows(MatrixLayout::full(14, 6, 3.4), {.hypotheses = {}, .minActiveTaxels = 1}),
      std::invalid_argument);
}

}  // namespace
}  // namespace palpate::slip_windows_test
