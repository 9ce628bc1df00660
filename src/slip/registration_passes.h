// Least squares of a rigid registration to any surface: a KeyFrame or a SurfaceGrid. Used by
// registerFrame() (rigid_registration.cpp, surface_readings.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "palpate/slip/rigid_registration.h"

namespace palpate::registration {

using NormalMatrix = Eigen::Matrix4f;
using MotionParameters = Eigen::Vector4f;  // dx, dy, angle [rad], gain

constexpr float kRadians = static_cast<float>(std::numbers::pi / 180.0);

struct Place {
  float dx = 0.0F;
  float dy = 0.0F;
  float angle = 0.0F;
  float gain = 1.0F;
};

// Properties of the contact on the surface.
struct Contact {
  float centerX = 0.0F;
  float centerY = 0.0F;
  // Load [counts].
  float sum = 0.0F;
  // Size of the contact: square root of the number of its active taxels [taxels]. It converts an
  // angle into a path.
  float extent = 1.0F;
  // Whether the rotation can be estimated.
  bool turns = false;
  // A taxel that reads 0 measured less than this [counts].
  float silent = 0.0F;
  // Range in which the surface may be evaluated [taxels].
  float lowX = 0.0F;
  float highX = 0.0F;
  float lowY = 0.0F;
  float highY = 0.0F;
};

// Rows and columns of the active taxels, with one taxel more on every side.
struct Window {
  int top = 0;
  int bottom = -1;
  int left = 0;
  int right = -1;
};

struct Frame {
  const float* values = nullptr;
  const std::uint8_t* enabled = nullptr;
  int columns = 0;
  Window window;
};

inline Window windowOf(const float* values, int rows, int columns, float& least) noexcept {
  Window window{rows, -1, columns, -1};
  least = 0.0F;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const float value = values[y * columns + x];
      if (!isTouched(value)) continue;
      least = least == 0.0F ? value : std::min(least, value);
      window = {std::min(window.top, y), y, std::min(window.left, x), std::max(window.right, x)};
    }
  if (window.bottom < 0) return window;
  return {std::max(window.top - 1, 0),
          std::min(window.bottom + 1, rows - 1),
          std::max(window.left - 1, 0),
          std::min(window.right + 1, columns - 1)};
}

struct NormalEquations {
  // Upper triangle of the normal equations, right side, sum of squares.
  std::array<float, 15> sums{};
  int taxels = 0;
  // Load of the surface that was inside the frame.
  float inside = 0.0F;
};

template <typename Surface>
NormalEquations accumulateNormalEquations(const Surface& surface,
                                          const Contact& contact,
                                          const Frame& frame,
                                          const Place& at,
                                          const RegistrationOptions& options) {
  NormalEquations pass;
  const float cosine = std::cos(at.angle);
  const float sine = std::sin(at.angle);
  const auto noise2 = static_cast<float>(options.noiseCounts * options.noiseCounts);
  const auto relative2 = static_cast<float>(options.relativeError * options.relativeError);
  const auto saturated = static_cast<float>(options.saturationCounts);
  NormalMatrix normal = NormalMatrix::Zero();
  MotionParameters right = MotionParameters::Zero();
  float squares = 0.0F;
  for (int y = frame.window.top; y <= frame.window.bottom; ++y)
    for (int x = frame.window.left; x <= frame.window.right; ++x) {
      const int place = y * frame.columns + x;
      const float vx = static_cast<float>(x) - contact.centerX - at.dx;
      const float vy = static_cast<float>(y) - contact.centerY - at.dy;
      const float ux = cosine * vx + sine * vy;
      const float uy = -sine * vx + cosine * vy;
      const float sx = ux + contact.centerX;
      const float sy = uy + contact.centerY;
      if (!(sx >= contact.lowX && sx <= contact.highX && sy >= contact.lowY && sy <= contact.highY))
        continue;
      if (frame.enabled[place] == 0) continue;
      const auto sample = surface.at(sx, sy);
      const float model = at.gain * sample.value;
      pass.inside += std::max(sample.value, 0.0F);
      float measured = frame.values[place];
      if (!isTouched(measured)) {
        // The model agrees with a reading below the threshold.
        if (model <= contact.silent) continue;
        measured = contact.silent;
      } else if (measured >= saturated && model >= measured) {
        continue;
      }
      const float residual = measured - model;
      const float weight =
          1.0F / (noise2 + relative2 * measured * measured + at.gain * at.gain * sample.variance);
      const MotionParameters slope(-at.gain * (cosine * sample.alongX - sine * sample.alongY),
                                   -at.gain * (sine * sample.alongX + cosine * sample.alongY),
                                   at.gain * (sample.alongX * uy - sample.alongY * ux),
                                   sample.value);
      const MotionParameters weighted = weight * slope;
      normal.noalias() += weighted * slope.transpose();
      right += residual * weighted;
      squares += weight * residual * residual;
      ++pass.taxels;
    }
  std::size_t i = 0;
  for (int row = 0; row < 4; ++row)
    for (int column = row; column < 4; ++column) pass.sums[i++] = normal(row, column);
  for (int row = 0; row < 4; ++row) pass.sums[i++] = right(row);
  pass.sums[i] = squares;
  return pass;
}

inline NormalMatrix normalOf(const NormalEquations& pass) {
  NormalMatrix normal;
  std::size_t i = 0;
  for (int row = 0; row < 4; ++row)
    for (int column = row; column < 4; ++column)
      normal(row, column) = normal(column, row) = pass.sums[i++];
  return normal;
}

