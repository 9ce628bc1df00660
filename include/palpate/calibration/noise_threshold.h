// High-sensitivity mode (study, 3.4): sensitivity 1.0 and thresholds theta_m(T) = line + 3 RMSE
// [counts] that follow the measured temperatures. A change of settings pauses the stream for some
// hundred ms, so thresholds change in steps. If noise reduces the frame rate (run-length coding
// becomes inefficient), the thresholds rise until the rate recovers. This class only proposes
// settings; the owner of the device applies them.
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

// What every matrix is to be set to.
struct TactileThresholds {
  double sensitivity = 1.0;
  std::vector<int> counts;  // one per matrix
  bool operator==(const TactileThresholds&) const = default;
};

// Settings at power-up: what "reset" gives (SDH-2: 0.5; 150 proximal, 300 distal).
TactileThresholds resetThresholds(const SensorCharacteristics& sensor);

struct NoiseThresholdOptions {
  double sigmas = 3.0;       // above the line; 0..20
  double sensitivity = 1.0;  // of the mode; 0..1
  int minCounts = 0;         // never below
  int maxCounts = 1000;      // never above; the limit of the guard as well
  // a threshold moves when the wanted one is so far above it (and twice that below); >= 1
  int hysteresisCounts = 3;
  // between two settings; a rising guard waits only guardWindowS [s], >= 0
  double minIntervalS = 10;
  // Guard against a collapsing frame rate: if the rate stays below rateCollapseFraction of the
  // usual rate for guardWindowS [s], all thresholds rise by guardStepCounts; after guardCalmS [s]
  // above it they fall by the same amount.
  double rateCollapseFraction = 0.6;  // 0..1
  double guardWindowS = 1.0;          // > 0
  double guardCalmS = 60.0;           // > 0
  int guardStepCounts = 10;           // >= 1

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Of one line at one temperature, rounded up. Outside the measured temperatures the line goes on:
// noise must not break through only because it got warmer.
int noiseThreshold(const NoiseLine& line, double degC, const NoiseThresholdOptions& options = {});

struct NoiseThresholdStatus {
  bool guarding = false;      // thresholds are raised
  int guardCounts = 0;        // by so much
  bool guardAtLimit = false;  // and can't rise further
  // matrices outside the temperatures that their line was measured at
  std::vector<std::size_t> extrapolated;
  // matrices without a temperature or line: the reset value stands
  std::vector<std::size_t> unknown;
};

// Follows temperatures and rate; not thread-safe. Times are the caller's and never go back.
class NoiseThresholds {
 public:
  // sensors: for each matrix the temperature sensor nearest to it. reset: what matrices without a
  // line keep. usualRateHz: frames per second without noise. Throws std::invalid_argument (options,
  // sizes, rate).
  NoiseThresholds(NoiseFloor floor,
                  std::vector<std::optional<std::size_t>> sensors,
                  TactileThresholds reset,
                  double usualRateHz,
                  NoiseThresholdOptions options = {});

  // Looks at the newest temperatures (deg C, 0 or NaN: not known) and rate (NaN: not known). What
  // has to be set now; nothing: all is well. The first call proposes always.
  std::optional<TactileThresholds> update(double timeS,
                                          std::span<const double> degC,
                                          double rateHz);
  const NoiseThresholdStatus& status() const noexcept { return status_; }
  const TactileThresholds& proposed() const noexcept { return proposed_; }  // last

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

// For a hand as it is described.
std::vector<std::optional<std::size_t>> nearestSensors(const HandDescription& hand);

}  // namespace palpate
