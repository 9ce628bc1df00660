// Reads the table of a pressure calibration, which lists the pressure of each recording. It is CSV
// with a header:
//   file,pressure_kpa[,temperature_c]
// The columns may have any order, and others are ignored. Files are relative to the table's folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/calibration/pressure_model.h>
#include <palpate/calibration/step_report.h>

namespace palpate {

// One row of the table: a recording and its pressure.
struct PressureTableRow {
  // Line number in the table, from 1.
  std::size_t line = 0;
  std::filesystem::path file;
  double pressureKpa = 0.0;
  std::optional<double> temperatureC = std::nullopt;  // replaces the temperature of the recording
  // Why the row cannot be used; empty when it can be used.
  std::string problem = {};
};

// Throws FormatError (columns missing, or no row). A problem of a single row is in its `problem`.
std::vector<PressureTableRow> parsePressureTable(std::string_view csv,
                                                 const std::filesystem::path& name);

// Does the same with a file. Throws FileError, FormatError.
std::vector<PressureTableRow> readPressureTable(const std::filesystem::path& path);

// Returns one sample per step of the row's recording. A recording without a step gives one sample
// that is not used, with the reason in its notes.
std::vector<PressureSample> samplesOf(const PressureTableRow& row,
                                      const StepReport& report,
                                      const std::string& sha256);
// Returns a sample that cannot be used, with the reason.
PressureSample unusedSample(const PressureTableRow& row, const std::string& why);

// Time after which the lag has ended [s]: median over the steps; 0 when no fit converged.
double medianSteadyS(const std::vector<StepReport>& reports);

}  // namespace palpate
