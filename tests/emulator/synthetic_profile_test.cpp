#include "palpate/emulator/synthetic_profile.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/model/timing.h"
#include "palpate/signals/characteristic_signals.h"

#include "testing/testing.h"

namespace palpate::synthetic_profile_test {
namespace {

TEST(SyntheticProfile, HasTheAskedTimesAndRates) {
  const Profile profile = synthesize({.durationS = 10.0, .rateHz = 31.25});
  EXPECT_EQ(profile.numFrames(), 313u);  // 0, 32, .. 9984 ms
  const TimingReport timing = timingOf(profile);
  EXPECT_DOUBLE_EQ(timing.rateHz, 31.25);
  EXPECT_TRUE(timing.gaps.empty());
  EXPECT_EQ(profile.numAngles(), 1601u);
  EXPECT_EQ(profile.numTemperatures(), 11u);
  EXPECT_EQ(profile.info().valueType, ValueType::kCounts);
}

TEST(SyntheticProfile, TruthIsWhatAFreshLookFinds) {
  SyntheticTruth truth;
  const Profile profile = synthesize({.grasps = 4, .noiseCounts = 8.0}, &truth);
  const SignalTable table = SignalTable::of(profile);
  ASSERT_EQ(truth.grasps.size(), 4u);
  std::vector<bool> inGrasp(profile.numFrames(), false);
  for (const SyntheticGrasp& grasp : truth.grasps)
    for (std::size_t i = grasp.begin; i <= grasp.end; ++i) inGrasp[i] = true;
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    EXPECT_EQ(table.at(i, 1).active > 0, inGrasp[i]) << i;
}

TEST(SyntheticProfile, ContactsPeakWhereAndHowHighTheyShould) {
  const Profile profile = synthesize({.durationS = 4.0, .grasps = 1, .peakCounts = 1500.0});
  const SignalTable table = SignalTable::of(profile);
  const TactileFrame frame = profile.frame(table.frameOfLargestSum());
  Eigen::Index y = 0;
  Eigen::Index x = 0;
  const float largest = frame.matrix(1).maxCoeff(&y, &x);
  EXPECT_EQ(x, 3);  // centre at 2.7
  // Centre at 8.1, creeping by 0.5 during the contact; the largest sum occurs before the release
  // (at 0.88 of the contact): 8.54.
  EXPECT_NEAR(static_cast<double>(y), 8.54, 0.51);
  // The sensor saturates gradually (tanh towards 3560), so the peak is a little below the given
  // value.
  EXPECT_GT(largest, 1200.0F);
  EXPECT_LT(largest, 1500.0F);
  for (std::size_t m : {0u, 2u, 3u, 4u}) EXPECT_EQ(frame.matrix(m).maxCoeff(), 0.0F) << m;
  EXPECT_TRUE(frame.isCounts());
}

TEST(SyntheticProfile, MaskedPlacesStayZeroAndNothingExceedsTheSensor) {
  const Profile profile =
      synthesize({.peakCounts = 3500.0, .contactRadiusTaxels = 5.0, .noiseCounts = 200.0});
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const TactileFrame frame = profile.frame(i);
    ASSERT_LE(*std::max_element(frame.values.begin(), frame.values.end()), 3560.0F);
    for (int row = 0; row < 5; ++row) {
      ASSERT_EQ(frame.matrix(1)(row, 0), 0.0F);
      ASSERT_EQ(frame.matrix(5)(row, 5), 0.0F);
    }
  }
}

TEST(SyntheticProfile, SameOptionsSameProfileOtherSeedOtherNoise) {
  const SyntheticOptions options{.durationS = 3.0, .grasps = 1, .noiseCounts = 10.0, .seed = 5};
  SyntheticOptions other = options;
  other.seed = 6;
  const Profile a = synthesize(options);
  const Profile b = synthesize(options);
  const Profile c = synthesize(other);
  bool differs = false;
  for (std::size_t i = 0; i < a.numFrames(); ++i) {
    EXPECT_EQ(a.frame(i).values, b.frame(i).values);
    differs = differs || a.frame(i).values != c.frame(i).values;
  }
  EXPECT_TRUE(differs);
}

TEST(SyntheticProfile, RefusesNonsense) {
  EXPECT_THROW(synthesize({.durationS = -1.0}), std::invalid_argument);
  EXPECT_THROW(synthesize({.rateHz = 0.0}), std::invalid_argument);
  EXPECT_THROW(synthesize({.grasps = -1}), std::invalid_argument);
  EXPECT_THROW(synthesize({.peakCounts = 5000.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::synthetic_profile_test
