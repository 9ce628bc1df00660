#include "palpate/slip/rigid_registration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/core/option_check.h"

#include "slip/registration_passes.h"

namespace palpate {
namespace {

// A key frame as a surface whose variance covers the values below the threshold.
struct KeySurface {
  struct Sample {
    float value, alongX, alongY, variance;
  };
  const KeyFrame& key;
  // Standard deviation of an unknown value [counts].
  float blind;

  Sample at(float x, float y) const noexcept {
    const KeyFrame::Sample sample = key.at(x, y);
    const float unsure = blind * sample.unknown;
    return {sample.value, sample.alongX, sample.alongY, unsure * unsure};
  }
};

}  // namespace

void RegistrationOptions::validate() const {
  constexpr OptionCheck check{"RegistrationOptions"};
  check(maxIterations >= 1 && maxIterations <= 50, "maxIterations", maxIterations);
  check(convergedTaxels > 0.0, "convergedTaxels", convergedTaxels);
  check(noiseCounts > 0.0, "noiseCounts", noiseCounts);
  check(relativeError >= 0.0, "relativeError", relativeError);
  check(saturationCounts > 0.0, "saturationCounts", saturationCounts);
  check(anglePriorDeg > 0.0, "anglePriorDeg", anglePriorDeg);
  check(minRotationSensitivity >= 0.0 && minRotationSensitivity <= 0.5,
        "minRotationSensitivity",
        minRotationSensitivity);
  check(maxDirectionSdTaxels > 0.0, "maxDirectionSdTaxels", maxDirectionSdTaxels);
  check(gainPrior > 0.0, "gainPrior", gainPrior);
  check(minOverlap >= 0.0 && minOverlap <= 1.0, "minOverlap", minOverlap);
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
    throw std::invalid_argument(
        "registerFrame: the frame doesn't have the size of the key's matrix");
  if (key.empty()) return result;

  float least = 0.0F;
  registration::Frame view{
      frame.data(),
      key.enabled(),
      layout.columns,
      registration::windowOf(frame.data(), layout.rows, layout.columns, least)};
  if (least == 0.0F) return result;
  const bool smooth = key.options().blurTaxels > 0.0;
  if (smooth) {
    smoothMatrix(layout, key.options().blurTaxels, frame.data(), scratch);
    view.values = scratch;
  }
  const registration::Contact contact{
      static_cast<float>(key.centerX()),
      static_cast<float>(key.centerY()),
      static_cast<float>(key.sum()),
      std::sqrt(static_cast<float>(key.active())),
      key.rotationSensitivity() >= static_cast<float>(options.minRotationSensitivity),
      smooth ? 0.0F : std::min(least, key.minCounts()),
      0.0F,
      static_cast<float>(layout.columns - 1),
      0.0F,
      static_cast<float>(layout.rows - 1)};
  const KeySurface surface{key, 0.3F * key.minCounts()};
  return registration::registerTo(surface, contact, view, start, options);
}

RigidRegistration::RigidRegistration(const MatrixLayout& layout,
                                     const RegistrationOptions& options,
                                     const KeyFrameOptions& keyOptions)
    : key_(layout, keyOptions), options_(options), scratch_(layout.numCells()) {
  options_.validate();
}

}  // namespace palpate
