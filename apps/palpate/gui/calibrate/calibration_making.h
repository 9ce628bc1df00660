// A calibration as the dock Calibrate has it: made from a table of recordings, or read from a file.
#pragma once

#include <filesystem>
#include <memory>

#include <palpate/calibration/calibration_samples.h>

namespace palpate::gui {

// How a table becomes a calibration.
struct CalibrationChoices {
  PressureModelOptions model = {};
  SensorSettings settings = {};
  std::optional<std::size_t> matrix = std::nullopt;  // nothing: the loaded one
  bool robust = false;                               // outliers in a step count less (Huber's loss)
};

struct ShownCalibration {
  std::filesystem::path source;  // the table, or the file it was read from
  Calibration calibration;
  std::shared_ptr<const CalibrationSteps> gathered = {};  // null: read from a file
  CalibrationChoices by = {};                             // of a table
};
using ShownCalibrationPtr = std::shared_ptr<const ShownCalibration>;

// Reads the table's recordings, unless `known` has their steps already. Throws Error (one line:
// what is missing), Cancelled.
ShownCalibrationPtr calibrationFromTable(const std::filesystem::path& table,
                                         const CalibrationChoices& choices,
                                         const ShownCalibrationPtr& known,
                                         const Progress& progress);
// Throws Error.
ShownCalibrationPtr calibrationFromFile(const std::filesystem::path& path);

}  // namespace palpate::gui
