// Synthetic recordings with known truth: perfect first, noise as an option. A pinch grasp of a ball
// by fingers 0 and 2, repeated: contact grows, holds, is released; angles and temperatures follow.
#pragma once

#include <cstdint>
#include <vector>

#include <palpate/model/profile.h>

namespace palpate {

struct SyntheticOptions {
  double durationS = 12.0;         // [s], > 0, at most 86,400
  double rateHz = 31.7;            // tactile frames [Hz], 0.1..1000
  double angleRateHz = 160.0;      // joint angles [Hz], 0..1000; 0: none
  double temperatureRateHz = 1.0;  // [Hz], 0..100; 0: none
  int grasps = 3;                  // 0..10,000, spread evenly; each needs 12 frames
  double peakCounts = 1800.0;      // value under the middle of the contact [counts], 50..3500
  // standard deviation of the contact's pressure [taxels], 0.5..5
  double contactRadiusTaxels = 2.4;
  double thresholdCounts = 100.0;  // subtracted by the sensor; lower values read 0 [counts]
  double noiseCounts = 0.0;        // standard deviation of the noise on loaded taxels [counts]
  std::uint32_t seed = 1;          // of the noise
  std::int64_t startUs = 1'700'000'000'000'000;  // first frame [us since 1970]

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// What is true of a synthetic recording.
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
