#include "palpate/slip/slip_hypotheses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "palpate/core/option_check.h"

namespace palpate {
namespace {

// Standard deviation of a value between 0 and the threshold, as a fraction of the threshold.
constexpr float kBlindPart = 0.3F;
constexpr int kFieldPasses = 2;
// Variance of the slope of a spline per variance of its values.
constexpr double kNoiseOfSlope = 0.75;
constexpr float kSlopeGuess = 1.0F;
constexpr std::array<std::pair<int, int>, 4> kNeighbors = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

void checkSize(const KeyFrame& key, const ConstMatrixMap& frame) {
  if (frame.rows() != key.layout().rows || frame.cols() != key.layout().columns)
    throw std::invalid_argument("load shift: the frame doesn't have the size of the key's matrix");
}

float minActiveTaxels(const ConstMatrixMap& frame) {
  float least = 0.0F;
  for (Eigen::Index i = 0; i < frame.size(); ++i) {
    const float value = frame.data()[i];
    if (isTouched(value) && (least == 0.0F || value < least)) least = value;
  }
  return least;
}

// Weight of a taxel, as both hypotheses use it.
struct Weighing {
  explicit Weighing(const RegistrationOptions& options, float blindCounts)
      : noise2(static_cast<float>(options.noiseCounts * options.noiseCounts)),
        relative(static_cast<float>(options.relativeError)),
        blind(blindCounts) {}
  float operator()(float model, float measured, float unknown) const {
    const float larger = relative * std::max(model, measured);
    const float unsure = unknown * blind;
    return 1.0F / (noise2 + larger * larger + unsure * unsure);
  }
  float noise2, relative, blind;
};

int activeInEither(const KeyFrame& key, const ConstMatrixMap& frame) {
  const std::vector<float>& values = key.smoothed();
  int active = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (isTouched(values[i]) || isTouched(frame.data()[i])) ++active;
  return active;
}

}  // namespace

void SlipHypothesisOptions::validate() const {
  constexpr OptionCheck check{"SlipHypothesisOptions"};
  registration.validate();
  check(sharpness > 0.0, "sharpness", sharpness);
  check(misfit > 0.0, "misfit", misfit);
}

LoadFieldResult fitLoadField(const KeyFrame& key,
                             const ConstMatrixMap& frame,
                             const RegistrationOptions& options) {
  checkSize(key, frame);
  LoadFieldResult result;
  const float least = minActiveTaxels(frame);
  if (key.empty() || least == 0.0F) return result;
  const MatrixLayout& layout = key.layout();
  const bool masked = layout.numEnabled() != layout.numCells();
  const float silent = std::min(least, key.minCounts());
  const auto saturated = static_cast<float>(options.saturationCounts);
  const Weighing weigh(options, kBlindPart * key.minCounts());
  const float* then = key.smoothed().data();
  const auto cx = static_cast<float>(key.centerX());
  const auto cy = static_cast<float>(key.centerY());
  const auto load = static_cast<double>(frame.cwiseMax(0.0F).sum());
  Eigen::Vector3f field(static_cast<float>(load / key.sum()), 0.0F, 0.0F);
  float squares = 0.0F;
  for (int pass = 0; pass <= kFieldPasses; ++pass) {
    Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
    Eigen::Vector3f right = Eigen::Vector3f::Zero();
    squares = 0.0F;
    for (int y = 0, i = 0; y < layout.rows; ++y)
      for (int x = 0; x < layout.columns; ++x, ++i) {
        float measured = frame.data()[i];
        // Below the threshold in both frames: the value that the key is filled with carries no
        // information.
        if (!isTouched(measured) && !isTouched(then[i])) continue;
        if (masked && !layout.enabled(y, x)) continue;
        const KeyFrame::Sample sample = key.at(static_cast<float>(x), static_cast<float>(y));
        const Eigen::Vector3f slope(sample.value,
                                    sample.value * (static_cast<float>(x) - cx),
                                    sample.value * (static_cast<float>(y) - cy));
        const float model = std::max(0.0F, slope.dot(field));
        if (!isTouched(measured)) {
          if (model <= silent) continue;
          measured = silent;
        } else if (measured >= saturated && model >= measured) {
          continue;
        }
        const float weight = weigh(model, measured, sample.unknown);
        squares += weight * (measured - model) * (measured - model);
        normal.noalias() += (weight * slope) * slope.transpose();
        right += (weight * measured) * slope;
      }
    if (pass == kFieldPasses) break;
    // The ridge sets the gradient to 0 along an axis in which the contact has no extent.
    const float ridge = 1e-3F + 1e-4F * normal(0, 0);
    normal(0, 0) += 1e-4F * normal(0, 0) + 1e-9F;
    normal(1, 1) += ridge;
    normal(2, 2) += ridge;
    const Eigen::Vector3f solved = normal.ldlt().solve(right);
    if (!solved.allFinite()) return result;
    field = solved;
  }
  result.taxels = activeInEither(key, frame);
  result.field = {
      static_cast<double>(field(0)), static_cast<double>(field(1)), static_cast<double>(field(2))};
  result.residual = static_cast<double>(squares) / result.taxels;
  return result;
}

double motionScore(double loadShiftResidual,
                   double motionResidual,
                   const SlipHypothesisOptions& options) {
  const double power =
      options.sharpness / (1.0 + std::min(loadShiftResidual, motionResidual) / options.misfit);
  return 1.0 / (1.0 + std::pow((motionResidual + 1.0) / (loadShiftResidual + 1.0), power));
}

SlipHypothesisResult compareSlipHypotheses(const KeyFrame& key,
                                           const ConstMatrixMap& frame,
                                           std::span<const RigidMotion> starts,
                                           const SlipHypothesisOptions& options) {
  if (key.options().blurTaxels > 0.0)
    throw std::invalid_argument("load shift: the key frame is blurred");
  SlipHypothesisResult result;
  const LoadFieldResult still = fitLoadField(key, frame, options.registration);
  if (still.taxels == 0) return result;
  for (const RigidMotion& start : starts) {
    const RegistrationResult moved =
        registerFrame(key, frame, start, options.registration, nullptr);
    if (moved.taxels < 2 || moved.overlap < options.registration.minOverlap) continue;
    const double residual = moved.chi2 * moved.taxels / still.taxels;
    if (result.computed && residual >= result.motionResidual) continue;
    result.computed = true;
    result.motion = moved.motion;
    result.motionResidual = residual;
    result.overlap = moved.overlap;
    result.sdAngleDeg = moved.sdAngleDeg * std::sqrt(1.0 + residual);
  }
  result.field = still.field;
  result.loadShiftResidual = still.residual;
  if (result.computed)
    result.pMoved = motionScore(result.loadShiftResidual, result.motionResidual, options);
  return result;
}

MotionSdInflation motionSdInflation(const KeyFrame& key, const RegistrationOptions& options) {
  MotionSdInflation condition{.x = kUnboundedMotionSdInflation, .y = kUnboundedMotionSdInflation};
  if (key.empty()) return condition;
  const MatrixLayout& layout = key.layout();
  const Weighing weigh(options, kBlindPart * key.minCounts());
  const bool turns =
      key.rotationSensitivity() >= static_cast<float>(options.minRotationSensitivity);
  // Parameters: dx, dy, gain, angle, then the gradient of the load along x and along y.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  // Information that noise alone would contribute.
  double noise = 0.0;
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      if (!layout.enabled(y, x)) continue;
      const KeyFrame::Sample sample = key.at(static_cast<float>(x), static_cast<float>(y));
      // Next to a taxel below the threshold the slope is uncertain.
      float unknown = sample.unknown;
      for (const auto& [stepY, stepX] : kNeighbors)
        if (layout.exists(y + stepY, x + stepX))
          unknown = std::max(
              unknown,
              kSlopeGuess *
                  key.at(static_cast<float>(x + stepX), static_cast<float>(y + stepY)).unknown);
      const double u = x - key.centerX();
      const double v = y - key.centerY();
      const auto value = static_cast<double>(sample.value);
      const auto slopeX = static_cast<double>(sample.alongX);
      const auto slopeY = static_cast<double>(sample.alongY);
      Eigen::Matrix<double, 6, 1> slope;
      slope << slopeX, slopeY, value, turns ? slopeX * v - slopeY * u : 0.0, value * u, value * v;
      const auto weight = static_cast<double>(weigh(sample.value, 0.0F, unknown));
      information += weight * slope * slope.transpose();
      noise += weight * kNoiseOfSlope * options.noiseCounts * options.noiseCounts;
    }
  if (!turns) information(3, 3) += 1.0;
  const double scale = information.diagonal().maxCoeff();
  if (!(scale > 0.0)) return condition;
  information.diagonal().array() += 1e-12 * scale;
  const Eigen::Matrix4d known = information.topLeftCorner<4, 4>().inverse();
  const Eigen::Matrix<double, 6, 6> free = information.inverse();
  const auto ratio = [&](int axis) {
    const double axisInformation = 1.0 / free(axis, axis) - noise;
    if (!(axisInformation > 0.0)) return kUnboundedMotionSdInflation;
    const double value = 1.0 / std::sqrt(axisInformation * known(axis, axis));
    return std::isfinite(value) ? std::clamp(value, 1.0, kUnboundedMotionSdInflation)
                                : kUnboundedMotionSdInflation;
  };
  return {.x = ratio(0), .y = ratio(1)};
}

}  // namespace palpate
