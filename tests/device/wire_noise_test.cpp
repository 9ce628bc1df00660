// Noise on the tactile line, short form (reliability R6, R7).
#include "device/wire_noise.h"

#include <gtest/gtest.h>

namespace palpate::testing::wire_noise_test {
namespace {

TEST(WireNoise, NoIntactFrameIsLostAndWrongOnesAreCaught) { expectNoiseIsSurvived(20'000); }

TEST(WireNoise, AQuietLineLosesNothing) {
  NoisyLine line({}, 1, [] { return std::size_t{64}; });
  const NoiseCount count = line.run(20'000);
  EXPECT_EQ(count.arrived, 20'000u);
  EXPECT_EQ(count.wrong, 0u);
  EXPECT_EQ(count.stats.skippedBytes, 0u);
}

TEST(WireNoise, HowReadsAreSplitMakesNoDifference) {
  const LineNoise noise{5e-4, 1e-4, 1e-4};
  std::mt19937 sizes(2);
  NoisyLine reference(noise, 7, [&] { return std::size_t{1} + sizes() % 5000; });
  const NoiseCount expected = reference.run(2000);
  ASSERT_GT(expected.corrupt, 100u);
  for (std::size_t size = 1; size <= 64; ++size) {
    NoisyLine line(noise, 7, [size] { return size; });
    const NoiseCount count = line.run(2000);
    ASSERT_EQ(count.arrived, expected.arrived) << size;
    ASSERT_EQ(count.stats.skippedBytes, expected.stats.skippedBytes) << size;
    ASSERT_EQ(count.stats.badChecksums, expected.stats.badChecksums) << size;
    ASSERT_EQ(count.stats.packets, expected.stats.packets) << size;
  }
}

}  // namespace
}  // namespace palpate::testing::wire_noise_test
