#include "palpate/laboratory/cramer_rao_bound.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

namespace palpate {
namespace {

// Step of the central differences [taxels].
constexpr double kStep = 1e-3;

double normalDensity(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}
double normalBelow(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

std::vector<double> counts(const SyntheticContact& contact, const SyntheticSensor& sensor) {
  std::vector<float> values(sensor.layout.numCells());
  idealCounts(contact, sensor, MatrixMap(values.data(), sensor.layout.rows, sensor.layout.columns));
  return {values.begin(), values.end()};
}

using Field = double SyntheticContact::*;

// Derivative of the ideal counts by central differences. Floats near 1500 counts have a resolution
// of 1e-4 counts, and a step of 1e-3 taxel changes them by about one count, so that the rounding
// error is small.
std::vector<double> slope(const SyntheticContact& contact,
                          const SyntheticSensor& sensor,
                          Field field,
                          double step) {
  SyntheticContact more = contact;
  more.*field += step;
  SyntheticContact less = contact;
  less.*field -= step;
  std::vector<double> result = counts(more, sensor);
  const std::vector<double> before = counts(less, sensor);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = (result[i] - before[i]) / (2.0 * step);
  return result;
}

}  // namespace

double censoredInformation(double z) noexcept {
  if (z > 8.0) return 1.0;
  if (z < -8.0) return 0.0;
  // Probability that the value is censored.
  const double below = normalBelow(-z);
  const double density = normalDensity(z);
  return normalBelow(z) - z * density + density * density / below;
}

CramerRaoBound cramerRaoBound(const SyntheticContact& contact,
                              const SyntheticSensor& sensor,
                              const SlipNuisances& nuisances) {
  sensor.validate();
  const std::vector<double> mean = counts(contact, sensor);
  const double variance = sensor.noiseSd * sensor.noiseSd + 1.0 / 12.0;
  const double sd = std::sqrt(variance);

  std::vector<std::vector<double>> slopes{slope(contact, sensor, &SyntheticContact::x, 10 * kStep),
                                          slope(contact, sensor, &SyntheticContact::y, 10 * kStep)};
  const bool turns = hasOrientation(contact.shape);
  if (turns) slopes.push_back(slope(contact, sensor, &SyntheticContact::angleDeg, 1.0));
  if (nuisances.gain) slopes.push_back(mean);
  if (nuisances.tilt) {
    slopes.push_back(slope(contact, sensor, &SyntheticContact::tiltX, kStep));
    slopes.push_back(slope(contact, sensor, &SyntheticContact::tiltY, kStep));
  }

  const auto size = static_cast<Eigen::Index>(slopes.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd row(size);
  for (int y = 0; y < sensor.layout.rows; ++y)
    for (int x = 0; x < sensor.layout.columns; ++x) {
      if (!sensor.layout.enabled(y, x)) continue;
      const auto place = static_cast<std::size_t>(y * sensor.layout.columns + x);
      const double z = (mean[place] - sensor.thresholdCounts) / sd;
      const double toSaturation = (sensor.saturationCounts - mean[place]) / sd;
      const double kept = censoredInformation(z) * censoredInformation(toSaturation);
      for (Eigen::Index i = 0; i < size; ++i) row(i) = slopes[static_cast<std::size_t>(i)][place];
      information += kept / variance * row * row.transpose();
    }

  CramerRaoBound bound;
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-12).cwiseSqrt();
  const Eigen::MatrixXd scaled =
      scale.cwiseInverse().asDiagonal() * information * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  if (solver.eigenvalues()(0) < 1e-10) return bound;
  const Eigen::VectorXd variances =
      (solver.eigenvectors() * solver.eigenvalues().cwiseInverse().asDiagonal() *
       solver.eigenvectors().transpose())
          .diagonal()
          .cwiseQuotient(scale.cwiseAbs2());
  bound.x = std::sqrt(2.0 * variances(0));
  bound.y = std::sqrt(2.0 * variances(1));
  if (turns) bound.angleDeg = std::sqrt(2.0 * variances(2));
  return bound;
}

}  // namespace palpate
