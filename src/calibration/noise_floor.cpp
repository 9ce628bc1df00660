#include "palpate/calibration/noise_floor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "palpate/calibration/student_t.h"
#include "palpate/calibration/tare.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"

namespace palpate {
namespace {

constexpr double kOutlierSigmas = 6.0;
// All frames are used, unlike in a tare: a matrix must be at rest nearly always.
constexpr double kMinRestShare = 0.9;
// Below this range of temperatures the reading at rest stays the same.
constexpr double kSameRestDegC = 5.0;
constexpr double kFitShare = 0.5;  // part of the work; the rest is the search for touches

struct Point {
  double t, y;
};

std::vector<NoiseBin> binsOf(const std::vector<Point>& points,
                             double least,
                             double most,
                             std::size_t count) {
  std::vector<NoiseBin> bins(count);
  const double width = (most - least) / static_cast<double>(count);
  std::vector<double> squares(count, 0.0);
  const auto binOf = [&](double t) {
    return std::min(static_cast<std::size_t>((t - least) / width), count - 1);
  };
  for (std::size_t i = 0; i < count; ++i)
    bins[i].centreDegC = least + (static_cast<double>(i) + 0.5) * width;
  for (const Point& p : points) {
    NoiseBin& bin = bins[binOf(p.t)];
    bin.mean += p.y;
    ++bin.count;
  }
  for (NoiseBin& bin : bins)
    if (bin.count > 0) bin.mean /= static_cast<double>(bin.count);
  for (const Point& p : points) squares[binOf(p.t)] += std::pow(p.y - bins[binOf(p.t)].mean, 2);
  for (std::size_t i = 0; i < count; ++i)
    if (bins[i].count > 0) bins[i].sd = std::sqrt(squares[i] / static_cast<double>(bins[i].count));
  return bins;
}

// Fits a weighted line through the bins; returns false when fewer than two of them differ.
bool lineThrough(const std::vector<NoiseBin>& bins, NoiseLine& line) {
  double w = 0.0, x = 0.0, y = 0.0;
  for (const NoiseBin& bin : bins) {
    if (!bin.used()) continue;
    const double weight = 1.0 / (bin.sd * bin.sd);
    w += weight;
    x += weight * bin.centreDegC;
    y += weight * bin.mean;
  }
  if (!(w > 0.0)) return false;
  x /= w;
  y /= w;
  double xx = 0.0, xy = 0.0;
  for (const NoiseBin& bin : bins) {
    if (!bin.used()) continue;
    const double weight = 1.0 / (bin.sd * bin.sd);
    xx += weight * (bin.centreDegC - x) * (bin.centreDegC - x);
    xy += weight * (bin.centreDegC - x) * (bin.mean - y);
  }
  if (!(xx > 0.0)) return false;
  line.slope = xy / xx;
  line.intercept = y - line.slope * x;
  return true;
}

struct Sums {
  double y = 0.0, yy = 0.0, xy = 0.0;
};

Sums sumsOf(const std::vector<Point>& points, NoiseLine& line) {
  Sums s;
  const auto n = static_cast<double>(points.size());
  double x = 0.0;
  for (const Point& p : points) {
    x += p.t / n;
    s.y += p.y / n;
  }
  for (const Point& p : points) {
    line.spreadDegC2 += (p.t - x) * (p.t - x);
    s.yy += (p.y - s.y) * (p.y - s.y);
    s.xy += (p.t - x) * (p.y - s.y);
  }
  line.meanDegC = x;
  return s;
}

// Without a line: sets the mean, which holds at this temperature only.
void settleForMean(const Sums& sums, std::size_t n, NoiseLine& line) {
  line.slope = 0.0;
  line.intercept = sums.y;
  line.rmse = line.rmseTrue = n > 1 ? std::sqrt(sums.yy / static_cast<double>(n - 1)) : 0.0;
}

// Finds out which matrices were touched.
void judgeRest(const Profile& profile, const Progress& progress, NoiseFloor& floor) {
  const TareOptions usual;
  TareOptions wide;
  wide.sameRestCounts = usual.maxRestCounts;
  wide.maxSdCounts = 2.0 * usual.maxSdCounts;
  const auto warms = [](const NoiseLine& line) {
    return line.maxDegC - line.minDegC > kSameRestDegC;
  };
  const auto numWarm = std::count_if(floor.lines.begin(), floor.lines.end(), warms);
  const auto rest = [&](const TareOptions& options, double from, double share) {
    return findTare(profile, options, [&](double done) {
      return !progress || progress(kFitShare + (1.0 - kFitShare) * (from + share * done));
    });
  };
  Tare tare;
  if (numWarm == 0) {
    tare = rest(usual, 0.0, 1.0);
  } else if (numWarm == std::ssize(floor.lines)) {
    tare = rest(wide, 0.0, 1.0);
  } else {
    tare = rest(wide, 0.0, 0.5);
    const Tare strict = rest(usual, 0.5, 0.5);
    for (std::size_t m = 0; m < floor.lines.size(); ++m)
      if (!warms(floor.lines[m])) tare.matrices[m] = strict.matrices[m];
  }
  for (std::size_t m = 0; m < floor.lines.size(); ++m)
    floor.lines[m].atRest = wasAtRest(tare.matrices[m], profile.numFrames(), kMinRestShare);
  floor.notAtRest = notAtRest(tare, profile, kMinRestShare);
}

}  // namespace

void NoiseFloorOptions::validate() const {
  constexpr OptionCheck check{"NoiseFloorOptions"};
  check(kBins, "bins", static_cast<double>(bins));
}

double NoiseLine::predictionHalfWidth(double degC) const {
  if (numFrames < 3) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(numFrames);
  const double away = spreadDegC2 > 0.0 ? (degC - meanDegC) * (degC - meanDegC) / spreadDegC2 : 0.0;
  return studentQuantile975(n - 2.0) * rmseTrue * std::sqrt(1.0 + 1.0 / n + away);
}

NoiseLine fitNoiseLine(std::span<const double> degC,
                       std::span<const double> maximumCounts,
                       const NoiseFloorOptions& options) {
  options.validate();
  if (degC.size() != maximumCounts.size())
    throw std::invalid_argument("fitNoiseLine: temperatures and maxima differ in number");
  NoiseLine line;
  std::vector<Point> points;
  for (std::size_t i = 0; i < degC.size(); ++i)
    if (std::isfinite(degC[i]) && degC[i] != 0.0 && std::isfinite(maximumCounts[i]))
      points.push_back({degC[i], maximumCounts[i]});
  line.numFrames = points.size();
  if (points.empty()) {
    line.notes.push_back("no frame with a temperature: no line");
    return line;
  }
  const auto [least, most] =
      std::minmax_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.t < b.t; });
  line.minDegC = least->t;
  line.maxDegC = most->t;
  const Sums sums = sumsOf(points, line);
  const bool silent =
      std::all_of(points.begin(), points.end(), [](const Point& p) { return p.y == 0.0; });
  if (silent)
    line.notes.push_back(
        "reads 0 throughout: the threshold hid the noise, or the matrix is masked; record at "
        "threshold 0");
  if (line.maxDegC > line.minDegC)
    line.bins = binsOf(points, line.minDegC, line.maxDegC, options.bins);
  line.valid = !silent && points.size() > 2 && lineThrough(line.bins, line);
  if (!line.valid) {
    settleForMean(sums, points.size(), line);
    if (line.bins.empty())
      line.notes.push_back("one temperature only (" + fixedText(line.minDegC, 2) +
                           " °C): no slope; there the mean is " + fixedText(line.intercept, 1) +
                           " counts, sd " + fixedText(line.rmse, 1) +
                           ". For a line, measure again when the hand is warmer or colder");
    else if (!silent)
      line.notes.push_back("fewer than two bins with a spread: no slope; the mean holds");
    return line;
  }
  const double n = static_cast<double>(points.size());
  line.rmse = std::sqrt(std::max(sums.yy - line.slope * sums.xy, 0.0) / (n - 2.0));
  double squares = 0.0;
  for (const Point& p : points) squares += std::pow(p.y - line.at(p.t), 2);
  line.rmseTrue = std::sqrt(squares / (n - 2.0));
  line.numOutliers =
      static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Point& p) {
        return p.y - line.at(p.t) > kOutlierSigmas * line.rmseTrue;
      }));
  if (line.numOutliers > 0)
    line.notes.push_back(std::to_string(line.numOutliers) +
                         " frames stand out by more than 6 RMSE: was the matrix touched?");
  return line;
}

