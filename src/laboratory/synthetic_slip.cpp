#include "palpate/laboratory/synthetic_slip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "palpate/core/option_check.h"

namespace palpate {
namespace {

constexpr std::array kShapes{SlipShape::kDisc,
                             SlipShape::kBar,
                             SlipShape::kFlatEllipse,
                             SlipShape::kTwoBlobs,
                             SlipShape::kGaussian,
                             SlipShape::kEllipticGaussian};

constexpr double kDiscRadius = 2.2;
constexpr double kBarHalfWidth = 1.2;
constexpr double kBarHalfLength = 2.6;
constexpr double kEllipseHalfWidth = 1.5;
constexpr double kEllipseHalfLength = 2.9;
constexpr double kBlobSd = 0.9;
// Distance of a blob from the centre [taxels].
constexpr double kBlobDistance = 1.8;
constexpr double kSecondBlob = 0.8;
constexpr double kGaussianSd = 1.5;
constexpr double kNarrowSd = 1.1;
constexpr double kLongSd = 2.2;

double syntheticSlipSquare(double value) { return value * value; }

// Height of a half plane that ends at distance 0, blurred by the cover.
double softEdge(double outside, double cover) {
  return 0.5 * std::erfc(outside / (std::numbers::sqrt2 * cover));
}

// Height of a shape at (u, v), in the frame of the contact: u across, v along [taxels].
double height(SlipShape shape, double u, double v, double cover) {
  switch (shape) {
    case SlipShape::kDisc:
      return softEdge(std::hypot(u, v) - kDiscRadius, cover);
    case SlipShape::kBar:
      return 0.25 *
             (std::erf((kBarHalfWidth - u) / (std::numbers::sqrt2 * cover)) +
              std::erf((kBarHalfWidth + u) / (std::numbers::sqrt2 * cover))) *
             (std::erf((kBarHalfLength - v) / (std::numbers::sqrt2 * cover)) +
              std::erf((kBarHalfLength + v) / (std::numbers::sqrt2 * cover)));
    case SlipShape::kFlatEllipse: {
      // Distance from the edge to first order: the implicit function divided by its gradient.
      const double radius = std::hypot(u / kEllipseHalfWidth, v / kEllipseHalfLength);
      if (radius < 1e-6) return softEdge(-kEllipseHalfWidth, cover);
      const double slope = std::hypot(u / syntheticSlipSquare(kEllipseHalfWidth),
                                      v / syntheticSlipSquare(kEllipseHalfLength)) /
                           radius;
      return softEdge((radius - 1.0) / slope, cover);
    }
    case SlipShape::kTwoBlobs:
      return std::exp(-0.5 * (syntheticSlipSquare(u) + syntheticSlipSquare(v + kBlobDistance)) /
                      syntheticSlipSquare(kBlobSd)) +
             kSecondBlob *
                 std::exp(-0.5 * (syntheticSlipSquare(u) + syntheticSlipSquare(v - kBlobDistance)) /
                          syntheticSlipSquare(kBlobSd));
    case SlipShape::kGaussian:
      return std::exp(-0.5 * (syntheticSlipSquare(u) + syntheticSlipSquare(v)) /
                      syntheticSlipSquare(kGaussianSd));
    case SlipShape::kEllipticGaussian:
      return std::exp(-0.5 *
                      (syntheticSlipSquare(u / kNarrowSd) + syntheticSlipSquare(v / kLongSd)));
  }
  return 0.0;
}

}  // namespace

std::span<const SlipShape> slipShapes() noexcept { return kShapes; }

std::string_view nameOf(SlipShape shape) noexcept {
  switch (shape) {
    case SlipShape::kDisc:
      return "disc";
    case SlipShape::kBar:
      return "bar";
    case SlipShape::kFlatEllipse:
      return "flat-ellipse";
    case SlipShape::kTwoBlobs:
      return "two-blobs";
    case SlipShape::kGaussian:
      return "gaussian";
    case SlipShape::kEllipticGaussian:
      return "elliptic-gaussian";
  }
  return "unknown";
}

std::optional<SlipShape> slipShapeNamed(std::string_view name) noexcept {
  for (const SlipShape shape : kShapes)
    if (nameOf(shape) == name) return shape;
  return std::nullopt;
}

bool hasOrientation(SlipShape shape) noexcept {
  return shape != SlipShape::kDisc && shape != SlipShape::kGaussian;
}

bool hasEdge(SlipShape shape) noexcept {
  return shape == SlipShape::kDisc || shape == SlipShape::kBar || shape == SlipShape::kFlatEllipse;
}

void SyntheticSensor::validate() const {
  constexpr OptionCheck check{"SyntheticSensor"};
  layout.validate();
  check(noiseSd >= 0.0 && noiseSd <= 4095.0, "noiseSd", noiseSd);
  check(thresholdCounts >= 0.0 && thresholdCounts <= 4095.0, "thresholdCounts", thresholdCounts);
  check(saturationCounts > thresholdCounts && saturationCounts <= 4095.0,
        "saturationCounts",
        saturationCounts);
  check(kCoverTaxels, "coverTaxels", coverTaxels);
}

void idealCounts(const SyntheticContact& contact, const SyntheticSensor& sensor, MatrixMap counts) {
  const MatrixLayout& layout = sensor.layout;
  if (counts.rows() != layout.rows || counts.cols() != layout.columns)
    throw std::invalid_argument("idealCounts: the matrix doesn't have the size of the layout");
  // Gauss-Legendre nodes on a taxel of width 1.
  const double offset = 0.5 * std::sqrt(0.6);
  const std::array<double, 3> places{-offset, 0.0, offset};
  const std::array<double, 3> weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const double angle = contact.angleDeg * std::numbers::pi / 180.0;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  for (int row = 0; row < layout.rows; ++row)
    for (int column = 0; column < layout.columns; ++column) {
      double sum = 0.0;
      if (layout.enabled(row, column))
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) {
            const double x = column + places[j] - contact.x;
            const double y = row + places[i] - contact.y;
            const double tilt =
                1.0 + contact.tiltX * std::tanh(x / 2.0) + contact.tiltY * std::tanh(y / 2.0);
            sum += weights[i] * weights[j] * std::max(tilt, 0.0) *
                   height(contact.shape,
                          cosine * x + sine * y,
                          -sine * x + cosine * y,
                          sensor.coverTaxels);
          }
      counts(row, column) = static_cast<float>(contact.peakCounts * sum);
    }
}

