#include "palpate/slip/learned_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "slip/registration_passes.h"
#include "slip/spline_weights.h"

namespace palpate {
namespace {

using spline::SplineWeights;

// Number of half places before the first taxel: the margin, and one more for the reach of the
// spline.
constexpr int kBefore = 2 * LearnedSurface::kMargin + 1;

void checkLearnedSurface(bool good, const char* field, double value) {
  if (!good)
    throw std::invalid_argument(std::string("LearnedSurfaceOptions: ") + field + " is " +
                                std::to_string(value));
}

constexpr float kMotionCounts = 8.0F;

float learnedSurfaceSquare(float value) { return value * value; }

}  // namespace

void LearnedSurfaceOptions::validate() const {
  checkLearnedSurface(curvatureSd >= 0.0, "curvatureSd", curvatureSd);
  checkLearnedSurface(belowThresholdSd >= 0.0, "belowThresholdSd", belowThresholdSd);
  checkLearnedSurface(outsideSd > 0.0, "outsideSd", outsideSd);
  checkLearnedSurface(processNoiseRatio >= 0.0, "processNoiseRatio", processNoiseRatio);
  key.validate();
}

LearnedSurface::LearnedSurface(const MatrixLayout& layout, const LearnedSurfaceOptions& options)
    : key_(layout, options.key), options_(options) {
  options_.validate();
  columns_ = 2 * layout.columns + 2 * kBefore;
  rows_ = 2 * layout.rows + 2 * kBefore;
  const auto size = static_cast<std::size_t>(columns_ * rows_);
  coefficients_.resize(size);
  variances_.resize(size);
  ofTaxels_.resize(layout.numCells());
}

bool LearnedSurface::set(const ConstMatrixMap& frame, double noiseCounts) {
  if (!key_.set(frame)) return false;
  const MatrixLayout& layout = key_.layout();
  const int rows = layout.rows;
  const int columns = layout.columns;
  least_ = key_.minCounts();
  const float* filled = key_.filled().data();
  const float noise2 = learnedSurfaceSquare(static_cast<float>(noiseCounts));
  const float largest = *std::max_element(filled, filled + layout.numCells());
  const float outside = learnedSurfaceSquare(static_cast<float>(options_.outsideSd) * largest);
  const float silence =
      learnedSurfaceSquare(static_cast<float>(options_.belowThresholdSd) * least_);
  const auto bendSd = static_cast<float>(options_.curvatureSd);

  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int i = y * columns + x;
      float bend = 0.0F;
      if (x > 0 && x + 1 < columns)
        bend += std::abs(filled[i - 1] - 2.0F * filled[i] + filled[i + 1]);
      if (y > 0 && y + 1 < rows)
        bend += std::abs(filled[i - columns] - 2.0F * filled[i] + filled[i + columns]);
      float variance = noise2 + learnedSurfaceSquare(bendSd * bend);
      if (key_.at(static_cast<float>(x), static_cast<float>(y)).unknown > 0.5F)
        variance += key_.enabled()[i] != 0 ? silence : outside;
      ofTaxels_[static_cast<std::size_t>(i)] = variance;
    }

  // Coefficients of the same surface with half the knot distance: filter (1 4 6 4 1)/8 along either
  // axis.
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const int halfY = row - kBefore;
      const int halfX = column - kBefore;
      const int y = static_cast<int>(std::floor(0.5 * halfY));
      const int x = static_cast<int>(std::floor(0.5 * halfX));
      const bool oddY = halfY != 2 * y;
      const bool oddX = halfX != 2 * x;
      float value = 0.0F;
      for (int j = -1; j <= 1; ++j) {
        const float weightY = oddY ? (j < 0 ? 0.0F : 0.5F) : (j == 0 ? 0.75F : 0.125F);
        if (weightY == 0.0F) continue;
        for (int i = -1; i <= 1; ++i) {
          const float weightX = oddX ? (i < 0 ? 0.0F : 0.5F) : (i == 0 ? 0.75F : 0.125F);
          if (weightX != 0.0F) value += weightY * weightX * key_.coefficient(y + j, x + i);
        }
      }
      const auto place = static_cast<std::size_t>(row * columns_ + column);
      const bool isOutside =
          halfX < -1 || halfY < -1 || halfX > 2 * columns - 1 || halfY > 2 * rows - 1;
      const int nearX = std::clamp(x, 0, columns - 1);
      const int nearY = std::clamp(y, 0, rows - 1);
      const int nextX = std::clamp(x + (oddX ? 1 : 0), 0, columns - 1);
      const int nextY = std::clamp(y + (oddY ? 1 : 0), 0, rows - 1);
      const auto taxel = [&](int ty, int tx) {
        return ofTaxels_[static_cast<std::size_t>(ty * columns + tx)];
      };
      variances_[place] = 0.25F * (taxel(nearY, nearX) + taxel(nearY, nextX) + taxel(nextY, nearX) +
                                   taxel(nextY, nextX));
      if (isOutside) {
        value = std::clamp(value, 0.0F, largest);
        variances_[place] += filled[nearY * columns + nearX] > 0.0F ? outside : silence;
      }
      coefficients_[place] = value;
    }
  return true;
}