NoiseFloor fitNoiseFloor(const Profile& profile,
                         const NoiseFloorOptions& options,
                         const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  options.validate();
  const SensorLayout& layout = profile.layout();
  const auto& matrices = profile.hand().matrices;
  std::vector<std::vector<double>> degC(layout.numMatrices()), maxima(layout.numMatrices());
  const Progress fitProgress = [&](double done) { return !progress || progress(kFitShare * done); };
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(fitProgress, i, profile.numFrames(), kFramesPerReport);
    profile.readFrame(i, frame);
    const auto temperatures = profile.temperaturesAtFrame(i);
    for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
      const std::size_t sensor =
          m < matrices.size() ? matrices[m].temperatureSensor.value_or(SIZE_MAX) : SIZE_MAX;
      if (!temperatures || sensor >= temperatures->values.size()) continue;
      degC[m].push_back(temperatures->values[sensor]);
      maxima[m].push_back(static_cast<double>(std::as_const(frame).matrix(m).maxCoeff()));
    }
  }
  NoiseFloor floor;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    floor.lines.push_back(fitNoiseLine(degC[m], maxima[m], options));
    floor.lines.back().matrix = m;
  }
  if (profile.numFrames() == 0)
    floor.notes.push_back("the recording has no frames");
  else
    judgeRest(profile, progress, floor);
  if (profile.numTemperatures() == 0)
    floor.notes.push_back("no temperatures were recorded: can't relate noise to temperature");
  return floor;
}

}  // namespace palpate
