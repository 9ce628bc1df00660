// Gathers what a pressure calibration is made from: the loading steps of every recording of a
// table, measured on one matrix. What is wrong with one recording leaves its row out, and says why;
// the others stay.
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

// The matrix with the largest sum over the recording: the one that was loaded; the first of equals.
// Throws Cancelled.
std::size_t loadedMatrix(const Profile& profile, const Progress& progress = {});

struct CalibrationSource {
  Profile profile;
  std::string sha256;  // of its file
};
// Opens one recording; throws Error where it can't (its row is left out), Cancelled.
using OpenSource =
    std::function<CalibrationSource(const std::filesystem::path& file, const Progress& progress)>;

struct CalibrationSampleOptions {
  StepReportOptions steps = {};
  // nothing: the loaded one of the first recording that can be read
  std::optional<std::size_t> matrix = std::nullopt;
};

struct CalibrationSteps {
  std::vector<PressureSample> samples;  // one per row at least, in their order
  std::vector<StepReport> reports;      // of the recordings that could be read
  std::optional<std::size_t> matrix;
  std::string hand;  // HandDescription::name of the first
  std::size_t numUnused() const;
};

// Files of the rows are relative to `folder`. Throws Cancelled; std::invalid_argument (options).
CalibrationSteps collectCalibrationSteps(std::span<const PressureTableRow> rows,
                                         const std::filesystem::path& folder,
                                         const OpenSource& open,
                                         const CalibrationSampleOptions& options = {},
                                         const Progress& progress = {});

// A calibration of them: model, hand, matrix, samples. Who made it when, options and settings are
// the caller's. Throws std::invalid_argument (options).
Calibration calibrationOf(const CalibrationSteps& gathered,
                          const PressureModelOptions& options = {});

}  // namespace palpate
