// Noise floor (study, 3.4): the largest reading of each unloaded matrix at threshold 0, a line over
// the temperature of the sensor nearest to it. The study's method, with its numbers: 20 equal bins
// over the temperature range, a line through the bins' means with weights 1/sd^2 (population sd;
// bins with sd 0 left out), and
//   RMSE = sqrt((Syy - b Sxy) / (n - 2))    over all n frames, b the slope of that line
// which is that of the ordinary line through all frames; the true one of this line is 1 to 10 %
// larger: both are told.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

struct NoiseFloorOptions {
  std::size_t bins = 20;  // 2..1000

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct NoiseBin {
  double centreDegC = 0.0;
  double mean = 0.0;      // of the maximum [counts]
  double sd = 0.0;        // population standard deviation [counts]
  std::size_t count = 0;  // frames; 0: none has this temperature
  bool used() const noexcept { return count > 0 && sd > 0.0; }
};

struct NoiseLine {
  std::size_t matrix = 0;
  double slope = 0.0;      // [counts/deg C]
  double intercept = 0.0;  // [counts] at 0 deg C
  double rmse = 0.0;       // the study's [counts]
  double rmseTrue = 0.0;   // sqrt(sum of squared residuals of this line / (n - 2)) [counts]
  bool valid = false;      // slope, intercept and rmse were found
  std::vector<NoiseBin> bins;
  std::size_t numFrames = 0;            // with a temperature
  std::size_t numOutliers = 0;          // frames more than 6 rmseTrue above the line
  double minDegC = 0.0, maxDegC = 0.0;  // temperatures it was measured at
  double meanDegC = 0.0;                // of all frames
  double spreadDegC2 = 0.0;             // Sxx: sum of (T - mean)^2 [deg C^2]
  std::vector<std::string> notes;       // what is missing, and what holds all the same

  double at(double degC) const { return intercept + slope * degC; }
  // theta = intercept + slope T + 3 RMSE [counts], the threshold above which no noise shows.
  double threshold(double degC, double sigmas = 3.0) const { return at(degC) + sigmas * rmse; }
  // Half width of the 95 % interval that a single frame falls into (prediction interval of the
  // study, with its misprint corrected) [counts]; NaN with fewer than three frames.
  double predictionHalfWidth(double degC) const;
  bool covers(double degC) const noexcept { return degC >= minDegC && degC <= maxDegC; }
};

struct NoiseFloor {
  std::vector<NoiseLine> lines;  // one per matrix
  std::vector<std::string> notes;
};

// From the maximum of a matrix and the temperature that belongs to it, frame by frame. What is no
// number, or exactly 0 deg C (not reported), is left out.
NoiseLine fitNoiseLine(std::span<const double> degC,
                       std::span<const double> maximumCounts,
                       const NoiseFloorOptions& options = {});

// Of an unloaded recording at threshold 0, all frames. Throws std::invalid_argument (options),
// Cancelled.
NoiseFloor fitNoiseFloor(const Profile& profile,
                         const NoiseFloorOptions& options = {},
                         const Progress& progress = {});

// JSON: matrices[{index,slope,intercept,rmse,rmse_true,bins[..]}], and more.
Json jsonOf(const NoiseFloor& floor);
// Lines from such JSON (bins and notes aside). Throws Error naming what is missing.
NoiseFloor noiseFloorFrom(const Json& json);

// The prior program's file: <calibration> of <matrix id="0"> with <slope>, <intercept>, <RMSE>.
std::string noiseXml(const NoiseFloor& floor);
// Throws FormatError (`name` stands for the path) where it isn't such a file.
NoiseFloor parseNoiseXml(std::string_view xml, const std::filesystem::path& name);

}  // namespace palpate
