// Noise on the tactile line, a million frames per rate (reliability R6, R7).
#include <gtest/gtest.h>

#include "device/wire_noise.h"

namespace palpate::testing::wire_noise_slow_test {
namespace {

TEST(WireNoiseSlow, AMillionFramesPerRate) { expectNoiseIsSurvived(1'000'000); }

TEST(WireNoiseSlow, HowReadsAreSplitMakesNoDifference) {
  const LineNoise noise{1e-4, 2e-5, 2e-5};
  std::mt19937 sizes(2);
  NoisyLine reference(noise, 7, [&] { return std::size_t{1} + sizes() % 5000; });
  const NoiseCount expected = reference.run(1'000'000);
  for (std::size_t size = 1; size <= 64; size += 9) {
    NoisyLine line(noise, 7, [size] { return size; });
    const NoiseCount count = line.run(1'000'000);
    ASSERT_EQ(count.arrived, expected.arrived) << size;
    ASSERT_EQ(count.stats.skippedBytes, expected.stats.skippedBytes) << size;
    ASSERT_EQ(count.stats.packets, expected.stats.packets) << size;
  }
}

}  // namespace
}  // namespace palpate::testing::wire_noise_slow_test
