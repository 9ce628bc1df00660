#include "palpate/recognition/chebyshev_moments.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr int kLargestSize = 256;
constexpr int kHighestOrder = 32;
// Limit relative to the spread of the image, below which a difference is due to rounding and the
// image has no axis.
constexpr double kRound = 1e-9;

void requirePicture(const Eigen::MatrixXd& picture, const ChebyshevPolynomials& of) {
  if (picture.rows() != of.size() || picture.cols() != of.size())
    throw std::invalid_argument(
        "Chebyshev moments: a picture of " + std::to_string(picture.rows()) + " x " +
        std::to_string(picture.cols()) + " for polynomials of size " + std::to_string(of.size()));
  if (!picture.allFinite())
    throw std::invalid_argument("Chebyshev moments: a picture with values that are not numbers");
}

struct CentralMoments {
  double mu20 = 0.0, mu11 = 0.0, mu02 = 0.0;
  double mu30 = 0.0, mu21 = 0.0, mu12 = 0.0, mu03 = 0.0;
};

CentralMoments centralMoments(const Eigen::MatrixXd& picture, double cx, double cy) {
  CentralMoments mu;
  for (Eigen::Index column = 0; column < picture.cols(); ++column)
    for (Eigen::Index row = 0; row < picture.rows(); ++row) {
      const double value = picture(row, column);
      if (value == 0.0) continue;
      const double x = static_cast<double>(column) - cx, y = static_cast<double>(row) - cy;
      mu.mu20 += value * x * x;
      mu.mu11 += value * x * y;
      mu.mu02 += value * y * y;
      mu.mu30 += value * x * x * x;
      mu.mu21 += value * x * x * y;
      mu.mu12 += value * x * y * y;
      mu.mu03 += value * y * y * y;
    }
  return mu;
}

void setAngle(const CentralMoments& mu,
              double size,
              ImageOrientation how,
              ChebyshevInvariants& out) {
  const double spread = std::abs(mu.mu20) + std::abs(mu.mu02);
  const double difference = mu.mu20 - mu.mu02;
  if (how == ImageOrientation::kNone) return;
  if (std::hypot(difference, 2.0 * mu.mu11) <= kRound * spread) return;
  if (how == ImageOrientation::kStudy) {
    out.angleRad = 0.5 * std::atan(2.0 * mu.mu11 / difference);
    out.angleDetermined = true;
    return;
  }
  out.angleRad = 0.5 * std::atan2(2.0 * mu.mu11, difference);
  const double c = std::cos(out.angleRad), s = std::sin(out.angleRad);
  const double along = c * c * c * mu.mu30 + 3.0 * c * c * s * mu.mu21 + 3.0 * c * s * s * mu.mu12 +
                       s * s * s * mu.mu03;
  out.angleDetermined = std::abs(along) > kRound * spread * size;
  if (!out.angleDetermined || along > 0.0) return;
  out.angleRad += out.angleRad > 0.0 ? -std::numbers::pi : std::numbers::pi;
}

}  // namespace

ChebyshevPolynomials::ChebyshevPolynomials(int size, int order) : size_(size), order_(order) {
  if (size < 1 || size > kLargestSize)
    throw std::invalid_argument("ChebyshevPolynomials: size must be 1..256, is " +
                                std::to_string(size));
  if (order < 0 || order > kHighestOrder || order >= size)
    throw std::invalid_argument("ChebyshevPolynomials: order must be 0..min(size - 1, 32), is " +
                                std::to_string(order));
  slope_.resize(order);
  back_.resize(order);
  // beta_{n+1} / beta_n, from beta_n^2 = (N+n)! / ((2n+1) (N-n-1)!).
  const auto ratio = [size](double n) {
    return std::sqrt((size + n + 1.0) * (size - n - 1.0) * (2.0 * n + 1.0) / (2.0 * n + 3.0));
  };
  for (int n = 0; n < order; ++n) {
    const double k = n;
    slope_[n] = (2.0 * k + 1.0) / ((k + 1.0) * ratio(k));
    back_[n] = n == 0 ? 0.0
                      : k * (static_cast<double>(size) * size - k * k) /
                            ((k + 1.0) * ratio(k) * ratio(k - 1.0));
  }
}