// Determines the directions that the normal equations leave undetermined, and adds to `held` the
// terms that hold the motion along them.
inline DegenerateDirections degenerateDirectionsOf(const NormalMatrix& normal,
                                                   double sdTaxels,
                                                   Eigen::Matrix2f& held) {
  constexpr float kFirm = 1e6F;
  const Eigen::LLT<NormalMatrix> solver(normal);
  if (solver.info() != Eigen::Success) return {};
  NormalMatrix unit = NormalMatrix::Identity();
  solver.solveInPlace(unit);
  const float xx = unit(0, 0);
  const float yy = unit(1, 1);
  const float xy = unit(0, 1);
  const auto most = static_cast<float>(sdTaxels * sdTaxels);
  if (xx + yy <= most) return {};
  const float root = std::hypot(0.5F * (xx - yy), xy);
  // Direction of the larger variance.
  const float angle = 0.5F * std::atan2(2.0F * xy, xx - yy);
  const Eigen::Vector2f along(std::cos(angle), std::sin(angle));
  const Eigen::Vector2f across(-along.y(), along.x());
  DegenerateDirections degenerate;
  if (0.5F * (xx + yy) + root > most) {
    held += kFirm * along * along.transpose();
    degenerate.count = 1;
    degenerate.x = static_cast<double>(along.x());
    degenerate.y = static_cast<double>(along.y());
  }
  if (0.5F * (xx + yy) - root > most) {
    held += kFirm * across * across.transpose();
    degenerate.count = 2;
  }
  return degenerate;
}

// Runs the Gauss-Newton iteration from `start`.
template <typename Surface>
RegistrationResult registerTo(const Surface& surface,
                              const Contact& contact,
                              const Frame& frame,
                              const RigidMotion& start,
                              const RegistrationOptions& options) {
  RegistrationResult result;
  result.motion = start;
  Place at{static_cast<float>(start.dx),
           static_cast<float>(start.dy),
           static_cast<float>(start.angleDeg) * kRadians,
           static_cast<float>(start.gain)};
  const Place from = at;
  const float anglePrior =
      1.0F / static_cast<float>(std::pow(options.anglePriorDeg * static_cast<double>(kRadians), 2));
  const float gainPrior = 1.0F / static_cast<float>(std::pow(options.gainPrior * start.gain, 2));
  Eigen::Matrix2f held = Eigen::Matrix2f::Zero();
  const auto limit = static_cast<float>(options.convergedTaxels);
  for (int i = 0; i < options.maxIterations; ++i) {
    const NormalEquations pass = accumulateNormalEquations(surface, contact, frame, at, options);
    result.taxels = pass.taxels;
    result.overlap =
        std::clamp(static_cast<double>(pass.inside) / static_cast<double>(contact.sum), 0.0, 1.0);
    if (pass.taxels < 2 || result.overlap < options.minOverlap) break;
    result.chi2 = static_cast<double>(pass.sums[14]) / pass.taxels;
    NormalMatrix normal = normalOf(pass);
    MotionParameters right(pass.sums[10], pass.sums[11], pass.sums[12], pass.sums[13]);
    normal(0, 0) += 1e-3F;
    normal(1, 1) += 1e-3F;
    normal(2, 2) += anglePrior;
    right(2) += anglePrior * (from.angle - at.angle);
    normal(3, 3) += gainPrior;
    right(3) += gainPrior * (from.gain - at.gain);
    if (!contact.turns) {
      normal.row(2).setZero();
      normal.col(2).setZero();
      normal(2, 2) = 1.0F;
      right(2) = 0.0F;
    }
    if (i == 0)
      result.degenerate = degenerateDirectionsOf(normal, options.maxDirectionSdTaxels, held);
    normal.topLeftCorner<2, 2>() += held;
    right.head<2>() += held * Eigen::Vector2f(from.dx - at.dx, from.dy - at.dy);
    const Eigen::LLT<NormalMatrix> solver(normal);
    if (solver.info() != Eigen::Success) break;
    MotionParameters step = solver.solve(right);
    if (!step.allFinite()) break;
    // A step is limited to one taxel, half a radian and a doubled load.
    const float longest = std::max({std::abs(step(0)),
                                    std::abs(step(1)),
                                    2.0F * std::abs(step(2)),
                                    std::abs(step(3)) / at.gain});
    if (longest > 1.0F) step /= longest;
    at.dx += step(0);
    at.dy += step(1);
    at.angle += step(2);
    at.gain = std::clamp(at.gain + step(3), 0.02F, 50.0F);
    if (std::abs(at.dx) > 300.0F || std::abs(at.dy) > 300.0F) break;
    const float moved =
        std::max({std::abs(step(0)), std::abs(step(1)), contact.extent * std::abs(step(2))});
    if (moved < limit || i + 1 == options.maxIterations) {
      const NormalMatrix covariance = solver.solve(NormalMatrix::Identity());
      result.sdX = static_cast<double>(std::sqrt(covariance(0, 0)));
      result.sdY = static_cast<double>(std::sqrt(covariance(1, 1)));
      if (contact.turns)
        result.sdAngleDeg = static_cast<double>(std::sqrt(covariance(2, 2)) / kRadians);
      // Also converged when one more pass would make no significant change.
      result.converged = moved < 50.0F * limit;
      break;
    }
  }
  result.motion = {static_cast<double>(at.dx),
                   static_cast<double>(at.dy),
                   static_cast<double>(at.angle / kRadians),
                   static_cast<double>(at.gain)};
  return result;
}

}  // namespace palpate::registration
