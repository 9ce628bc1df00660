#include "palpate/calibration/pressure_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/statistics.h"
#include "palpate/core/text_file.h"

namespace palpate {
namespace {

// Splits a line into cells. Quoted cells (RFC 4180) may contain commas; blanks around a cell are
// removed.
std::vector<std::string> cellsOf(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = std::string(trimmed(cell, " \t\r"));
  return cells;
}

constexpr std::size_t kAbsent = SIZE_MAX;

struct Columns {
  std::size_t file = kAbsent, pressure = kAbsent, temperature = kAbsent;
};

PressureTableRow rowOf(const std::vector<std::string>& cells, const Columns& columns) {
  const auto cell = [&](std::size_t column) {
    return column < cells.size() ? cells[column] : std::string();
  };
  PressureTableRow row;
  row.file = cell(columns.file);
  if (row.file.empty()) row.problem = "names no file";
  const auto pressure = parseDouble(cell(columns.pressure));
  if (!pressure || *pressure < 0.0)
    row.problem = "pressure_kpa '" + shortened(cell(columns.pressure)) + "' isn't a pressure";
  row.pressureKpa = pressure.value_or(std::nan(""));
  const std::string temperature = cell(columns.temperature);
  if (!temperature.empty()) {
    row.temperatureC = parseDouble(temperature);
    if (!row.temperatureC || std::abs(*row.temperatureC) > 200.0)
      row.problem = "temperature_c '" + shortened(temperature) + "' isn't a temperature";
  }
  return row;
}

}  // namespace

std::vector<PressureTableRow> parsePressureTable(std::string_view csv,
                                                 const std::filesystem::path& name) {
  std::vector<PressureTableRow> rows;
  Columns columns;
  bool header = false;
  std::size_t number = 0;
  if (csv.starts_with("\xEF\xBB\xBF"))
    csv.remove_prefix(3);  // byte order mark, which spreadsheets write
  while (!csv.empty()) {
    const std::string_view line = csv.substr(0, csv.find('\n'));
    csv.remove_prefix(std::min(line.size() + 1, csv.size()));
    ++number;
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (header) {
      PressureTableRow row = rowOf(cells, columns);
      row.line = number;
      rows.push_back(std::move(row));
      continue;
    }
    header = true;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == "file") columns.file = i;
      if (cells[i] == "pressure_kpa") columns.pressure = i;
      if (cells[i] == "temperature_c") columns.temperature = i;
    }
    if (columns.file == kAbsent || columns.pressure == kAbsent)
      throw FormatError(name,
                        "its first line must name the columns file,pressure_kpa[,temperature_c]");
  }
  if (rows.empty())
    throw FormatError(name,
                      "holds no row: file,pressure_kpa[,temperature_c], then a line per recording");
  return rows;
}

PressureSample unusedSample(const PressureTableRow& row, const std::string& why) {
  PressureSample sample;
  sample.file = row.file.string();
  sample.pressureKpa = row.pressureKpa;
  sample.used = false;
  sample.notes.push_back(why);
  return sample;
}

std::vector<PressureTableRow> readPressureTable(const std::filesystem::path& path) {
  constexpr std::uint64_t kMaxBytes = 16u << 20;
  return parsePressureTable(readTextFile(path, kMaxBytes), path);
}

std::vector<PressureSample> samplesOf(const PressureTableRow& row,
                                      const StepReport& report,
                                      const std::string& sha256) {
  std::vector<PressureSample> samples;
  for (const FittedStep& step : report.steps) {
    PressureSample sample;
    sample.file = row.file.string();
    sample.sha256 = sha256;
    sample.pressureKpa = row.pressureKpa;
    sample.staticResponseCounts = step.fit.parameters.staticResponseCounts;
    sample.driftCountsPerS = step.fit.parameters.driftCountsPerS;
    sample.nearestDegC = row.temperatureC   ? row.temperatureC
                         : step.nearestDegC ? step.nearestDegC
                                            : step.allSensorsDegC;
    sample.studyDegC = row.temperatureC ? row.temperatureC : step.studyDegC;
    sample.activeAreaMm2 = step.activeAreaMm2;
    sample.durationS = step.durationS;
    sample.notes = step.notes;
    sample.notes.insert(sample.notes.end(), step.fit.notes.begin(), step.fit.notes.end());
    // A few saturated taxels make K a little too small; a note says so and the sample is used. A
    // fit without K cannot be used.
    sample.used = step.fit.usable();
    samples.push_back(std::move(sample));
  }
  if (samples.empty())
    samples.push_back(unusedSample(row, report.notes.empty() ? "no step" : report.notes.front()));
  return samples;
}

double medianSteadyS(const std::vector<StepReport>& reports) {
  std::vector<double> times;
  for (const StepReport& report : reports)
    for (const FittedStep& step : report.steps)
      if (step.fit.usable() && std::isfinite(step.characteristics.steadyS))
        times.push_back(step.characteristics.steadyS);
  return times.empty() ? 0.0 : upperMedian(std::move(times));
}

}  // namespace palpate
