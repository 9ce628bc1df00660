#include "palpate/recognition/contact_statistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Core>

namespace palpate {
namespace {

constexpr double kStatisticsPlateau = 0.9;
constexpr double kStatisticsStart = 0.25;
constexpr std::size_t kMaxStatisticsFrames = 25;
constexpr double kStatisticsActive = 0.03;
constexpr double kLoadFloor = 0.001;  // [full scale]
constexpr double kMomentUnit = 0.15;  // [taxel^2]

// Load on one matrix.
struct MatrixStatistics {
  double sum = 0.0;
  double active = 0.0;
  double column = 0.0;
  double row = 0.0;
  double major = 0.0;
  double minor = 0.0;
};

// From -1 at the first of `count` lines to 1 at the last one.
double fromMinusOne(double line, int count) {
  return count > 1 ? 2.0 * line / static_cast<double>(count - 1) - 1.0 : 0.0;
}

MatrixStatistics statisticsOf(const ConstMatrixMap& mean) {
  MatrixStatistics out;
  const auto threshold = kStatisticsActive * static_cast<double>(mean.maxCoeff());
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (Eigen::Index y = 0; y < mean.rows(); ++y)
    for (Eigen::Index x = 0; x < mean.cols(); ++x) {
      const auto load = static_cast<double>(mean(y, x));
      if (!(load > threshold)) continue;
      const auto column = static_cast<double>(x), row = static_cast<double>(y);
      out.sum += load;
      out.active += 1.0;
      out.column += load * column;
      out.row += load * row;
      xx += load * column * column;
      yy += load * row * row;
      xy += load * column * row;
    }
  if (!(out.sum > 0.0)) return {};
  out.column /= out.sum;
  out.row /= out.sum;
  xx = xx / out.sum - out.column * out.column;
  yy = yy / out.sum - out.row * out.row;
  xy = xy / out.sum - out.column * out.row;
  const double half = std::hypot((xx - yy) / 2.0, xy);
  out.major = std::log(std::max(0.0, (xx + yy) / 2.0 + half) / kMomentUnit + 1.0);
  out.minor = std::log(std::max(0.0, (xx + yy) / 2.0 - half) / kMomentUnit + 1.0);
  return out;
}

}  // namespace

std::vector<std::string> contactStatisticsNames(const HandDescription& hand) {
  std::vector<std::string> names = {"ln_sum", "ln_peak", "ln_active", "touched"};
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
    for (const char* what : {"share", "active", "column", "row", "major", "minor"})
      names.push_back("m" + std::to_string(m) + "_" + what);
  return names;
}

ContactStatistics contactStatistics(const Profile& profile, const GraspSegment& grasp) {
  if (grasp.begin > grasp.end || grasp.end >= profile.numFrames())
    throw std::out_of_range("features: there are no frames " + std::to_string(grasp.begin) + ".." +
                            std::to_string(grasp.end));
  ContactStatistics out;
  std::vector<double> sums;
  TactileFrame frame;
  for (std::size_t i = grasp.begin; i <= grasp.end; ++i) {
    profile.readFrame(i, frame);
    double sum = 0.0;
    for (const float value : frame.values) sum += static_cast<double>(std::max(value, 0.0F));
    if (!std::isfinite(sum)) {
      out.problem = "values that are not numbers in frame " + std::to_string(i);
      return out;
    }
    sums.push_back(sum);
  }
  const double largest = *std::max_element(sums.begin(), sums.end());
  if (!(largest > 0.0)) {
    out.problem = "no load";
    return out;
  }
  std::vector<std::size_t> plateau;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (sums[i] >= kStatisticsPlateau * largest) plateau.push_back(grasp.begin + i);
  const std::size_t taken = std::min(plateau.size(), kMaxStatisticsFrames);
  const auto start = std::find_if(
      sums.begin(), sums.end(), [&](double sum) { return sum >= kStatisticsStart * largest; });
  out.startFrame = grasp.begin + static_cast<std::size_t>(start - sums.begin());

  TactileFrame mean;
  for (std::size_t i = 0; i < taken; ++i) {
    const std::size_t chosen =
        taken > 1 ? plateau[(i * (plateau.size() - 1) + (taken - 1) / 2) / (taken - 1)]
                  : plateau.front();
    profile.readFrame(chosen, frame);
    if (i == 0)
      mean = frame;
    else
      std::transform(mean.values.begin(),
                     mean.values.end(),
                     frame.values.begin(),
                     mean.values.begin(),
                     std::plus<>());
    out.plateauEndFrame = chosen;
  }
  const auto count = static_cast<float>(taken);
  for (float& value : mean.values) value = std::max(value, 0.0F) / count;

  const TactileFrame& values = mean;
  const SensorLayout& layout = profile.layout();
  std::vector<MatrixStatistics> matrices;
  double sum = 0.0, peak = 0.0, active = 0.0, touched = 0.0;  // sum, peak: of full scale
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const auto fullScale = static_cast<double>(profile.hand().maximumOf(m));
    const auto places = values.matrix(m);
    matrices.push_back(statisticsOf(places));
    matrices.back().sum /= fullScale;
    peak = std::max(peak, static_cast<double>(places.maxCoeff()) / fullScale);
    sum += matrices.back().sum;
    active += matrices.back().active;
    touched += matrices.back().active > 0.0 ? 1.0 : 0.0;
  }
  out.values = {
      std::log(sum + kLoadFloor), std::log(peak + kLoadFloor), std::log(active + 1.0), touched};
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    const MatrixStatistics& of = matrices[m];
    const bool touches = of.active > 0.0;
    const double taxels = static_cast<double>(matrix.numTaxels());
    out.values.insert(out.values.end(),
                      {of.sum / sum,
                       touches ? of.active / taxels : 0.0,
                       touches ? fromMinusOne(of.column, matrix.columns) : 0.0,
                       touches ? fromMinusOne(of.row, matrix.rows) : 0.0,
                       of.major,
                       of.minor});
  }
  return out;
}

}  // namespace palpate
