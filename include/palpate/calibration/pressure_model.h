// Computes pressure from gain and temperature, or from drift and temperature (study, 3.3):
//   P(K, T) = c0 + c1 T + c2 K + c3 K T     P(m, T) = sum c_(3i+j) m^i T^j, i, j = 0..2     [kPa]
// K is the mean of the Gaussian-filtered active taxels of a contact (eq. 3.2) at the sensitivity
// and threshold of the calibration; the model does not hold for a single taxel. The study uses all
// terms and the mean of nine sensors for T. Palpate uses the sensor nearest to the matrix, and only
// the terms that reduce the leave-one-out error.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/calibration/surface.h>
#include <palpate/core/json.h>
#include <palpate/core/option_check.h>

namespace palpate {

// One loading step under a known pressure.
struct PressureSample {
  std::string file;    // file of the recording; may be empty
  std::string sha256;  // of that file
  double pressureKpa = 0.0;
  double staticResponseCounts = 0.0;  // K
  double driftCountsPerS = 0.0;       // m
  // Temperature of the sensor nearest to the matrix, mean over the step [deg C].
  std::optional<double> nearestDegC = std::nullopt;
  std::optional<double> studyDegC =
      std::nullopt;  // temperature by the study's rule (step_report.h)
  // Active area of the steady contact [mm^2]; 0 when not known.
  double activeAreaMm2 = 0.0;
  double durationS = 0.0;  // for how long the load was measured [s]; 0 when not known
  bool used = true;        // false: left out; `notes` gives the reason
  std::vector<std::string> notes = {};
};

struct PressureModelOptions {
  // Whether to use the study's temperature and all terms.
  bool study = false;
  // Temperature for samples, and later for contacts, that have none [deg C].
  double assumedDegC = 35.0;
  // Standard deviation of assumedDegC [deg C]; > 0.
  double assumedSdDegC = 8.0;
  // Area of the stamp [mm^2]; 0 when not known. Rubber distributes a load: more taxels are active
  // than it covers.
  static constexpr OptionRange kIndenterAreaMm2{0.0, 1e6, "mm^2"};
  double indenterAreaMm2 = 0.0;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// A pressure with its uncertainty.
struct PressureEstimate {
  double kpa = 0.0;       // never below 0
  double sdKpa = 0.0;     // of this single estimate
  bool inRange = false;   // within the measured range; otherwise extrapolated
  bool tooLight = false;  // out of range only because it is lighter than all that was measured
  bool temperatureKnown = true;
  double kpaPerCount = 0.0;  // dP / dK
};

// The fitted surfaces and their options.
struct PressureModel {
  Surface gain;   // P(K, T)
  Surface drift;  // P(m, T)
  // m(K, T) [counts/s], to remove the creep of a lasting contact.
  Surface driftOfGain;
  PressureModelOptions options;
  // Ratio of the loaded area to the area of the active taxels, if the area of the stamp is
  // known; the rubber spreads a load over more taxels than it covers.
  double areaFraction = 1.0;
  double areaFractionSd = 0.0;  // scatter from step to step
  // Time after which the lag has ended [s]: median of the steps; 0 when not known.
  double steadyS = 0.0;
  // For how long the creep of a load was measured [s]: median of the samples; 0 when not known.
  double creepMeasuredS = 0.0;
  std::vector<std::string> notes;

  bool valid() const noexcept { return gain.valid; }
  // Whether the loaded area is known. Without it areaFraction is 1, and forces are upper limits.
  bool knowsArea() const noexcept {
    return options.indenterAreaMm2 > 0.0 || areaFraction != 1.0 || areaFractionSd > 0.0;
  }
  // Returns the pressure for a contact's K [counts]. Without a temperature it uses that of the
  // options, with a larger standard deviation. NaN when the model is not valid.
  PressureEstimate pressureAt(double staticResponseCounts, std::optional<double> degC) const;
};

// Fits the model to samples. Throws std::invalid_argument (options).
PressureModel fitPressureModel(std::span<const PressureSample> samples,
                               const PressureModelOptions& options = {});

// JSON of `calibrate pressure`: K{c,rmse_kpa,loo_rmse_kpa,..}, m{..}, and back. Throws Error that
// names what is missing.
Json jsonOf(const PressureModel& model);
PressureModel pressureModelFrom(const Json& json);

}  // namespace palpate