LearnedSurface::Sample LearnedSurface::at(float x, float y) const noexcept {
  const float halfX = 2.0F * x;
  const float halfY = 2.0F * y;
  const float floorX = std::floor(halfX);
  const float floorY = std::floor(halfY);
  const SplineWeights weightsX = spline::weights(halfX - floorX);
  const SplineWeights slopesX = spline::slopes(halfX - floorX);
  const SplineWeights weightsY = spline::weights(halfY - floorY);
  const SplineWeights slopesY = spline::slopes(halfY - floorY);
  const int corner =
      (static_cast<int>(floorY) + kBefore - 1) * columns_ + static_cast<int>(floorX) + kBefore - 1;
  const float* coefficients = coefficients_.data() + corner;
  const float* variances = variances_.data() + corner;
  SplineWeights values = SplineWeights::Zero();
  SplineWeights slopes = SplineWeights::Zero();
  SplineWeights unsure = SplineWeights::Zero();
  for (int j = 0; j < 4; ++j) {
    const SplineWeights line = Eigen::Map<const SplineWeights>(coefficients + j * columns_);
    values += weightsY(j) * line;
    slopes += slopesY(j) * line;
    unsure +=
        (weightsY(j) * weightsY(j)) * Eigen::Map<const SplineWeights>(variances + j * columns_);
  }
  return {(values * weightsX).sum(),
          2.0F * (values * slopesX).sum(),
          2.0F * (slopes * weightsX).sum(),
          (unsure * weightsX * weightsX).sum()};
}

