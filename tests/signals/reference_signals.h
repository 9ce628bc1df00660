// The two signals of the reference values of SciPy for mean spectra and coherence.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace palpate::testing {

inline constexpr double kReferenceRateHz = 50.0;
inline constexpr std::size_t kReferenceSamples = 600;

// Even noise -0.5..0.5 by the generator x = (1664525 x + 1013904223) mod 2^32.
inline std::vector<double> referenceNoise(std::uint32_t seed) {
  std::vector<double> noise;
  for (std::size_t i = 0; i < kReferenceSamples; ++i) {
    seed = 1'664'525U * seed + 1'013'904'223U;
    noise.push_back(static_cast<double>(seed) / 4'294'967'296.0 - 0.5);
  }
  return noise;
}
inline std::vector<double> referenceTimes() {
  std::vector<double> timeS;
  for (std::size_t i = 0; i < kReferenceSamples; ++i)
    timeS.push_back(static_cast<double>(i) / kReferenceRateHz);
  return timeS;
}
// 100 + 40 sin(5.3 Hz) + 15 cos(12.5 Hz) + 10 noise(1).
inline std::vector<double> referenceA() {
  const std::vector<double> noise = referenceNoise(1);
  std::vector<double> values;
  for (std::size_t i = 0; i < kReferenceSamples; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / kReferenceRateHz;
    values.push_back(100.0 + 40.0 * std::sin(5.3 * turn) + 15.0 * std::cos(12.5 * turn) +
                     10.0 * noise[i]);
  }
  return values;
}
}  // namespace palpate::testing
