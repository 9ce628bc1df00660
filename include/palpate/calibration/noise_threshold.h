// Proposes settings for the high-sensitivity mode (study, 3.4): sensitivity 1.0 and thresholds
// theta_m(T) = line + 3 RMSE [counts] that follow the measured temperatures. A change of settings
// pauses the stream for some hundred ms, so thresholds change in steps. If noise reduces the frame
// rate (run-length coding becomes inefficient), the thresholds rise until the rate recovers. This
// class only proposes settings; the owner of the device applies them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/calibration/noise_floor.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/sensor_characteristics.h>

namespace palpate {

// The settings for all matrices.
struct TactileThresholds {
  double sensitivity = 1.0;
  std::vector<int> counts;  // one per matrix
  bool operator==(const TactileThresholds&) const = default;
};

struct NoiseThresholdOptions {
  double sigmas = 3.0;       // distance of the threshold from the line [RMSE]; 0..20
  double sensitivity = 1.0;  // of the mode; 0..1
  int minCounts = 0;         // lower limit of thresholds
  int maxCounts = 1000;      // upper limit of thresholds, also for the guard
  // A threshold changes when the wanted one is this much above it, or twice this much below; >= 1.
  int hysteresisCounts = 3;
  // Shortest time between two settings [s], >= 0; a rising guard waits only guardWindowS.
  double minIntervalS = 10;
  // Guard against a collapsing frame rate: if the rate stays below rateCollapseFraction of the
  // usual rate for guardWindowS [s], all thresholds rise by guardStepCounts; after guardCalmS [s]
  // above it they fall by the same amount.
  double rateCollapseFraction = 0.6;  // 0..1
  double guardWindowS = 1.0;          // > 0
  double guardCalmS = 60.0;           // > 0
  int guardStepCounts = 10;           // >= 1

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Returns the threshold for a temperature, rounded up. Outside of the measured temperatures the
// line is extrapolated, so that noise stays below the threshold when the hand gets warmer.
int noiseThreshold(const NoiseLine& line, double degC, const NoiseThresholdOptions& options = {});

// State of the guard, and matrices with uncertain thresholds.
struct NoiseThresholdStatus {
  bool guarding = false;      // thresholds are raised
  int guardCounts = 0;        // by this much
  bool guardAtLimit = false;  // the guard cannot raise them further
  // Matrices outside of the temperatures at which their line was measured.
  std::vector<std::size_t> extrapolated;
  // Matrices without a temperature or a line; they keep the reset value.
  std::vector<std::size_t> unknown;
};

// Follows temperatures and rate; not thread-safe. The caller passes times, which must not decrease.
class NoiseThresholds {
 public:
  // `sensors`: for each matrix the nearest temperature sensor. `reset`: settings of matrices
  // without a line. `usualRateHz`: frames per second without noise. Throws std::invalid_argument
  // (options, sizes, rate).
  NoiseThresholds(NoiseFloor floor,
                  std::vector<std::optional<std::size_t>> sensors,
                  TactileThresholds reset,
                  double usualRateHz,
                  NoiseThresholdOptions options = {});

  // Takes the newest temperatures (deg C; 0 or NaN: not known) and frame rate (NaN: not known).
  // Returns the settings to apply now; empty when nothing must change. The first call always
  // returns settings.
  std::optional<TactileThresholds> update(double timeS,
                                          std::span<const double> degC,
                                          double rateHz);
  const NoiseThresholdStatus& status() const noexcept { return status_; }
  // The last settings that update() returned.
  const TactileThresholds& proposed() const noexcept { return proposed_; }

 private:
  bool watchRate(double timeS, double rateHz);
  std::vector<int> wanted(std::span<const double> degC);

  NoiseFloor floor_;
  std::vector<std::optional<std::size_t>> sensors_;
  TactileThresholds reset_, proposed_;
  double usualRateHz_;
  NoiseThresholdOptions options_;
  NoiseThresholdStatus status_;
  std::optional<double> lastSetS_, slowSinceS_, calmSinceS_;
};

// The nearest temperature sensor of each matrix, from the hand's description.
std::vector<std::optional<std::size_t>> nearestSensors(const HandDescription& hand);

}  // namespace palpate
