#include "palpate/recognition/standardisation.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

// A standard deviation below this fraction of the magnitude is due to rounding.
constexpr double kConstant = 1e-12;

}  // namespace

Standardisation Standardisation::of(const Eigen::MatrixXd& x) {
  if (x.rows() == 0) throw std::invalid_argument("Standardisation: no sample");
  Standardisation fitted;
  fitted.mean = x.colwise().mean().transpose();
  fitted.scale.resize(x.cols());
  for (Eigen::Index column = 0; column < x.cols(); ++column) {
    const double sd = std::sqrt((x.col(column).array() - fitted.mean[column]).square().mean());
    const double largest = x.col(column).cwiseAbs().maxCoeff();
    fitted.scale[column] = sd > kConstant * largest ? 1.0 / sd : 0.0;
  }
  return fitted;
}

Eigen::MatrixXd Standardisation::apply(const Eigen::MatrixXd& x) const {
  if (x.cols() != mean.size())
    throw std::invalid_argument("Standardisation: " + std::to_string(x.cols()) +
                                " features, fitted to " + std::to_string(mean.size()));
  return (x.rowwise() - mean.transpose()) * scale.asDiagonal();
}

}  // namespace palpate
