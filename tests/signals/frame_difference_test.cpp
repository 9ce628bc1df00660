#include "palpate/signals/frame_difference.h"

#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"

namespace palpate::frame_difference_test {
namespace {

TactileFrame sdhFrame() { return TactileFrame(sdh2().layout); }

std::shared_ptr<const SensorLayout> pads(const std::vector<std::pair<int, int>>& sizes) {
  std::vector<MatrixLayout> matrices;
  for (const auto& [rows, columns] : sizes)
    matrices.push_back(MatrixLayout::full(rows, columns, 3.4));
  return std::make_shared<const SensorLayout>(matrices);
}

const TactileFrame& fixed(const TactileFrame& frame) { return frame; }

TEST(FrameDifference, IsAMinusBTaxelByTaxel) {
  TactileFrame a = sdhFrame(), b = sdhFrame();
  a.matrix(1)(7, 2) = 900.0F;
  b.matrix(1)(7, 2) = 650.0F;
  b.matrix(1)(8, 2) = 30.0F;
  a.matrix(4)(2, 3) = 12.0F;
  b.matrix(4)(2, 3) = 12.0F;
  const FrameComparison comparison(sdh2().layout, sdh2().layout);
  EXPECT_TRUE(comparison.allCompared());
  const TactileFrame difference = comparison.difference(a, b);
  EXPECT_EQ(fixed(difference).matrix(1)(7, 2), 250.0F);
  EXPECT_EQ(fixed(difference).matrix(1)(8, 2), -30.0F);
  EXPECT_EQ(fixed(difference).matrix(4)(2, 3), 0.0F);
  double sum = 0.0;
  for (const float value : difference.values) sum += std::abs(static_cast<double>(value));
  EXPECT_EQ(sum, 280.0);
}

TEST(FrameDifference, StatisticsAreOverWhatIsTouchedInEither) {
  TactileFrame a = sdhFrame(), b = sdhFrame();
  a.matrix(1)(7, 2) = 100.0F;  // +60
  b.matrix(1)(7, 2) = 40.0F;
  b.matrix(1)(8, 3) = 80.0F;  // -80
  a.matrix(1)(9, 3) = 5.0F;   // 0
  b.matrix(1)(9, 3) = 5.0F;
  a.matrix(5)(3, 1) = 7.0F;  // +7
  const FrameComparison comparison(sdh2().layout, sdh2().layout);
  const auto rows = comparison.statistics(a, b);
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[1].touched, 3);
  EXPECT_DOUBLE_EQ(rows[1].mean, (60.0 - 80.0 + 0.0) / 3.0);
  EXPECT_DOUBLE_EQ(rows[1].rms, std::sqrt((3600.0 + 6400.0) / 3.0));
  EXPECT_DOUBLE_EQ(rows[1].largest, -80.0);
  EXPECT_EQ(rows[1].y, 8);
  EXPECT_EQ(rows[1].x, 3);
  EXPECT_EQ(rows[0].touched, 0);
  EXPECT_EQ(rows[0].mean, 0.0);
  EXPECT_EQ(rows[0].rms, 0.0);
  EXPECT_DOUBLE_EQ(rows[5].largest, 7.0);
  EXPECT_EQ(rows[6].touched, 4);
  EXPECT_DOUBLE_EQ(rows[6].mean, -13.0 / 4.0);
  EXPECT_DOUBLE_EQ(rows[6].rms, std::sqrt((10'000.0 + 49.0) / 4.0));
  EXPECT_EQ(rows[6].matrix, 1u);
  EXPECT_DOUBLE_EQ(rows[6].largest, -80.0);
  EXPECT_EQ(comparison.largest(a, b), 80.0);
}

TEST(FrameDifference, OfAFrameWithItselfIsNothing) {
  TactileFrame a = sdhFrame();
  a.matrix(2)(3, 3) = 444.0F;
  const FrameComparison comparison(sdh2().layout, sdh2().layout);
  const auto whole = comparison.statistics(a, a).back();
  EXPECT_EQ(whole.touched, 1);
  EXPECT_EQ(whole.rms, 0.0);
  EXPECT_EQ(whole.largest, 0.0);
}

TEST(FrameDifference, MatricesOfOtherSizesAreLeftOut) {
  const auto layoutA = pads({{2, 3}, {4, 4}, {1, 2}});
  const auto layoutB = pads({{2, 3}, {4, 5}});
  const FrameComparison comparison(layoutA, layoutB);
  EXPECT_TRUE(comparison.compared(0));
  EXPECT_FALSE(comparison.compared(1));
  EXPECT_FALSE(comparison.compared(2));
  EXPECT_FALSE(comparison.allCompared());
  TactileFrame a(layoutA), b(layoutB);
  a.matrix(0)(1, 2) = 9.0F;
  a.matrix(1).setConstant(100.0F);
  b.matrix(0)(1, 2) = 4.0F;
  const TactileFrame difference = comparison.difference(a, b);
  EXPECT_EQ(fixed(difference).matrix(0)(1, 2), 5.0F);
  EXPECT_TRUE(fixed(difference).matrix(1).isZero());
  EXPECT_FALSE(comparison.layout()->matrix(1).enabled(0, 0));
  EXPECT_TRUE(comparison.layout()->matrix(1).exists(0, 0));
  EXPECT_EQ(comparison.statistics(a, b).back().touched, 1);
  // The same matrices, and one more in B.
  EXPECT_FALSE(FrameComparison(pads({{2, 3}}), layoutB).allCompared());
}

TEST(FrameDifference, TaxelsThatOneDidNotScanAreLeftOut) {
  std::vector<MatrixLayout> masked = {MatrixLayout::full(2, 2, 3.4)};
  masked[0].dynamicMask[1] = 0;
  const auto layoutA = pads({{2, 2}});
  const auto layoutB = std::make_shared<const SensorLayout>(masked);
  TactileFrame a(layoutA), b(layoutB);
  a.matrix(0).setConstant(10.0F);
  b.values = {4.0F, 0.0F, 10.0F, 12.0F};
  for (const bool swapped : {false, true}) {
    const FrameComparison comparison(swapped ? layoutB : layoutA, swapped ? layoutA : layoutB);
    EXPECT_FALSE(comparison.layout()->matrix(0).enabled(0, 1));
    const auto whole = comparison.statistics(swapped ? b : a, swapped ? a : b).back();
    const double sign = swapped ? -1.0 : 1.0;
    EXPECT_EQ(whole.touched, 3);
    EXPECT_DOUBLE_EQ(whole.mean, sign * (6.0 + 0.0 - 2.0) / 3.0);
    EXPECT_EQ(comparison.difference(swapped ? b : a, swapped ? a : b).values[1], 0.0F);
  }
}

TEST(FrameDifference, FramesOfAnotherLayoutAreRefused) {
  const FrameComparison comparison(pads({{2, 2}}), pads({{2, 2}}));
  const TactileFrame good(pads({{2, 2}})), other(pads({{2, 3}}));
  EXPECT_THROW(comparison.difference(good, other), std::invalid_argument);
  EXPECT_THROW(comparison.statistics(other, good), std::invalid_argument);
  EXPECT_THROW(FrameComparison(nullptr, pads({{2, 2}})), std::invalid_argument);
}

// Frame i has 10 * (i + 1) counts.
TimedProfile ramp(std::size_t count, std::int64_t stepMs) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < count; ++i) {
    TactileFrame frame = sdhFrame();
    frame.matrix(1)(7, 2) = 10.0F * static_cast<float>(i + 1);
    builder.addFrame(1'400'000'000'000'000 + static_cast<std::int64_t>(i) * stepMs * 1000,
                     frame.values);
  }
  return timedProfile(builder.finish({}));
}

TEST(FramePairs, EveryFrameOfAMeetsTheLastOfBAtOrBefore) {
  const TimedProfile a = ramp(10, 100), b = ramp(30, 40);  // b: 0..1.16 s
  std::vector<FramePair> pairs;
  visitFramePairs(
      a, b, 0.25, 1, [&](const FramePair& pair, const TactileFrame& inA, const TactileFrame& inB) {
        EXPECT_EQ(inA.matrix(1)(7, 2), 10.0F * static_cast<float>(pair.frameA + 1));
        EXPECT_EQ(inB.matrix(1)(7, 2), 10.0F * static_cast<float>(pair.frameB + 1));
        pairs.push_back(pair);
      });
  ASSERT_EQ(pairs.size(), 7u);  // A's frames 3..9, at 0.3..0.9 s: 0.05..0.65 s in B
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].frameA, i + 3);
    EXPECT_NEAR(pairs[i].timeS, 0.1 * static_cast<double>(i + 3), 1e-12);
    EXPECT_EQ(pairs[i].frameB, (50 + 100 * i) / 40);
  }
}

