// Collects the input of a pressure calibration: the loading steps of every recording of a table,
// measured on one matrix. When a recording cannot be used, its row is left out with the reason, and
// the other rows are still used.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/calibration/calibration.h>
#include <palpate/calibration/pressure_table.h>
#include <palpate/calibration/step_report.h>
#include <palpate/core/progress.h>

namespace palpate {

// Returns the matrix with the largest sum over the recording, which was the loaded one; the first
// of equal ones. Throws Cancelled.
std::size_t loadedMatrix(const Profile& profile, const Progress& progress = {});

// An opened recording.
struct CalibrationSource {
  Profile profile;
  std::string sha256;  // of the recording's file
};
// Opens one recording. Throws Error when it cannot (the row is then left out), and Cancelled.
using OpenSource =
    std::function<CalibrationSource(const std::filesystem::path& file, const Progress& progress)>;

struct CalibrationSampleOptions {
  StepReportOptions steps = {};
  // The matrix to measure; empty: the loaded matrix of the first readable recording.
  std::optional<std::size_t> matrix = std::nullopt;
};

// The loading steps of all recordings of a table.
struct CalibrationSteps {
  // At least one sample per row, in the order of the rows.
  std::vector<PressureSample> samples;
  std::vector<StepReport> reports;  // of the readable recordings
  std::optional<std::size_t> matrix;
  std::string hand;           // HandDescription::name in the first of them
  std::string serial;         // ProfileInfo::serial in the first of them; may be empty
  double taxelAreaMm2 = 0.0;  // of the matrix
  std::size_t numUnused() const;
};

// Files of the rows are relative to `folder`; rows that give one file different pressures are left
// out. Throws Cancelled, and std::invalid_argument
// (options).
CalibrationSteps collectCalibrationSteps(std::span<const PressureTableRow> rows,
                                         const std::filesystem::path& folder,
                                         const OpenSource& open,
                                         const CalibrationSampleOptions& options = {},
                                         const Progress& progress = {});

// Makes a calibration with model, hand, matrix and samples. The caller adds program version, time,
// options and settings. Throws std::invalid_argument (options), and Error: the area of the indenter
// is less than one taxel, or larger than the active area of every step by more than one.
Calibration calibrationOf(const CalibrationSteps& gathered,
                          const PressureModelOptions& options = {});

}  // namespace palpate