void ChebyshevPolynomials::at(double x, double* out) const noexcept {
  const double fromMiddle = 2.0 * x - size_ + 1.0;
  out[0] = 1.0 / std::sqrt(static_cast<double>(size_));
  for (int n = 0; n < order_; ++n)
    out[n + 1] = slope_[n] * fromMiddle * out[n] - (n == 0 ? 0.0 : back_[n] * out[n - 1]);
}

Eigen::MatrixXd chebyshevMoments(const Eigen::MatrixXd& picture, const ChebyshevPolynomials& of) {
  requirePicture(picture, of);
  Eigen::MatrixXd values(of.order() + 1, of.size());
  for (int x = 0; x < of.size(); ++x) of.at(x, values.col(x).data());
  return values * picture.transpose() * values.transpose();
}

ChebyshevInvariants chebyshevInvariants(const Eigen::MatrixXd& picture,
                                        const ChebyshevPolynomials& of,
                                        ImageOrientation angle) {
  requirePicture(picture, of);
  const int orders = of.order() + 1;
  ChebyshevInvariants out;
  out.moments = Eigen::MatrixXd::Zero(orders, orders);
  const double sum = picture.sum();
  if (sum == 0.0) return out;
  out.empty = false;
  const Eigen::VectorXd places = Eigen::VectorXd::LinSpaced(of.size(), 0.0, of.size() - 1.0);
  out.centroidX = picture.colwise().sum().dot(places) / sum;
  out.centroidY = picture.rowwise().sum().dot(places) / sum;
  setAngle(centralMoments(picture, out.centroidX, out.centroidY), of.size(), angle, out);

  const double c = std::cos(out.angleRad), s = std::sin(out.angleRad);
  Eigen::VectorXd tp(orders), tq(orders);
  for (Eigen::Index column = 0; column < picture.cols(); ++column)
    for (Eigen::Index row = 0; row < picture.rows(); ++row) {
      const double value = picture(row, column);
      if (value == 0.0) continue;
      const double x = static_cast<double>(column) - out.centroidX;
      const double y = static_cast<double>(row) - out.centroidY;
      of.at(x * c + y * s, tp.data());
      of.at(-x * s + y * c, tq.data());
      out.moments.noalias() += (value * tp) * tq.transpose();
    }
  return out;
}

Eigen::MatrixXd reconstructImage(const Eigen::MatrixXd& moments, const ChebyshevPolynomials& of) {
  if (moments.rows() != of.order() + 1 || moments.cols() != of.order() + 1)
    throw std::invalid_argument("reconstructImage: " + std::to_string(moments.rows()) + " x " +
                                std::to_string(moments.cols()) + " moments for order " +
                                std::to_string(of.order()));
  Eigen::MatrixXd values(of.order() + 1, of.size());
  for (int x = 0; x < of.size(); ++x) of.at(x, values.col(x).data());
  return values.transpose() * moments.transpose() * values;
}

double reconstructionError(const Eigen::MatrixXd& picture, const Eigen::MatrixXd& approximation) {
  if (picture.rows() != approximation.rows() || picture.cols() != approximation.cols())
    throw std::invalid_argument("reconstructionError: pictures of different sizes");
  const double wrong = (picture - approximation).squaredNorm(), all = picture.squaredNorm();
  if (all > 0.0) return std::sqrt(wrong / all);
  return wrong > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

Eigen::MatrixXd padToSquare(const Eigen::MatrixXd& picture, int size, int above, int left) {
  if (above < 0 || left < 0 || above + picture.rows() > size || left + picture.cols() > size)
    throw std::invalid_argument("padToSquare: a picture of " + std::to_string(picture.rows()) +
                                " x " + std::to_string(picture.cols()) + " doesn't fit at (" +
                                std::to_string(left) + ", " + std::to_string(above) + ") of " +
                                std::to_string(size));
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(size, size);
  square.block(above, left, picture.rows(), picture.cols()) = picture;
  return square;
}

}  // namespace palpate
