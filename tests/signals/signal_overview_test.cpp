#include "palpate/signals/signal_overview.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

#include "testing/damaged_profile.h"
#include "testing/testing.h"

namespace palpate::signal_overview_test {
namespace {

// Every bucket against the frames that fall into it, all rows, all kinds.
TEST(SignalOverview, HoldsTheExtremesOfEverySecond) {
  const Profile profile = synthesize({.durationS = 12.0, .grasps = 2, .noiseCounts = 20.0});
  SignalOverview overview(profile);
  EXPECT_FALSE(overview.complete());
  overview.compute();
  ASSERT_TRUE(overview.complete());
  const SignalTable table = SignalTable::of(profile);
  for (std::size_t row = 0; row <= 6; ++row)
    for (const SignalKind kind : kAllSignalKinds) {
      const BucketSeries& series = overview.of(row, kind);
      std::vector<float> low(series.numBuckets(), std::numeric_limits<float>::infinity());
      std::vector<float> high(series.numBuckets(), -std::numeric_limits<float>::infinity());
      for (std::size_t i = 0; i < profile.numFrames(); ++i) {
        const auto second =
            static_cast<std::size_t>((profile.frameTimeUs(i) - profile.frameTimeUs(0)) / 1'000'000);
        const auto value = static_cast<float>(
            valueOf(row == 6 ? wholeFrameSignals(profile.frame(i)) : table.at(i, row), kind));
        low[second] = std::min(low[second], value);
        high[second] = std::max(high[second], value);
      }
      for (std::size_t s = 0; s < low.size(); ++s) {
        if (std::isinf(low[s])) continue;
        EXPECT_FLOAT_EQ(series.minimum(s), low[s]) << row << " second " << s;
        EXPECT_FLOAT_EQ(series.maximum(s), high[s]) << row << " second " << s;
      }
    }
}

TEST(SignalOverview, TellsWhatOnlyAWholePassKnows) {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  for (int i = 0; i < 20; ++i) {
    frame.matrix(2)(3, 3) = i == 7 ? 3600.0F : 100.0F;
    builder.addFrame(1'000'000 + i * 100'000 + (i > 9 ? 5'000'000 : 0), frame.values);
  }
  const Profile profile = builder.finish({});
  SignalOverview overview(profile);
  overview.compute();
  EXPECT_EQ(overview.maximum(), 3600.0);
  EXPECT_EQ(overview.saturatedFrames(), 1u);
  ASSERT_EQ(overview.timing().gaps.size(), 1u);
  EXPECT_EQ(overview.timing().gaps[0].frame, 9u);
  EXPECT_DOUBLE_EQ(overview.timing().gaps[0].seconds, 5.1);
  EXPECT_DOUBLE_EQ(overview.timing().rateHz, 10.0);
}

TEST(SignalOverview, CancelledItKeepsWhatIsReady) {
  const Profile profile = synthesize({.durationS = 60.0, .grasps = 5});
  SignalOverview overview(profile);
  EXPECT_THROW(overview.compute([](double done) { return done < 0.5; }), Cancelled);
  EXPECT_FALSE(overview.complete());
  EXPECT_GT(overview.readyS(), 10.0);
  EXPECT_LT(overview.readyS(), 60.0);
}

TEST(SignalOverview, RefusesWhatMakesNoSense) {
  EXPECT_THROW(SignalOverview(ProfileBuilder(sdh2().layout).finish({})), std::invalid_argument);
  const Profile profile = synthesize({.durationS = 1.0, .grasps = 0});
  EXPECT_THROW(SignalOverview(profile, 0.0), std::invalid_argument);
  SignalOverview overview(profile);
  EXPECT_THROW((void)overview.of(7, SignalKind::kMean), std::out_of_range);
}

TEST(SignalOverview, HasABoundWhateverTimeIsClaimed) {
  // Two frames, a hundred years apart: a bucket per second would be 3.2 billion of them in each
  // series.
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(sdh2().layout->numCells(), 0.0F);
  values[5] = 70.0F;
  builder.addFrame(1, values);
  builder.addFrame(1 + 100LL * 365 * 86'400 * 1'000'000, values);
  SignalOverview overview(builder.finish({}));
  overview.compute();
  const BucketSeries& sums = overview.of(6, SignalKind::kSum);
  EXPECT_LE(sums.numReady() * 7 * 7, 8'388'608u + 49u);
  EXPECT_EQ(sums.maximum(0), 70.0F);
  EXPECT_EQ(sums.maximum(sums.numReady() - 1), 70.0F);
}

// Damage at the beginning, in the middle, at the end: the overview has all other frames, and ends.
TEST(SignalOverview, LeavesOutAndCountsWhatCannotBeRead) {
  const Profile whole = synthesize({.durationS = 60.0, .grasps = 5});
  const std::size_t frames = whole.numFrames();
  SignalOverview expected(whole);
  expected.compute();
  for (const std::size_t first : {std::size_t{0}, frames / 2, frames - 100}) {
    SCOPED_TRACE(first);
    const Profile damaged = testing::withDamage(whole, first, first + 99);
    SignalOverview overview(damaged);
    overview.compute();
    ASSERT_TRUE(overview.complete());
    EXPECT_EQ(overview.unreadable().count, 100u);
    EXPECT_EQ(overview.unreadable().runs,
              (std::vector<UnreadableSamples::Run>{{first, first + 99}}));
    EXPECT_EQ(overview.unreadable().firstFault, "x.palpate: block 7 is damaged");
    EXPECT_EQ(overview.timing().rateHz, expected.timing().rateHz);
    const BucketSeries& now = overview.of(6, SignalKind::kSum);
    const BucketSeries& before = expected.of(6, SignalKind::kSum);
    const auto secondOf = [&](std::size_t frame) {
      return static_cast<std::size_t>((whole.frameTimeUs(frame) - whole.frameTimeUs(0)) /
                                      1'000'000);
    };
    for (std::size_t s = 0; s < now.numBuckets(); ++s) {
      if (s > secondOf(first) && s < secondOf(first + 99)) {
        EXPECT_TRUE(std::isnan(now.maximum(s))) << s;
      } else if (s < secondOf(first) || s > secondOf(first + 99)) {
        EXPECT_EQ(now.maximum(s), before.maximum(s)) << s;
      }
    }
  }
}

}  // namespace
}  // namespace palpate::signal_overview_test
