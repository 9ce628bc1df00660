#include "palpate/slip/learned_surface.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/option_check.h"

#include "slip/surface_readings.h"

namespace palpate {
namespace {

using registration::squareOf;
using spline::SplineWeights;

constexpr float kMotionCounts = 8.0F;

}  // namespace

void LearnedSurfaceOptions::validate() const {
  constexpr OptionCheck check{"LearnedSurfaceOptions"};
  check(curvatureSd >= 0.0, "curvatureSd", curvatureSd);
  check(belowThresholdSd >= 0.0, "belowThresholdSd", belowThresholdSd);
  check(outsideSd > 0.0, "outsideSd", outsideSd);
  check(processNoiseRatio >= 0.0, "processNoiseRatio", processNoiseRatio);
  key.validate();
}

LearnedSurface::LearnedSurface(const MatrixLayout& layout, const LearnedSurfaceOptions& options)
    : key_(layout, options.key), options_(options), grid_(layout) {
  options_.validate();
  ofTaxels_.resize(layout.numCells());
}

bool LearnedSurface::set(const ConstMatrixMap& frame, double noiseCounts) {
  if (!key_.set(frame)) return false;
  const MatrixLayout& layout = key_.layout();
  const int rows = layout.rows;
  const int columns = layout.columns;
  least_ = key_.minCounts();
  const float* filled = key_.filled().data();
  const float noise2 = squareOf(static_cast<float>(noiseCounts));
  const float largest = *std::max_element(filled, filled + layout.numCells());
  const float outside = squareOf(static_cast<float>(options_.outsideSd) * largest);
  const float silence = squareOf(static_cast<float>(options_.belowThresholdSd) * least_);
  const auto bendSd = static_cast<float>(options_.curvatureSd);

  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int i = y * columns + x;
      float bend = 0.0F;
      if (x > 0 && x + 1 < columns)
        bend += std::abs(filled[i - 1] - 2.0F * filled[i] + filled[i + 1]);
      if (y > 0 && y + 1 < rows)
        bend += std::abs(filled[i - columns] - 2.0F * filled[i] + filled[i + columns]);
      float variance = noise2 + squareOf(bendSd * bend);
      if (key_.at(static_cast<float>(x), static_cast<float>(y)).unknown > 0.5F)
        variance += key_.enabled()[i] != 0 ? silence : outside;
      ofTaxels_[static_cast<std::size_t>(i)] = variance;
    }
  grid_.begin(key_, ofTaxels_, largest, {outside, silence});
  return true;
}

void LearnedSurface::learn(const ConstMatrixMap& frame,
                           const RegistrationResult& found,
                           const RegistrationOptions& options) noexcept {
  if (empty() || found.motion.gain <= 0.0) return;
  const float forgotten = static_cast<float>(options_.processNoiseRatio) *
                          squareOf(static_cast<float>(options.noiseCounts));
  registration::forEachReading(
      grid_,
      key_,
      frame,
      found,
      options,
      kMotionCounts,
      least_,
      [&](const registration::SurfaceReading& reading) {
        const float residual = reading.measured - reading.model;
        registration::updateVariances(
            grid_, reading, forgotten, [&](int j, const SplineWeights& toward) {
              Eigen::Map<SplineWeights> row(grid_.coefficients() + reading.corner +
                                            j * grid_.columns());
              row += residual * toward;
            });
      });
}

RegistrationResult registerFrame(const LearnedSurface& surface,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options) {
  return registration::registerToSurface(surface, frame, start, options);
}

}  // namespace palpate