SyntheticSlip::SyntheticSlip(const SyntheticSensor& sensor, std::uint64_t seed)
    : sensor_(sensor), random_(seed) {
  sensor_.validate();
}

// Normal random number by the Box-Muller method. The distributions of the standard library are not
// used because they differ between implementations.
double SyntheticSlip::normal() {
  if (hasKept_) {
    hasKept_ = false;
    return kept_;
  }
  const double scale = 1.0 / 9007199254740992.0;  // 2^-53
  const double u = (static_cast<double>(random_() >> 11U) + 0.5) * scale;
  const double v = static_cast<double>(random_() >> 11U) * scale;
  const double radius = std::sqrt(-2.0 * std::log(u));
  kept_ = radius * std::sin(2.0 * std::numbers::pi * v);
  hasKept_ = true;
  return radius * std::cos(2.0 * std::numbers::pi * v);
}

void SyntheticSlip::read(const SyntheticContact& contact, MatrixMap counts) {
  idealCounts(contact, sensor_, counts);
  for (int y = 0; y < sensor_.layout.rows; ++y)
    for (int x = 0; x < sensor_.layout.columns; ++x) {
      if (!sensor_.layout.enabled(y, x)) continue;
      const double noisy = static_cast<double>(counts(y, x)) + sensor_.noiseSd * normal();
      const double counted = std::round(std::min(noisy, sensor_.saturationCounts));
      counts(y, x) =
          counted < sensor_.thresholdCounts || counted < 0.0 ? 0.0F : static_cast<float>(counted);
    }
}

}  // namespace palpate
