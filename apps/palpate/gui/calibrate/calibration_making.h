// Makes a calibration from a table of recordings or reads it from a file, for the page Pressure of
// the dock Calibrate.
#pragma once

#include <filesystem>
#include <memory>

#include <palpate/calibration/calibration_samples.h>

namespace palpate::gui {

// How a calibration is computed from a table.
struct CalibrationChoices {
  PressureModelOptions model = {};
  SensorSettings settings = {};
  // The matrix that is evaluated; nothing: the loaded one.
  std::optional<std::size_t> matrix = std::nullopt;
  // Outliers in a step get less weight (Huber's loss).
  bool robust = false;
};

// A calibration with its origin.
struct ShownCalibration {
  // The table, or the calibration file.
  std::filesystem::path source;
  Calibration calibration;
  // The steps of the table's recordings; null when the calibration was read from a file.
  std::shared_ptr<const CalibrationSteps> gathered = {};
  // The choices that it was computed with; only of a table.
  CalibrationChoices by = {};
};
using ShownCalibrationPtr = std::shared_ptr<const ShownCalibration>;

// Computes a calibration from a table. Reads the recordings of the table, unless `known` already
// has their steps. Throws Error (one line that names what is missing) and Cancelled.
ShownCalibrationPtr calibrationFromTable(const std::filesystem::path& table,
                                         const CalibrationChoices& choices,
                                         const ShownCalibrationPtr& known,
                                         const Progress& progress);
// Reads a calibration file. Throws Error.
ShownCalibrationPtr calibrationFromFile(const std::filesystem::path& path);

}  // namespace palpate::gui
