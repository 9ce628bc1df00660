#include "palpate/calibration/sensitivity_search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::sensitivity_search_test {
namespace {

// A sensor that reads gain * s - threshold, up to 3560; lets the search settle, returns how often
// it set.
int settle(
    SensitivitySearch& search, double gain, double threshold, double& timeS, int frames = 2000) {
  int settings = 0;
  for (int i = 0; i < frames; ++i) {
    timeS += 0.03;
    const double counts = std::clamp(gain * search.sensitivity() - threshold, 0.0, 3560.0);
    settings += search.observe(timeS, counts) ? 1 : 0;
  }
  return settings;
}

const SensitivitySearchOptions kOptions{.saturationCounts = 3500.0};

TEST(SensitivitySearch, FindsTheHighestWithoutSaturation) {
  for (const double gain : {2000.0, 4000.0, 6000.0, 12'000.0, 30'000.0}) {
    for (const double start : {0.1, 0.5, 1.0}) {
      double timeS = 0.0;
      SensitivitySearch search(start, 100.0, kOptions);
      const int settings = settle(search, gain, 100.0, timeS);
      const double counts = gain * search.sensitivity() - 100.0;
      const double limit = 3600.0 / gain;
      EXPECT_TRUE(search.settled()) << gain << " from " << start;
      EXPECT_LT(counts, 3500.0) << gain << " from " << start;
      EXPECT_GE(search.sensitivity(), std::min({1.0, 0.85 * limit - 0.03}))
          << gain << " from " << start;
      EXPECT_LE(settings, 9) << "each pauses the stream";
    }
  }
}

TEST(SensitivitySearch, SaysWhereNothingHelps) {
  double timeS = 0.0;
  SensitivitySearch search(0.5, 100.0, kOptions);
  settle(search, 80'000.0, 100.0, timeS);
  EXPECT_TRUE(search.saturated());
  EXPECT_EQ(search.sensitivity(), 0.1);
}

TEST(SensitivitySearch, GoesDownAtOnceWhenTheLoadGrowsAndUpAfterAWhileWhenItFalls) {
  double timeS = 0.0;
  SensitivitySearch search(0.5, 100.0, kOptions);
  settle(search, 4000.0, 100.0, timeS);
  const double before = search.sensitivity();
  EXPECT_TRUE(search.observe(timeS += 0.03, 3560.0)) << "the first saturated frame";
  settle(search, 9000.0, 100.0, timeS);
  EXPECT_LT(search.sensitivity(), before);
  EXPECT_LT(9000.0 * search.sensitivity() - 100.0, 3500.0);
  settle(search, 3000.0, 100.0, timeS);
  EXPECT_EQ(search.sensitivity(), 1.0);
}

TEST(SensitivitySearch, IgnoresFramesWithoutContactOrNumbers) {
  SensitivitySearch search(0.5, 100.0, kOptions);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(search.observe(i, 0.0));
    EXPECT_FALSE(search.observe(i, std::nan("")));
  }
  EXPECT_FALSE(search.settled());
}

TEST(SensitivitySearch, RefusesBadOptions) {
  EXPECT_THROW(SensitivitySearch(0.05, 0.0), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, -1.0), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, 0.0, {.least = 0.0}), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, 0.0, {.most = 1.5}), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, 0.0, {.resolution = 0.0}), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, 0.0, {.saturationCounts = 0.0}), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, 0.0, {.headroom = 1.0}), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, 0.0, {.framesPerTrial = 0}), std::invalid_argument);
  EXPECT_THROW(SensitivitySearch(0.5, 0.0, {.resetUpperBoundAfterS = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::sensitivity_search_test
