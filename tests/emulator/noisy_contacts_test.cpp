#include "palpate/emulator/noisy_contacts.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"

#include "device/stream_hands.h"
#include "testing/testing.h"

namespace palpate::noisy_contacts_test {
namespace {

// Fraction of the frames in which a taxel is active.
double shareActive(const NoisyContacts& made) {
  std::size_t active = 0;
  for (std::size_t i = 0; i < made.profile.numFrames(); ++i) {
    const TactileFrame frame = made.profile.frame(i);
    active +=
        std::any_of(frame.values.begin(), frame.values.end(), [](float v) { return v > 0.0F; });
  }
  return static_cast<double>(active) / static_cast<double>(made.profile.numFrames());
}

// 33.628 + 0.3317 * 30 + 3 * 2.425417 = 50.855; 45.296 + 0.1741 * 45 + 3 * 0.850922 = 55.683
// (methods, section 4).
TEST(NoisyContacts, ThresholdsAreThoseOfTheMethods) {
  EXPECT_EQ(noiseThresholdCounts(sdh2Sensor().matrices[0], 30.0), 51);
  EXPECT_EQ(noiseThresholdCounts(sdh2Sensor().matrices[5], 45.0), 56);
  EXPECT_EQ(noiseThresholdCounts(sdh2Sensor().matrices[5], 45.0, 3.0, 10.0), 46);
  EXPECT_EQ(noiseThresholdCounts(sdh2Sensor().matrices[5], 45.0, 0.0, 100.0), 0);
  EXPECT_EQ(makeNoisyContacts({.frames = 1}).thresholdCounts.at(0), 51);
}

TEST(NoisyContacts, SameSeedSameFrames) {
  const NoisyContacts one = makeNoisyContacts({.seed = 5, .frames = 200, .belowCounts = 5.0});
  const NoisyContacts same = makeNoisyContacts({.seed = 5, .frames = 200, .belowCounts = 5.0});
  const NoisyContacts other = makeNoisyContacts({.seed = 6, .frames = 200, .belowCounts = 5.0});
  bool differs = false;
  for (std::size_t i = 0; i < 200; ++i) {
    ASSERT_EQ(one.profile.frame(i).values, same.profile.frame(i).values);
    EXPECT_TRUE(one.profile.frame(i).isCounts());
    differs |= one.profile.frame(i).values != other.profile.frame(i).values;
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(one.truth, same.truth);
}

// With a threshold far above the noise, active taxels are touched, and nearly all touched taxels
// are active.
TEST(NoisyContacts, TruthIsWhatTheSensorReportsWithoutNoise) {
  const NoisyContacts made = makeNoisyContacts({.frames = 3000, .belowCounts = -40.0});
  std::size_t ghosts = 0, touched = 0, seen = 0;
  for (std::size_t i = 0; i < made.profile.numFrames(); ++i) {
    const TactileFrame frame = made.profile.frame(i);
    ASSERT_EQ(made.truth[i].size(), frame.values.size());
    for (std::size_t place = 0; place < frame.values.size(); ++place) {
      const bool active = frame.values[place] > 0.0F;
      ghosts += made.truth[i][place] == CellTruth::kNothing && active;
      touched += made.truth[i][place] == CellTruth::kTouched;
      seen += made.truth[i][place] == CellTruth::kTouched && active;
    }
  }
  EXPECT_EQ(ghosts, 0u);
  EXPECT_GT(touched, 1000u);
  EXPECT_GT(static_cast<double>(seen), 0.98 * static_cast<double>(touched));
}

TEST(NoisyContacts, LowerThresholdsShowMoreGhosts) {
  double before = -1.0;
  for (const double below : {-10.0, 0.0, 5.0, 10.0}) {
    const NoisyContacts made =
        makeNoisyContacts({.frames = 400, .belowCounts = below, .contacts = false});
    for (const auto& frame : made.truth)
      ASSERT_TRUE(std::all_of(frame.begin(), frame.end(), [](CellTruth truth) {
        return truth == CellTruth::kNothing;
      }));
    EXPECT_TRUE(made.contacts.empty());
    const double share = shareActive(made);
    if (below < 10.0) {
      EXPECT_GT(share, before) << below;
    }
    before = share;
  }
  EXPECT_EQ(before, 1.0);  // all taxels at rest are above such a threshold
}

// With equal peak pressures, sizes differ in the largest number of taxels touched at once.
TEST(NoisyContacts, SizesComeInTurnOnAllMatrices) {
  const NoisyContacts made = makeNoisyContacts({.frames = 3000, .minKpa = 40.0, .maxKpa = 40.0});
  ASSERT_GE(made.contacts.size(), 30u);
  std::map<ContactSize, double> taxels;
  std::map<ContactSize, std::size_t> number;
  std::map<std::pair<ContactSize, std::size_t>, int> combinations;
  std::size_t end = 0;
  for (const NoisyContact& contact : made.contacts) {
    EXPECT_GE(contact.begin, end);
    end = contact.end;
    if (end == made.profile.numFrames()) continue;  // cut off
    std::ptrdiff_t most = 0;
    for (std::size_t i = contact.begin; i < contact.end; ++i)
      most = std::max(most,
                      std::count(made.truth[i].begin(), made.truth[i].end(), CellTruth::kTouched));
    taxels[contact.size] += static_cast<double>(most);
    ++number[contact.size];
    ++combinations[{contact.size, contact.matrix}];
    // The contact has ended before the next one begins.
    const auto& last = made.truth[contact.end - 1];
    EXPECT_EQ(std::count(last.begin(), last.end(), CellTruth::kTouched), 0);
  }
  EXPECT_EQ(combinations.size(), kAllContactSizes.size() * made.profile.layout().numMatrices());
  double before = 0.0;
  for (const ContactSize size : kAllContactSizes) {
    const double mean = taxels[size] / static_cast<double>(number[size]);
    EXPECT_GT(mean, before) << nameOf(size);
    before = mean;
  }
}

TEST(NoisyContacts, AreThoseOfAnyHand) {
  NoisyContactsOptions options;
  options.frames = 300;
  options.hand = builtInHand("parallel_gripper");
  const NoisyContacts made = makeNoisyContacts(options);
  EXPECT_EQ(made.profile.hand().name, options.hand.name);
  EXPECT_EQ(made.profile.layout().numCells(), 168u);
  // Noise line 5 and three times its RMSE of 1.
  EXPECT_EQ(made.thresholdCounts, (std::vector<int>{8, 8}));
  ASSERT_GE(made.contacts.size(), 2u);
  EXPECT_LT(made.contacts[0].matrix, 2u);
  options.hand = testing::padHand({{14, 6}, {1, 5}});
  EXPECT_THROW(makeNoisyContacts(options), std::invalid_argument);
}

TEST(NoisyContacts, RefusesWhatMakesNoSense) {
  EXPECT_THROW(makeNoisyContacts({.frames = 0}), std::invalid_argument);
  EXPECT_THROW(makeNoisyContacts({.rateHz = 0.0}), std::invalid_argument);
  EXPECT_THROW(makeNoisyContacts({.degC = -1.0}), std::invalid_argument);
  EXPECT_THROW(makeNoisyContacts({.sensitivity = 2.0}), std::invalid_argument);
  EXPECT_THROW(makeNoisyContacts({.belowCounts = 1e9}), std::invalid_argument);
  EXPECT_THROW(makeNoisyContacts({.minKpa = 10.0, .maxKpa = 5.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::noisy_contacts_test
