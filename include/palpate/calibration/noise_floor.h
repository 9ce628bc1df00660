// Fits the noise floor (study, 3.4): the largest reading of each unloaded matrix at threshold 0, as
// a line over the temperature of the nearest sensor. The thresholds at high sensitivity use it. The
// method is the study's and gives the study's numbers: 20 equal bins over the temperature range; a
// line through the means of the bins with weights 1/sd^2 (population sd; bins with sd 0 are left
// out); and
//   RMSE = sqrt((Syy - b Sxy) / (n - 2))    over all n frames, b the slope of that line
// This RMSE is exact only for the ordinary line through all frames; the true RMSE of the weighted
// line is 1 to 10 % larger. Both are reported.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

struct NoiseFloorOptions {
  static constexpr OptionRange kBins{2, 1000};
  std::size_t bins = 20;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// The maxima of a matrix within one bin of temperature.
struct NoiseBin {
  double centreDegC = 0.0;
  double mean = 0.0;      // of the maximum [counts]
  double sd = 0.0;        // population standard deviation [counts]
  std::size_t count = 0;  // frames with this temperature
  bool used() const noexcept { return count > 0 && sd > 0.0; }
};

// The noise floor of one matrix.
struct NoiseLine {
  std::size_t matrix = 0;
  double slope = 0.0;      // [counts/deg C]
  double intercept = 0.0;  // [counts] at 0 deg C
  double rmse = 0.0;       // by the study's formula [counts]
  double rmseTrue = 0.0;   // sqrt(sum of squared residuals of this line / (n - 2)) [counts]
  bool valid = false;      // slope, intercept and rmse are known
  std::vector<NoiseBin> bins;
  std::size_t numFrames = 0;            // with a temperature
  std::size_t numOutliers = 0;          // frames more than 6 rmseTrue above the line
  double minDegC = 0.0, maxDegC = 0.0;  // range of the measured temperatures
  double meanDegC = 0.0;                // mean of all frames
  double spreadDegC2 = 0.0;             // Sxx: sum of (T - mean)^2 [deg C^2]
  bool atRest = true;                   // nothing touched the matrix
  std::vector<std::string> notes;       // what is missing, and known limits of the result

  // The line at a temperature [counts].
  double at(double degC) const { return intercept + slope * degC; }
  // theta = intercept + slope T + sigmas * RMSE [counts]: the threshold above which noise is not
  // visible.
  double threshold(double degC, double sigmas = 3.0) const { return at(degC) + sigmas * rmse; }
  // Half width of the 95 % interval for a single frame (prediction interval of the study, with its
  // misprint corrected) [counts]; NaN with fewer than three frames.
  double predictionHalfWidth(double degC) const;
  bool covers(double degC) const noexcept { return degC >= minDegC && degC <= maxDegC; }
};

// The noise floor of all matrices.
struct NoiseFloor {
  std::vector<NoiseLine> lines;  // one per matrix
  std::vector<std::string> notes;
  // Which matrices were touched, in one line; their lines are no noise. Empty: none was touched.
  std::string notAtRest;
};

// Fits the line from the maximum of a matrix and its temperature, frame by frame. Ignores values
// that are not finite, and temperatures of exactly 0 deg C (not reported).
NoiseLine fitNoiseLine(std::span<const double> degC,
                       std::span<const double> maximumCounts,
                       const NoiseFloorOptions& options = {});

// Fits the lines of all matrices to an unloaded recording at threshold 0. A matrix was at rest when
// at least nine tenths of its frames lie in unloaded windows (tare.h); where its temperature
// changes by more than 5 deg C, a reading at rest may rise up to the limit of unloaded windows, and
// its standard deviation may be twice theirs.
// Throws std::invalid_argument (options), Cancelled.
NoiseFloor fitNoiseFloor(const Profile& profile,
                         const NoiseFloorOptions& options = {},
                         const Progress& progress = {});

// JSON: matrices[{index,slope,intercept,rmse,rmse_true,bins[..]}], and more.
Json jsonOf(const NoiseFloor& floor);
// Reads the lines from such JSON, without bins and notes. Throws Error that names what is missing.
NoiseFloor noiseFloorFrom(const Json& json);

// The file format of the prior program: <calibration> of <matrix id="0"> with <slope>, <intercept>,
// <RMSE>. It can't say that the hand was not at rest: throws Error for such lines.
std::string noiseXml(const NoiseFloor& floor);
// Throws FormatError with `name` as path when it is no such file.
NoiseFloor parseNoiseXml(std::string_view xml, const std::filesystem::path& name);

}  // namespace palpate
