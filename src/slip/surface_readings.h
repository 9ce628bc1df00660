// Observations of a surface from a registered frame, and the registration of a frame to a surface:
// the same for LearnedSurface and MostProbableSurface.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/slip/surface_grid.h"

#include "slip/registration_passes.h"
#include "slip/spline_weights.h"

namespace palpate::registration {

// A reading of a taxel whose source lies between the 4 x 4 coefficients from `corner` on.
struct SurfaceReading {
  int corner = 0;
  spline::SplineWeights weightsX;
  spline::SplineWeights weightsY;
  float gain = 1.0F;
  float measured = 0.0F;  // [counts]
  float model = 0.0F;     // [counts]
  // Variance of the model from that of the surface, and of measured - model [counts^2].
  float variance = 0.0F;
  float all = 0.0F;
};

inline float squareOf(float value) { return value * value; }

// As SurfaceGrid::at(); inline, because a registration calls it for each taxel.
inline SurfaceGrid::Sample sampleOf(const SurfaceGrid& grid, float x, float y) noexcept {
  using spline::SplineWeights;
  const float halfX = 2.0F * x;
  const float halfY = 2.0F * y;
  const float floorX = std::floor(halfX);
  const float floorY = std::floor(halfY);
  const SplineWeights weightsX = spline::weights(halfX - floorX);
  const SplineWeights slopesX = spline::slopes(halfX - floorX);
  const SplineWeights weightsY = spline::weights(halfY - floorY);
  const SplineWeights slopesY = spline::slopes(halfY - floorY);
  const int corner = grid.cornerOf(static_cast<int>(floorY), static_cast<int>(floorX));
  const int columns = grid.columns();
  const float* coefficients = grid.coefficients() + corner;
  const float* variances = grid.variances() + corner;
  SplineWeights values = SplineWeights::Zero();
  SplineWeights slopes = SplineWeights::Zero();
  SplineWeights unsure = SplineWeights::Zero();
  for (int j = 0; j < 4; ++j) {
    const SplineWeights line = Eigen::Map<const SplineWeights>(coefficients + j * columns);
    values += weightsY(j) * line;
    slopes += slopesY(j) * line;
    unsure +=
        (weightsY(j) * weightsY(j)) * Eigen::Map<const SplineWeights>(variances + j * columns);
  }
  return {(values * weightsX).sum(),
          2.0F * (values * slopesX).sum(),
          2.0F * (slopes * weightsX).sum(),
          (unsure * weightsX * weightsX).sum()};
}

struct SurfaceView {
  const SurfaceGrid& grid;
  SurfaceGrid::Sample at(float x, float y) const noexcept { return sampleOf(grid, x, y); }
};

// Calls visit(SurfaceReading) for each taxel of a registered frame that tells something of the
// surface, in order; visit may change the surface. An error of the motion moves the whole surface,
// so that the errors of the taxels are correlated: its variance is multiplied by `motionCounts`.
// `least` becomes the smallest active value of all frames [counts].
template <typename Visit>
void forEachReading(const SurfaceGrid& grid,
                    const KeyFrame& key,
                    const ConstMatrixMap& frame,
                    const RegistrationResult& found,
                    const RegistrationOptions& options,
                    float motionCounts,
                    float& least,
                    const Visit& visit) {
  using spline::SplineWeights;
  const RigidMotion& motion = found.motion;
  const MatrixLayout& layout = key.layout();
  const auto angle = static_cast<float>(motion.angleDeg) * kRadians;
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const auto cx = static_cast<float>(key.centerX());
  const auto cy = static_cast<float>(key.centerY());
  const auto dx = static_cast<float>(motion.dx);
  const auto dy = static_cast<float>(motion.dy);
  const auto gain = static_cast<float>(motion.gain);
  const float noise2 = squareOf(static_cast<float>(options.noiseCounts));
  const float relative2 = squareOf(static_cast<float>(options.relativeError));
  const auto saturated = static_cast<float>(options.saturationCounts);
  const auto sdX = static_cast<float>(found.sdX);
  const auto sdY = static_cast<float>(found.sdY);
  const auto sdAngle = static_cast<float>(found.sdAngleDeg) * kRadians;
  const int columns = grid.columns();
  float smallest = 0.0F;
  const Window window = windowOf(frame.data(), layout.rows, layout.columns, smallest);
  if (smallest == 0.0F) return;
  least = std::min(least, smallest);

  for (int y = window.top; y <= window.bottom; ++y)
    for (int x = window.left; x <= window.right; ++x) {
      const int taxel = y * layout.columns + x;
      if (key.enabled()[taxel] == 0) continue;
      const float vx = static_cast<float>(x) - cx - dx;
      const float vy = static_cast<float>(y) - cy - dy;
      const float sx = cosine * vx + sine * vy + cx;
      const float sy = -sine * vx + cosine * vy + cy;
      constexpr auto kMargin = static_cast<float>(SurfaceGrid::kMargin);
      if (!(sx >= -kMargin && sx <= static_cast<float>(layout.columns - 1) + kMargin &&
            sy >= -kMargin && sy <= static_cast<float>(layout.rows - 1) + kMargin))
        continue;
      const float halfX = 2.0F * sx;
      const float halfY = 2.0F * sy;
      const float floorX = std::floor(halfX);
      const float floorY = std::floor(halfY);
      SurfaceReading reading;
      reading.gain = gain;
      reading.weightsX = spline::weights(halfX - floorX);
      reading.weightsY = spline::weights(halfY - floorY);
      reading.corner = grid.cornerOf(static_cast<int>(floorY), static_cast<int>(floorX));
      const float* coefficients = grid.coefficients() + reading.corner;
      const float* variances = grid.variances() + reading.corner;
      SplineWeights values = SplineWeights::Zero();
      SplineWeights unsure = SplineWeights::Zero();
      for (int j = 0; j < 4; ++j) {
        values += reading.weightsY(j) * Eigen::Map<const SplineWeights>(coefficients + j * columns);
        unsure += squareOf(reading.weightsY(j)) *
                  Eigen::Map<const SplineWeights>(variances + j * columns);
      }
      reading.model = gain * (values * reading.weightsX).sum();
      reading.variance = squareOf(gain) * (unsure * reading.weightsX * reading.weightsX).sum();
      reading.measured = frame.data()[taxel];
      if (!isTouched(reading.measured)) {
        if (reading.model <= least) continue;
        reading.measured = least;
      } else if (reading.measured >= saturated && reading.model >= reading.measured) {
        continue;
      }
      const SplineWeights along = values * spline::slopes(halfX - floorX);
      SplineWeights across = SplineWeights::Zero();
      const SplineWeights slopesY = spline::slopes(halfY - floorY);
      for (int j = 0; j < 4; ++j)
        across += slopesY(j) * Eigen::Map<const SplineWeights>(coefficients + j * columns);
      const float slopeX = 2.0F * gain * along.sum();
      const float slopeY = 2.0F * gain * (across * reading.weightsX).sum();
      const float turn = slopeX * (sy - cy) - slopeY * (sx - cx);
      const float unsureMotion =
          squareOf(slopeX * sdX) + squareOf(slopeY * sdY) + 4.0F * squareOf(turn * sdAngle);
      reading.all = reading.variance + noise2 + relative2 * squareOf(reading.measured) +
                    motionCounts * unsureMotion;
      visit(reading);
    }
}

// Updates the variances of the coefficients that a reading depends on, as a Kalman filter with a
// diagonal covariance matrix does. forgotten: process noise [counts^2]. change(j, gains) sees the
// Kalman gains of line j of the 4 x 4 coefficients.
template <typename Change>
void updateVariances(SurfaceGrid& grid,
                     const SurfaceReading& reading,
                     float forgotten,
                     const Change& change) {
  using spline::SplineWeights;
  float* variances = grid.variances() + reading.corner;
  const float scale = reading.gain / reading.all;
  for (int j = 0; j < 4; ++j) {
    Eigen::Map<SplineWeights> variancesOfRow(variances + j * grid.columns());
    const SplineWeights toward = (scale * reading.weightsY(j)) * reading.weightsX * variancesOfRow;
    change(j, toward);
    variancesOfRow += forgotten - toward * toward * reading.all;
  }
}

template <typename Surface>
RegistrationResult registerToSurface(const Surface& surface,
                                     const ConstMatrixMap& frame,
                                     const RigidMotion& start,
                                     const RegistrationOptions& options) {
  RegistrationResult result;
  result.motion = start;
  const KeyFrame& key = surface.start();
  const MatrixLayout& layout = key.layout();
  if (frame.rows() != layout.rows || frame.cols() != layout.columns)
    throw std::invalid_argument(
        "registerFrame: the frame doesn't have the size of the key's matrix");
  if (surface.empty()) return result;
  float least = 0.0F;
  const Frame view{frame.data(),
                   key.enabled(),
                   layout.columns,
                   windowOf(frame.data(), layout.rows, layout.columns, least)};
  if (least == 0.0F) return result;
  constexpr auto kMargin = static_cast<float>(SurfaceGrid::kMargin);
  const Contact contact{
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
  return registerTo(SurfaceView{surface.grid()}, contact, view, start, options);
}

}  // namespace palpate::registration