TEST(FramePairs, StrideApartNoneNegativeOffset) {
  const TimedProfile a = ramp(10, 100), b = ramp(10, 100);
  const auto count = [&](double offsetS, std::size_t stride) {
    int pairs = 0;
    visitFramePairs(a, b, offsetS, stride, [&](const auto&, const auto&, const auto&) { ++pairs; });
    return pairs;
  };
  EXPECT_EQ(count(0.0, 1), 10);
  EXPECT_EQ(count(0.0, 4), 3);
  EXPECT_EQ(count(-0.5, 1), 5);
  EXPECT_EQ(count(5.0, 1), 0);
  EXPECT_THROW(count(0.0, 0), std::invalid_argument);
  EXPECT_THROW(
      visitFramePairs(
          a, b, 0.0, 1, [](const auto&, const auto&, const auto&) {}, [](double) { return false; }),
      Cancelled);
}

TEST(FramePairs, APairOfWhichOneCannotBeReadIsLeftOutAndCounted) {
  const TimedProfile a = ramp(20, 100), b = ramp(20, 100);
  TimedProfile damagedA = a, damagedB = b;
  damagedA.profile = testing::withDamage(a.profile, 3, 4);
  damagedB.profile = testing::withDamage(b.profile, 10, 12);
  const auto nothing = [](const auto&, const auto&, const auto&) {};
  EXPECT_THROW(visitFramePairs(damagedA, b, 0.0, 1, nothing), FormatError);
  EXPECT_THROW(visitFramePairs(a, damagedB, 0.0, 1, nothing), FormatError);
  UnreadableSamples unreadable;
  std::vector<std::size_t> visited;
  visitFramePairs(
      damagedA,
      damagedB,
      0.0,
      1,
      [&](const FramePair& pair, const TactileFrame& inA, const TactileFrame& inB) {
        EXPECT_EQ(inA.values, inB.values);
        visited.push_back(pair.frameA);
      },
      {},
      &unreadable);
  EXPECT_EQ(visited,
            (std::vector<std::size_t>{0, 1, 2, 5, 6, 7, 8, 9, 13, 14, 15, 16, 17, 18, 19}));
  EXPECT_EQ(unreadable.runs, (std::vector<UnreadableSamples::Run>{{3, 4}, {10, 12}}));
}

}  // namespace
}  // namespace palpate::frame_difference_test
