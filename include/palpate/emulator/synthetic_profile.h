// Synthetic recordings with known truth: noise-free by default, noise as an option. Fingers 0 and 2
// repeatedly pinch a ball: contact grows, holds and is released; angles and temperatures follow.
// Used by tests and examples.
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/model/profile.h>

namespace palpate {

struct SyntheticOptions {
  static constexpr OptionRange kDurationS{0.001, 86'400.0, "s"};
  static constexpr OptionRange kRateHz{0.1, 1000.0, "Hz"};
  static constexpr OptionRange kGrasps{0, 10'000};
  static constexpr OptionRange kPeakCounts{50.0, 3500.0, "counts"};
  static constexpr OptionRange kNoiseCounts{0.0, 1000.0, "counts"};
  double durationS = 12.0;         // [s]
  double rateHz = 31.7;            // tactile frames [Hz]
  double angleRateHz = 160.0;      // joint angles [Hz], 0..1000; 0: none
  double temperatureRateHz = 1.0;  // [Hz], 0..100; 0: none
  // Number of grasps, spread evenly; each needs 12 frames.
  int grasps = 3;
  // Value under the centre of the contact [counts].
  double peakCounts = 1800.0;
  // Standard deviation of the contact's pressure distribution [taxels], 0.5..5.
  double contactRadiusTaxels = 2.4;
  // Subtracted by the sensor; lower values read 0 [counts].
  double thresholdCounts = 100.0;
  double noiseCounts = 0.0;  // standard deviation of the noise on loaded taxels [counts]
  std::uint32_t seed = 1;    // seed of the noise
  // Time of the first frame [us since 1970].
  std::int64_t startUs = 1'700'000'000'000'000;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Ground truth of a synthetic recording.
struct SyntheticGrasp {
  std::size_t begin = 0;  // first frame with contact
  std::size_t end = 0;    // last frame with contact (both inclusive)
};
struct SyntheticTruth {
  std::vector<SyntheticGrasp> grasps;
};

// The same options give the same profile, byte for byte (on machines whose exp and tanh agree).
// Counts are whole numbers, 0..3560.
Profile synthesize(const SyntheticOptions& options = {}, SyntheticTruth* truth = nullptr);

}  // namespace palpate
