#include "palpate/slip/rigid_registration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Dense>

namespace palpate {
namespace {

using Normal = Eigen::Matrix4f;
using Unknowns = Eigen::Vector4f;  // dx, dy, angle [rad], gain

struct Pass {
  Normal normal = Normal::Zero();
  Unknowns right = Unknowns::Zero();
  float squares = 0.0F;
  int taxels = 0;
  float inside = 0.0F;  // load of the key that was seen
};

struct Place {
  float dx, dy, angle, gain;
};

void check(bool good, const char* field, double value) {
  if (!good)
    throw std::invalid_argument(std::string("RegistrationOptions: ") + field + " is " +
                                std::to_string(value));
}

// One pass over the matrix at a motion: normal equations and residuals.
Pass passOver(const KeyFrame& key,
              const float* frame,
              const Place& at,
              float silent,
              const RegistrationOptions& options) {
  Pass pass;
  const MatrixLayout& layout = key.layout();
  const float cosine = std::cos(at.angle);
  const float sine = std::sin(at.angle);
  const auto cx = static_cast<float>(key.centerX());
  const auto cy = static_cast<float>(key.centerY());
  const float right = static_cast<float>(layout.columns - 1);
  const float bottom = static_cast<float>(layout.rows - 1);
  const auto noise2 = static_cast<float>(options.noiseCounts * options.noiseCounts);
  const auto relative = static_cast<float>(options.relativeError);
  const auto saturated = static_cast<float>(options.saturationCounts);
  const float blind = 0.3F * key.leastCounts();
  const bool masked = layout.numEnabled() != layout.numPlaces();

  for (int y = 0, i = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x, ++i) {
      const float vx = static_cast<float>(x) - cx - at.dx;
      const float vy = static_cast<float>(y) - cy - at.dy;
      const float ux = cosine * vx + sine * vy;
      const float uy = -sine * vx + cosine * vy;
      const float sx = ux + cx;
      const float sy = uy + cy;
      if (!(sx >= 0.0F && sx <= right && sy >= 0.0F && sy <= bottom)) continue;
      if (masked && !layout.enabled(y, x)) continue;
      const KeyFrame::Sample sample = key.at(sx, sy);
      const float model = at.gain * sample.value;
      pass.inside += std::max(sample.value, 0.0F);
      float measured = frame[i];
      if (!(measured > 0.0F)) {
        if (model <= silent) continue;  // as silent as expected
        measured = silent;
      } else if (measured >= saturated && model >= measured) {
        continue;
      }
      const float residual = measured - model;
      const float larger = relative * std::max(model, measured);
      const float unsure = sample.unknown * blind;
      const float weight = 1.0F / (noise2 + larger * larger + unsure * unsure);
      Unknowns slope;
      slope << -at.gain * (cosine * sample.alongX - sine * sample.alongY),
          -at.gain * (sine * sample.alongX + cosine * sample.alongY),
          at.gain * (sample.alongX * uy - sample.alongY * ux), sample.value;
      pass.normal.noalias() += (weight * slope) * slope.transpose();
      pass.right += (weight * residual) * slope;
      pass.squares += weight * residual * residual;
      ++pass.taxels;
    }
  return pass;
}

}  // namespace

void RegistrationOptions::validate() const {
  check(passes >= 1 && passes <= 50, "passes", passes);
  check(convergedTaxels > 0.0, "convergedTaxels", convergedTaxels);
  check(noiseCounts > 0.0, "noiseCounts", noiseCounts);
  check(relativeError >= 0.0, "relativeError", relativeError);
  check(saturationCounts > 0.0, "saturationCounts", saturationCounts);
  check(anglePriorDeg > 0.0, "anglePriorDeg", anglePriorDeg);
  check(leastTurning >= 0.0 && leastTurning <= 0.5, "leastTurning", leastTurning);
  check(gainPrior > 0.0, "gainPrior", gainPrior);
  check(leastOverlap >= 0.0 && leastOverlap <= 1.0, "leastOverlap", leastOverlap);
}

RegistrationResult registerFrame(const KeyFrame& key,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options,
                                 float* scratch) {
  RegistrationResult result;
  result.motion = start;
  const MatrixLayout& layout = key.layout();
  if (frame.rows() != layout.rows || frame.cols() != layout.columns)
    throw std::invalid_argument("registerFrame: the frame hasn't the size of the key's matrix");
  if (key.empty()) return result;

  const float* values = frame.data();
  if (key.options().blurTaxels > 0.0) {
    smoothMatrix(layout, key.options().blurTaxels, values, scratch);
    values = scratch;
  }
  float least = 0.0F;
  for (Eigen::Index i = 0; i < frame.size(); ++i)
    if (frame.data()[i] > 0.0F && (least == 0.0F || frame.data()[i] < least))
      least = frame.data()[i];
  if (least == 0.0F) return result;
  const float silent = key.options().blurTaxels > 0.0 ? 0.0F : std::min(least, key.leastCounts());

  constexpr double kRadians = std::numbers::pi / 180.0;
  Place at{static_cast<float>(start.dx),
           static_cast<float>(start.dy),
           static_cast<float>(start.angleDeg * kRadians),
           static_cast<float>(start.gain)};
  const Place from = at;
  const auto anglePrior = static_cast<float>(1.0 / std::pow(options.anglePriorDeg * kRadians, 2));
  const bool turns = key.turning() >= static_cast<float>(options.leastTurning);
  const float reach = 0.5F * static_cast<float>(std::max(layout.rows, layout.columns));
  // The extent of the contact turns an angle into taxels at its edge.
  const float extent = std::sqrt(static_cast<float>(key.active()));
  for (int i = 0; i < options.passes; ++i) {
    Pass pass = passOver(key, values, at, silent, options);
    result.taxels = pass.taxels;
    result.overlap = std::clamp(static_cast<double>(pass.inside) / key.sum(), 0.0, 1.0);
    if (pass.taxels < 2 || result.overlap < options.leastOverlap) break;
    result.chi2 = static_cast<double>(pass.squares) / pass.taxels;
    const float gainPrior =
        1.0F / static_cast<float>(std::pow(options.gainPrior * std::abs(start.gain), 2));
    pass.normal(2, 2) += anglePrior;
    pass.right(2) += anglePrior * (from.angle - at.angle);
    pass.normal(3, 3) += gainPrior;
    pass.right(3) += gainPrior * (from.gain - at.gain);
    pass.normal(0, 0) += 1e-3F;  // a motion that nothing tells is none
    pass.normal(1, 1) += 1e-3F;
    if (!turns) {
      pass.normal.row(2).setZero();
      pass.normal.col(2).setZero();
      pass.normal(2, 2) = 1.0F;
      pass.right(2) = 0.0F;
    }
    const Eigen::LLT<Normal> solver(pass.normal);
    if (solver.info() != Eigen::Success) break;
    Unknowns step = solver.solve(pass.right);
    if (!step.allFinite()) break;
    // A Gauss-Newton step is trusted over a taxel and a third of a right angle.
    const float longest = std::max({std::abs(step(0)),
                                    std::abs(step(1)),
                                    2.0F * std::abs(step(2)),
                                    std::abs(step(3)) / at.gain});
    if (longest > 1.0F) step /= longest;
    at.dx += step(0);
    at.dy += step(1);
    at.angle += step(2);
    at.gain = std::clamp(at.gain + step(3), 0.02F, 50.0F);
    if (std::abs(at.dx) > 2.0F * reach || std::abs(at.dy) > 2.0F * reach) break;
    const float moved =
        std::max({std::abs(step(0)), std::abs(step(1)), extent * std::abs(step(2))});
    result.converged = moved < static_cast<float>(options.convergedTaxels);
    if (result.converged || i + 1 == options.passes) {
      const Normal covariance = solver.solve(Normal::Identity());
      result.sdX = static_cast<double>(std::sqrt(covariance(0, 0)));
      result.sdY = static_cast<double>(std::sqrt(covariance(1, 1)));
      result.sdAngleDeg = static_cast<double>(std::sqrt(covariance(2, 2))) / kRadians;
      // Close enough for one pass more to change nothing that counts.
      result.converged = moved < 50.0F * static_cast<float>(options.convergedTaxels);
      break;
    }
  }
  result.motion = {static_cast<double>(at.dx),
                   static_cast<double>(at.dy),
                   static_cast<double>(at.angle) / kRadians,
                   static_cast<double>(at.gain)};
  return result;
}

RigidRegistration::RigidRegistration(const MatrixLayout& layout,
                                     const RegistrationOptions& options,
                                     const KeyFrameOptions& keyOptions)
    : key_(layout, keyOptions), options_(options), scratch_(layout.numPlaces()) {
  options_.validate();
}

}  // namespace palpate
