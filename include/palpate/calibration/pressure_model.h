// Pressure from gain and temperature, or from drift and temperature (study, 3.3):
//   P(K, T) = c0 + c1 T + c2 K + c3 K T     P(m, T) = sum c_(3i+j) m^i T^j, i, j = 0..2     [kPa]
// K is the mean of the Gaussian-filtered active taxels of a contact (eq. 3.2), at the sensitivity
// and threshold of the calibration: never a single taxel. The study keeps all terms and takes the
// mean of nine sensors for T; we take the sensor nearest to the matrix, and keep a term only where
// leave-one-out says so.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/calibration/surface.h>
#include <palpate/core/json.h>

namespace palpate {

// One loading step under a known pressure.
struct PressureSample {
  std::string file;    // where it comes from; may be empty
  std::string sha256;  // of that file
  double pressureKpa = 0.0;
  double staticResponseCounts = 0.0;  // K
  double driftCountsPerS = 0.0;       // m
  // sensor nearest to the matrix, mean over the step
  std::optional<double> nearestDegC = std::nullopt;
  std::optional<double> studyDegC = std::nullopt;  // what the study took (step_report.h)
  double activeAreaMm2 = 0.0;                      // of the contact when steady; 0: not known
  bool used = true;                                // false: left out, notes say why
  std::vector<std::string> notes = {};
};

struct PressureModelOptions {
  bool study = false;  // the study's choices: its temperature, all terms
  // where a sample has no temperature, and later where a contact has none
  double assumedDegC = 35.0;
  double assumedSdDegC = 8.0;  // how far off that may be; > 0
  // Of the stamp [mm^2]; 0: not known. Rubber spreads a load: more taxels are active than it
  // covers.
  double indenterAreaMm2 = 0.0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct PressureEstimate {
  double kpa = 0.0;      // never below 0
  double sdKpa = 0.0;    // standard deviation of this one estimate
  bool inRange = false;  // within what was measured; else it is extrapolated
  bool temperatureKnown = true;
  double kpaPerCount = 0.0;  // dP / dK
};

struct PressureModel {
  Surface gain;         // P(K, T)
  Surface drift;        // P(m, T)
  Surface driftOfGain;  // m(K, T) [counts/s]: takes the creep out of a contact that lasts
  PressureModelOptions options;
  // Ratio of the loaded area to the area of the active taxels, if the area of the stamp is
  // known; the rubber spreads a load over more taxels than it covers.
  double areaFraction = 1.0;
  double areaFractionSd = 0.0;  // from step to step
  double steadyS = 0.0;  // after so long the lag is over [s]: median of the steps; 0: not known
  std::vector<std::string> notes;

  bool valid() const noexcept { return gain.valid; }
  // Of a contact's K [counts]; without a temperature that of the options, and a wider band. NaN
  // where not valid.
  PressureEstimate pressureAt(double staticResponseCounts, std::optional<double> degC) const;
};

// Throws std::invalid_argument (options).
PressureModel fitPressureModel(std::span<const PressureSample> samples,
                               const PressureModelOptions& options = {});

// JSON of `calibrate pressure`: K{c,rmse_kpa,loo_rmse_kpa,..}, m{..}, and back. Throws Error naming
// what is missing.
Json jsonOf(const PressureModel& model);
PressureModel pressureModelFrom(const Json& json);

}  // namespace palpate
