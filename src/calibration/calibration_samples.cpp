#include "palpate/calibration/calibration_samples.h"

#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"

namespace palpate {
namespace {

constexpr std::size_t kCalibrationSamplesProgressEvery = 1024;  // frames

void gatherRow(const PressureTableRow& row,
               const std::filesystem::path& folder,
               const OpenSource& open,
               const CalibrationSampleOptions& options,
               const Progress& progress,
               CalibrationSteps& all) {
  if (!row.problem.empty()) {
    all.samples.push_back(
        unusedSample(row, "line " + std::to_string(row.line) + ": " + row.problem));
    return;
  }
  const std::filesystem::path file = row.file.is_absolute() ? row.file : folder / row.file;
  try {
    const CalibrationSource source = open(file, progress);
    if (!all.matrix) all.matrix = loadedMatrix(source.profile);
    requireMatrix(file, source.profile.layout(), *all.matrix);
    all.taxelAreaMm2 = source.profile.layout().matrix(*all.matrix).taxelAreaMm2();
    if (all.hand.empty()) {
      all.hand = source.profile.hand().name;
      all.serial = source.profile.info().serial;
    }
    all.reports.push_back(reportSteps(source.profile, *all.matrix, options.steps));
    for (PressureSample& sample : samplesOf(row, all.reports.back(), source.sha256))
      all.samples.push_back(std::move(sample));
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    all.samples.push_back(unusedSample(row, error.what()));
  }
}

// Says which other row gives the file of this one another pressure; empty: none.
std::string contradictionOf(const PressureTableRow& row, std::span<const PressureTableRow> rows) {
  for (const PressureTableRow& other : rows)
    if (row.problem.empty() && other.problem.empty() && other.file == row.file &&
        other.pressureKpa != row.pressureKpa)
      return "line " + std::to_string(row.line) + " says " + numberText(row.pressureKpa) +
             " kPa, line " + std::to_string(other.line) + " " + numberText(other.pressureKpa) +
             " kPa: a recording has one pressure";
  return {};
}

void requirePossibleArea(const CalibrationSteps& gathered, double areaMm2) {
  if (!(areaMm2 > 0.0)) return;
  double active = 0.0;
  for (const PressureSample& sample : gathered.samples)
    if (sample.used) active = std::max(active, sample.activeAreaMm2);
  const std::string area =
      "the area of the indenter (--area), " + fixedText(areaMm2, 2) + " mm^2, is ";
  if (areaMm2 < gathered.taxelAreaMm2)
    throw Error(area + "less than one taxel, " + fixedText(gathered.taxelAreaMm2, 2) + " mm^2");
  if (active > 0.0 && areaMm2 > active + gathered.taxelAreaMm2)
    throw Error(area + "more than was loaded: at most " + fixedText(active, 2) +
                " mm^2 of taxels were active");
}

}  // namespace

std::size_t loadedMatrix(const Profile& profile, const Progress& progress) {
  std::vector<double> sums(profile.layout().numMatrices());
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kCalibrationSamplesProgressEvery);
    profile.readFrame(i, frame);
    for (std::size_t m = 0; m < sums.size(); ++m)
      sums[m] += static_cast<double>(std::as_const(frame).matrix(m).sum());
  }
  return static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
}

std::size_t CalibrationSteps::numUnused() const {
  return static_cast<std::size_t>(std::count_if(
      samples.begin(), samples.end(), [](const PressureSample& sample) { return !sample.used; }));
}

CalibrationSteps collectCalibrationSteps(std::span<const PressureTableRow> rows,
                                         const std::filesystem::path& folder,
                                         const OpenSource& open,
                                         const CalibrationSampleOptions& options,
                                         const Progress& progress) {
  options.steps.steps.validate();
  options.steps.fit.validate();
  CalibrationSteps all;
  all.matrix = options.matrix;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto done = static_cast<double>(i), count = static_cast<double>(rows.size());
    const Progress part = [&](double fraction) {
      return !progress || progress((done + fraction) / count);
    };
    if (!part(0.0)) throw Cancelled();
    if (const std::string why = contradictionOf(rows[i], rows); !why.empty())
      all.samples.push_back(unusedSample(rows[i], why));
    else
      gatherRow(rows[i], folder, open, options, part, all);
  }
  return all;
}

Calibration calibrationOf(const CalibrationSteps& gathered, const PressureModelOptions& options) {
  requirePossibleArea(gathered, options.indenterAreaMm2);
  Calibration calibration;
  calibration.hand = gathered.hand;
  calibration.serial = gathered.serial;
  calibration.matrix = gathered.matrix.value_or(0);
  calibration.pressure = fitPressureModel(gathered.samples, options);
  calibration.pressure.steadyS = medianSteadyS(gathered.reports);
  calibration.samples = gathered.samples;
  return calibration;
}

}  // namespace palpate
