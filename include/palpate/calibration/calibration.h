// A calibration of a hand: what turns its counts into kilopascals and newtons, with all that it was
// made from. A JSON file with format version, program version, options and the SHA-256 of every
// input.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/noise_floor.h>
#include <palpate/calibration/pressure_model.h>
#include <palpate/core/json.h>
#include <palpate/core/output_file.h>

namespace palpate {

// Settings of the tactile controller. A .dsa tells neither: they are what somebody said, and the
// file says so.
struct SensorSettings {
  double sensitivity = 1.0;      // 0..1
  double thresholdCounts = 100;  // 0..4095
  bool assumed = true;           // said by a person, not read from the device or the recording
  bool operator==(const SensorSettings&) const = default;
};

struct Calibration {
  static constexpr int kFormatVersion = 1;

  std::string programVersion;
  std::string madeAt;      // UTC, ISO 8601; may be empty
  std::string hand;        // HandDescription::name
  std::size_t matrix = 0;  // measured on this one; applied to the others it is an assumption
  std::string signal = "filtered_mean";
  SensorSettings settings;  // it was measured with
  PressureModel pressure;
  std::vector<PressureSample> samples;  // every row of the table
  // of K = slope s + offset [counts] (sensitivity_curve.h), where it was measured
  std::optional<double> sensitivityOffset;
  std::optional<NoiseFloor> noise;
  Json options;  // of the command that made it
};

Json jsonOf(const Calibration& calibration);
// Throws Error naming what is missing or of a later format.
Calibration calibrationFrom(const Json& json);

// Throws FileError, FormatError (no calibration, damaged; names what).
Calibration loadCalibration(const std::filesystem::path& path);
// Throws FileError.
void saveCalibration(const Calibration& calibration,
                     const std::filesystem::path& path,
                     Overwrite overwrite = Overwrite::kRefuse);

}  // namespace palpate
