// A calibration of a hand: converts its counts into kilopascals and newtons, and lists all input
// that it was made from. It is stored as a JSON file with format version, program version, options
// and the SHA-256 of every input. The command `calibrate` and the Calibrate dock make it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/noise_floor.h>
#include <palpate/calibration/pressure_model.h>
#include <palpate/core/json.h>
#include <palpate/core/option_check.h>
#include <palpate/core/output_file.h>

namespace palpate {

// Settings of the tactile controller. A .dsa recording does not contain them: then a user entered
// them, and the calibration file says so.
struct SensorSettings {
  static constexpr OptionRange kSensitivity{0.01, 1.0};
  // Up to the full scale of any hand.
  static constexpr OptionRange kThresholdCounts{0.0, 1e9, "counts"};
  double sensitivity = 1.0;
  double thresholdCounts = 100;
  bool assumed = true;  // entered by a user, not read from the device or the recording
  bool operator==(const SensorSettings&) const = default;
};

// A calibration with its input.
struct Calibration {
  static constexpr int kFormatVersion = 1;

  std::string programVersion;
  std::string madeAt;  // UTC, ISO 8601; may be empty
  std::string hand;    // HandDescription::name
  std::string serial;  // ProfileInfo::serial of the sensor that was measured; may be empty
  // The matrix that was measured; for the other matrices the calibration is an assumption.
  std::size_t matrix = 0;
  std::string signal = "filtered_mean";
  // Settings during the measurement.
  SensorSettings settings;
  PressureModel pressure;
  std::vector<PressureSample> samples;  // every row of the table
  // Offset of K = slope s + offset [counts] (sensitivity_curve.h), if it was measured.
  std::optional<double> sensitivityOffset;
  std::optional<NoiseFloor> noise;
  // Options of the command that made the calibration.
  Json options;
};

Json jsonOf(const Calibration& calibration);
// Throws Error that names what is missing, or that the format is newer.
Calibration calibrationFrom(const Json& json);

// Throws FileError, and FormatError (no calibration, or a damaged one) that names the problem.
Calibration loadCalibration(const std::filesystem::path& path);
// Throws FileError.
void saveCalibration(const Calibration& calibration,
                     const std::filesystem::path& path,
                     Overwrite overwrite = Overwrite::kRefuse);

}  // namespace palpate
