#include "palpate/slip/slip_series.h"

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"

namespace palpate::slip_series_test {
namespace {

constexpr std::size_t kMatrix = 1;
constexpr std::size_t kRests = 40;  // frames
constexpr std::size_t kMoves = 15;  // then; a quarter of a taxel each
constexpr std::size_t kAfter = 40;  // rests again
constexpr double kStep = 0.25;      // [taxels] down
constexpr std::int64_t kIntervalUs = 32'000;
constexpr std::int64_t kStartUs = 1'400'000'000'000'000;
constexpr std::size_t kUntouched = 5;  // frames at the beginning

// A disc on one matrix rests, moves down by 3.75 taxels, and rests again.
Profile movingDisc() {
  const HandDescription& hand = sdh2();
  ProfileBuilder builder(hand.layout);
  SyntheticSensor sensor{.layout = hand.layout->matrix(kMatrix)};
  SyntheticSlip slip(sensor, 7);
  for (std::size_t i = 0; i < kUntouched + kRests + kMoves + kAfter; ++i) {
    TactileFrame frame(hand.layout);
    if (i >= kUntouched) {
      const std::size_t k = i - kUntouched;
      const double moved = k < kRests ? 0.0 : static_cast<double>(std::min(k - kRests + 1, kMoves));
      slip.read({.shape = SlipShape::kBar, .x = 2.5, .y = 4.0 + kStep * moved},
                frame.matrix(kMatrix));
    }
    builder.addFrame(kStartUs + static_cast<std::int64_t>(i) * kIntervalUs, frame.values);
  }
  return builder.finish({});
}

class SlipSeriesTest : public ::testing::Test {
 protected:
  static const Profile& profile() {
    static const Profile made = movingDisc();
    return made;
  }
};

TEST_F(SlipSeriesTest, KnowsTheMotionAndWhenItSlipped) {
  const SlipSeries series = slipSeries(profile(), {.method = SlipMethod::kRegister});
  ASSERT_EQ(series.timeS.size(), profile().numFrames());
  EXPECT_NEAR(series.timeS[10], 0.32, 1e-9);
  EXPECT_TRUE(series.matrices[0].empty());
  ASSERT_EQ(series.matrices[kMatrix].size(), kRests + kMoves + kAfter);
  EXPECT_EQ(series.at(kMatrix, kUntouched - 1), nullptr);
  ASSERT_FALSE(series.slips.empty());
  EXPECT_EQ(series.slips.front().matrix, kMatrix);
  const std::size_t begins = kUntouched + kRests;
  EXPECT_NEAR(static_cast<double>(series.slips.front().begin), static_cast<double>(begins), 3.0);
  const SlipSample* during = series.at(kMatrix, begins + 9);
  ASSERT_NE(during, nullptr);
  EXPECT_TRUE(during->slipping);
  ASSERT_TRUE(during->valid && during->refValid);
  EXPECT_NEAR(static_cast<double>(during->dy), kStep, 0.05);
  EXPECT_NEAR(static_cast<double>(during->refDy), 10 * kStep, 0.1);
  EXPECT_NEAR(static_cast<double>(during->refDx), 0.0, 0.1);
}

TEST_F(SlipSeriesTest, ThePathLeadsFromTheReferenceToWhereTheContactIs) {
  const SlipSeries series =
      slipSeries(profile(), {.method = SlipMethod::kCentroid, .reference = SlipReference::kFirst});
  const std::size_t last = kUntouched + kRests + kMoves;
  const auto path = series.pathUntil(kMatrix, last);
  ASSERT_EQ(path.size(), kRests + kMoves + 1);
  EXPECT_NEAR(path.front().y, 4.0, 0.1);
  EXPECT_NEAR(path.back().y, 4.0 + kStep * static_cast<double>(kMoves), 0.1);
  EXPECT_NEAR(path.back().x, 2.5, 0.1);
  EXPECT_TRUE(series.pathUntil(kMatrix, 0).empty()) << "no contact";
  EXPECT_TRUE(series.pathUntil(0, last).empty());
  const auto thinned = series.pathUntil(kMatrix, last, 10);
  EXPECT_LE(thinned.size(), 11U);
  EXPECT_EQ(thinned.back().y, path.back().y);
}

TEST_F(SlipSeriesTest, AToldFrameIsTheReference) {
  const std::size_t told = kUntouched + kRests + 3;  // four steps done
  const SlipSeries series =
      slipSeries(profile(), {.method = SlipMethod::kCentroid, .referenceFrame = told});
  EXPECT_FALSE(series.at(kMatrix, told - 1)->refValid);
  const SlipSample* end = series.at(kMatrix, kUntouched + kRests + kMoves);
  ASSERT_TRUE(end && end->refValid);
  EXPECT_NEAR(static_cast<double>(end->refDy), kStep * static_cast<double>(kMoves - 4), 0.1);
  const auto path = series.pathUntil(kMatrix, kUntouched + kRests + kMoves);
  ASSERT_FALSE(path.empty());
  EXPECT_NEAR(path.front().y, 5.0, 0.15);
}

TEST_F(SlipSeriesTest, ThresholdsDecide) {
  SlipSeriesOptions options{.method = SlipMethod::kCentroid, .reference = SlipReference::kFirst};
  EXPECT_FALSE(slipSeries(profile(), options).slips.empty());
  options.stepTaxels = 1.0;
  options.referenceTaxels = 10.0;
  EXPECT_TRUE(slipSeries(profile(), options).slips.empty());
  options.stepTaxels = 0.0;
  EXPECT_THROW(slipSeries(profile(), options), std::invalid_argument);
}

TEST_F(SlipSeriesTest, CanBeCancelled) {
  EXPECT_THROW(slipSeries(profile(), {}, [](double) { return false; }), Cancelled);
}

TEST_F(SlipSeriesTest, FramesAreFoundByTimeAndSpan) {
  const SlipSeries series = slipSeries(profile(), {.method = SlipMethod::kCentroid});
  EXPECT_EQ(series.frameAt(-1.0), 0U);
  EXPECT_EQ(series.frameAt(0.33), 10U);
  EXPECT_EQ(series.frameAt(1e9), profile().numFrames() - 1);
  const auto some = series.between(kMatrix, 0, kUntouched + 1);
  ASSERT_EQ(some.size(), 2U);
  EXPECT_EQ(some.front().frame, kUntouched);
  EXPECT_TRUE(series.between(kMatrix, 9, 8).empty());
  EXPECT_THROW(series.at(99, 0), std::out_of_range);
}

TEST_F(SlipSeriesTest, ForgetsItsBeginning) {
  SlipSeries series = slipSeries(profile(), {.method = SlipMethod::kRegister});
  const SlipSample before = *series.at(kMatrix, 30);
  const auto slip = series.slips.front();
  series.dropFirst(20);
  EXPECT_NEAR(series.timeS.front(), 0.64, 1e-9);
  ASSERT_NE(series.at(kMatrix, 10), nullptr);
  EXPECT_EQ(series.at(kMatrix, 10)->y, before.y);
  EXPECT_EQ(series.slips.front().begin + 20, slip.begin);
}

TEST_F(SlipSeriesTest, AnEmptyRecordingHasNone) {
  ProfileBuilder builder(sdh2().layout);
  const SlipSeries series = slipSeries(builder.finish({}));
  EXPECT_TRUE(series.timeS.empty() && series.slips.empty());
  EXPECT_EQ(series.frameAt(3.0), 0U);
  EXPECT_EQ(series.matrices.size(), sdh2().layout->numMatrices());
}

// A block of damage may be shorter than a gap. What happened in it is not one large step.
TEST_F(SlipSeriesTest, DamagedFramesAreLeftOutLikeAGap) {
  const std::size_t first = kUntouched + kRests - 2, last = kUntouched + kRests + kMoves + 2;
  const SlipSeries series =
      slipSeries(testing::withDamage(profile(), first, last), {.method = SlipMethod::kRegister});
  EXPECT_EQ(series.unreadable.count, last - first + 1);
  ASSERT_EQ(series.timeS.size(), profile().numFrames());
  EXPECT_NEAR(series.timeS[first + 1], static_cast<double>(first + 1) * 0.032, 1e-9);
  EXPECT_TRUE(series.slips.empty()) << "all of the motion was in the damaged frames";
  EXPECT_NE(series.at(kMatrix, first - 1), nullptr);
  EXPECT_EQ(series.at(kMatrix, first), nullptr);
  EXPECT_EQ(series.at(kMatrix, last), nullptr);
  const SlipSample* behind = series.at(kMatrix, last + 1);
  ASSERT_NE(behind, nullptr);
  EXPECT_FALSE(behind->valid) << "motion since a frame that wasn't read";
  EXPECT_TRUE(series.at(kMatrix, last + 3)->valid);

  const SlipSeries atEnd = slipSeries(testing::withDamage(profile(), 90, 99), {});
  EXPECT_EQ(atEnd.timeS.size(), profile().numFrames());
}

}  // namespace
}  // namespace palpate::slip_series_test
