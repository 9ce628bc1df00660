// The table of a pressure calibration: which recording was made under which pressure. CSV with a
// header:
//   file,pressure_kpa[,temperature_c]
// in any order of columns; others are ignored. Files are relative to the table's folder.
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

struct PressureTableRow {
  std::size_t line = 0;  // in the table, from 1
  std::filesystem::path file;
  double pressureKpa = 0.0;
  std::optional<double> temperatureC = std::nullopt;  // instead of what the recording says
  std::string problem = {};                           // why the row can't be used; empty: it can
};

// Throws FormatError (no such columns, no row); what is wrong with one row stands in its `trouble`.
std::vector<PressureTableRow> parsePressureTable(std::string_view csv,
                                                 const std::filesystem::path& name);

// Of a file. Throws FileError, FormatError.
std::vector<PressureTableRow> readPressureTable(const std::filesystem::path& path);

// A sample per step of the row's recording (one at least: without a step it isn't used, and says
// why).
std::vector<PressureSample> samplesOf(const PressureTableRow& row,
                                      const StepReport& report,
                                      const std::string& sha256);
// One that can't be used, with the reason.
PressureSample unusedSample(const PressureTableRow& row, const std::string& why);

// After so long the lag is over: median over the steps [s]; 0 where none converged.
double medianSteadyS(const std::vector<StepReport>& reports);

}  // namespace palpate
