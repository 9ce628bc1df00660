#include "palpate/slip/contact_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpate {
namespace {

constexpr Eigen::Index kMaxMomentColumns = 256;

}  // namespace

// The third moments along one axis only need the sums over the other axis. One pass over the matrix
// makes the row and column sums; all moments are computed from them.
ContactMoments contactMoments(const ConstMatrixMap& matrix) noexcept {
  const Eigen::Index rows = matrix.rows();
  const Eigen::Index columns = std::min(matrix.cols(), kMaxMomentColumns);
  std::array<double, kMaxMomentColumns> ofColumn;
  for (Eigen::Index x = 0; x < columns; ++x) ofColumn[static_cast<std::size_t>(x)] = 0.0;

  ContactMoments moments;
  double m01 = 0.0;
  double m02 = 0.0;
  double m03 = 0.0;
  double m11 = 0.0;
  for (Eigen::Index y = 0; y < rows; ++y) {
    const float* values = matrix.data() + y * matrix.cols();
    double sum = 0.0;
    double alongX = 0.0;
    int active = 0;
    for (Eigen::Index x = 0; x < columns; ++x) {
      const bool isActive = isTouched(values[x]);
      const double value = isActive ? static_cast<double>(values[x]) : 0.0;
      active += isActive ? 1 : 0;
      sum += value;
      alongX += static_cast<double>(x) * value;
      ofColumn[static_cast<std::size_t>(x)] += value;
    }
    if (active == 0) continue;
    moments.active += active;
    const auto at = static_cast<double>(y);
    moments.sum += sum;
    m01 += at * sum;
    m02 += at * at * sum;
    m03 += at * at * at * sum;
    m11 += at * alongX;
  }
  if (moments.active == 0) return {};

  double m10 = 0.0;
  double m20 = 0.0;
  double m30 = 0.0;
  for (Eigen::Index x = 0; x < columns; ++x) {
    const double sum = ofColumn[static_cast<std::size_t>(x)];
    const auto at = static_cast<double>(x);
    m10 += at * sum;
    m20 += at * at * sum;
    m30 += at * at * at * sum;
  }
  const double scale = 1.0 / moments.sum;
  const double cx = m10 * scale;
  const double cy = m01 * scale;
  moments.x = cx;
  moments.y = cy;
  moments.mu20 = m20 * scale - cx * cx;
  moments.mu02 = m02 * scale - cy * cy;
  moments.mu11 = m11 * scale - cx * cy;
  moments.mu30 = m30 * scale - 3.0 * cx * m20 * scale + 2.0 * cx * cx * cx;
  moments.mu03 = m03 * scale - 3.0 * cy * m02 * scale + 2.0 * cy * cy * cy;
  return moments;
}

namespace {

// Rounding leaves about 1e-15 of the moments in values that should be 0.
constexpr double kRounding = 1e-12;

double skewness(double third, double second) {
  return std::abs(second) > 0.001 ? third / (second * std::sqrt(second)) : 0.0;
}

}  // namespace

PrincipalAxis principalAxis(const ContactMoments& moments) noexcept {
  PrincipalAxis axis;
  if (moments.active == 0) return axis;
  const double difference = moments.mu20 - moments.mu02;
  const double root = std::sqrt(difference * difference + 4.0 * moments.mu11 * moments.mu11);
  const double sum = moments.mu20 + moments.mu02;
  axis.lambda1 = std::max(0.5 * (sum + root), 0.0);
  axis.lambda2 = std::max(0.5 * (sum - root), 0.0);
  if (axis.lambda1 > kRounding) {
    const double ratio = axis.lambda2 / axis.lambda1;
    axis.eccentricity = std::sqrt(1.0 - ratio);
    axis.studyEccentricity = std::sqrt(1.0 - ratio * ratio);
  }
  // For a contact parallel to an axis of the matrix, rounding alone would decide between 0 and 180
  // deg.
  const double small = kRounding * std::max(sum, 1.0);
  if (std::abs(moments.mu11) <= small) {
    axis.orientationDeg = difference < -small ? 90.0 : 0.0;
  } else {
    axis.orientationDeg =
        0.5 * std::atan2(2.0 * moments.mu11, difference) * 180.0 / std::numbers::pi;
    if (axis.orientationDeg < 0.0) axis.orientationDeg += 180.0;
    if (axis.orientationDeg >= 180.0) axis.orientationDeg = 0.0;
  }
  axis.skewX = skewness(moments.mu30, moments.mu20);
  axis.skewY = skewness(moments.mu03, moments.mu02);
  return axis;
}

}  // namespace palpate