void LearnedSurface::learn(const ConstMatrixMap& frame,
                           const RegistrationResult& found,
                           const RegistrationOptions& options) noexcept {
  const RigidMotion& motion = found.motion;
  if (empty() || motion.gain <= 0.0) return;
  const MatrixLayout& layout = key_.layout();
  const auto angle = static_cast<float>(motion.angleDeg) * registration::kRadians;
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const auto cx = static_cast<float>(key_.centerX());
  const auto cy = static_cast<float>(key_.centerY());
  const auto dx = static_cast<float>(motion.dx);
  const auto dy = static_cast<float>(motion.dy);
  const auto gain = static_cast<float>(motion.gain);
  const float noise2 = learnedSurfaceSquare(static_cast<float>(options.noiseCounts));
  const float relative2 = learnedSurfaceSquare(static_cast<float>(options.relativeError));
  const auto saturated = static_cast<float>(options.saturationCounts);
  const float forgotten = static_cast<float>(options_.processNoiseRatio) * noise2;
  const auto sdX = static_cast<float>(found.sdX);
  const auto sdY = static_cast<float>(found.sdY);
  const auto sdAngle = static_cast<float>(found.sdAngleDeg) * registration::kRadians;
  float least = 0.0F;
  const registration::Window window =
      registration::windowOf(frame.data(), layout.rows, layout.columns, least);
  if (least == 0.0F) return;
  least_ = std::min(least_, least);

  for (int y = window.top; y <= window.bottom; ++y)
    for (int x = window.left; x <= window.right; ++x) {
      const int taxel = y * layout.columns + x;
      if (key_.enabled()[taxel] == 0) continue;
      const float vx = static_cast<float>(x) - cx - dx;
      const float vy = static_cast<float>(y) - cy - dy;
      const float sx = cosine * vx + sine * vy + cx;
      const float sy = -sine * vx + cosine * vy + cy;
      const auto margin = static_cast<float>(kMargin);
      if (!(sx >= -margin && sx <= static_cast<float>(layout.columns - 1) + margin &&
            sy >= -margin && sy <= static_cast<float>(layout.rows - 1) + margin))
        continue;
      const float halfX = 2.0F * sx;
      const float halfY = 2.0F * sy;
      const float floorX = std::floor(halfX);
      const float floorY = std::floor(halfY);
      const SplineWeights weightsX = spline::weights(halfX - floorX);
      const SplineWeights weightsY = spline::weights(halfY - floorY);
      const int corner = (static_cast<int>(floorY) + kBefore - 1) * columns_ +
                         static_cast<int>(floorX) + kBefore - 1;
      float* coefficients = coefficients_.data() + corner;
      float* variances = variances_.data() + corner;
      SplineWeights values = SplineWeights::Zero();
      SplineWeights unsure = SplineWeights::Zero();
      for (int j = 0; j < 4; ++j) {
        values += weightsY(j) * Eigen::Map<const SplineWeights>(coefficients + j * columns_);
        unsure += learnedSurfaceSquare(weightsY(j)) *
                  Eigen::Map<const SplineWeights>(variances + j * columns_);
      }
      const float model = gain * (values * weightsX).sum();
      const float variance = learnedSurfaceSquare(gain) * (unsure * weightsX * weightsX).sum();
      float measured = frame.data()[taxel];
      if (!(measured > 0.0F)) {
        if (model <= least_) continue;
        measured = least_;
      } else if (measured >= saturated && model >= measured) {
        continue;
      }
      // An error of the motion moves the whole surface, so that the errors of the taxels are
      // correlated. Its variance is therefore multiplied by kMotionCounts.
      const SplineWeights along = values * spline::slopes(halfX - floorX);
      SplineWeights across = SplineWeights::Zero();
      const SplineWeights slopesY = spline::slopes(halfY - floorY);
      for (int j = 0; j < 4; ++j)
        across += slopesY(j) * Eigen::Map<const SplineWeights>(coefficients + j * columns_);
      const float slopeX = 2.0F * gain * along.sum();
      const float slopeY = 2.0F * gain * (across * weightsX).sum();
      const float turn = slopeX * (sy - cy) - slopeY * (sx - cx);
      const float unsureMotion = learnedSurfaceSquare(slopeX * sdX) +
                                 learnedSurfaceSquare(slopeY * sdY) +
                                 4.0F * learnedSurfaceSquare(turn * sdAngle);
      const float all = variance + noise2 + relative2 * learnedSurfaceSquare(measured) +
                        kMotionCounts * unsureMotion;
      const float residual = measured - model;
      const float scale = gain / all;
      for (int j = 0; j < 4; ++j) {
        Eigen::Map<SplineWeights> variancesOfRow(variances + j * columns_);
        Eigen::Map<SplineWeights> row(coefficients + j * columns_);
        // Kalman gain.
        const SplineWeights toward = (scale * weightsY(j)) * weightsX * variancesOfRow;
        row += residual * toward;
        variancesOfRow += forgotten - toward * toward * all;
      }
    }
}

RegistrationResult registerFrame(const LearnedSurface& surface,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options) {
  RegistrationResult result;
  result.motion = start;
  const KeyFrame& key = surface.start();
  const MatrixLayout& layout = key.layout();
  if (frame.rows() != layout.rows || frame.cols() != layout.columns)
    throw std::invalid_argument("registerFrame: the frame hasn't the size of the key's matrix");
  if (surface.empty()) return result;
  float least = 0.0F;
  const registration::Frame view{
      frame.data(),
      key.enabled(),
      layout.columns,
      registration::windowOf(frame.data(), layout.rows, layout.columns, least)};
  if (least == 0.0F) return result;
  constexpr auto kMargin = static_cast<float>(LearnedSurface::kMargin);
  const registration::Contact contact{
      static_cast<float>(key.centerX()),
      static_cast<float>(key.centerY()),
      static_cast<float>(key.sum()),
      std::sqrt(static_cast<float>(key.active())),
      key.rotationSensitivity() >= static_cast<float>(options.minRotationSensitivity),
      std::min(least, surface.minCounts()),
      -kMargin,
      static_cast<float>(layout.columns - 1) + kMargin,
      -kMargin,
      static_cast<float>(layout.rows - 1) + kMargin};
  return registration::registerTo(surface, contact, view, start, options);
}

}  // namespace palpate
