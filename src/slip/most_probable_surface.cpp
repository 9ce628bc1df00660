#include "palpate/slip/most_probable_surface.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/option_check.h"

#include "slip/surface_readings.h"

namespace palpate {
namespace {

using registration::squareOf;
using spline::SplineWeights;

// The information fades in steps of this many frames.
constexpr int kFadeEvery = 16;
// After this many frames the coefficients change little, and fewer iterations follow them.
constexpr int kYoungSurfaceFrames = 25;
constexpr int kLaterIterations = 2;
// Standard deviation of the value of a taxel that has no active neighbour, as a fraction of the
// threshold; it is 0 or nearly so.
constexpr float kFarSilence = 0.2F;
constexpr float kMaxProbableMotionCounts = 4.0F;

}  // namespace

void MostProbableSurfaceOptions::validate() const {
  constexpr OptionCheck check{"MostProbableSurfaceOptions"};
  check(priorSd > 0.0, "priorSd", priorSd);
  check(interpolationSd >= 0.0, "interpolationSd", interpolationSd);
  check(belowThresholdSd > 0.0, "belowThresholdSd", belowThresholdSd);
  check(outsideSd > 0.0, "outsideSd", outsideSd);
  check(processNoiseRatio >= 0.0, "processNoiseRatio", processNoiseRatio);
  check(
      forgottenPerFrame >= 0.0 && forgottenPerFrame <= 0.5, "forgottenPerFrame", forgottenPerFrame);
  check(startIterations >= 1 && startIterations <= 100, "startIterations", startIterations);
  check(iterations >= 1 && iterations <= 100, "iterations", iterations);
  key.validate();
}

MostProbableSurface::MostProbableSurface(const MatrixLayout& layout,
                                         const MostProbableSurfaceOptions& options)
    : key_(layout, options.key),
      options_(options),
      grid_(layout, SurfaceInformation::kReach),
      information_(grid_.rows(), grid_.columns()) {
  options_.validate();
  ofTaxels_.resize(layout.numCells());
}

bool MostProbableSurface::set(const ConstMatrixMap& frame, double noiseCounts) {
  if (!key_.set(frame)) return false;
  const MatrixLayout& layout = key_.layout();
  least_ = key_.minCounts();
  const float* filled = key_.filled().data();
  const float noise2 = squareOf(static_cast<float>(noiseCounts));
  const float largest = *std::max_element(filled, filled + layout.numCells());
  const float outside = squareOf(static_cast<float>(options_.outsideSd) * largest);
  const float silence = squareOf(static_cast<float>(options_.belowThresholdSd) * least_);
  const float between = squareOf(static_cast<float>(options_.interpolationSd) * largest);
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      const int i = y * layout.columns + x;
      float variance = noise2 + between;
      if (key_.at(static_cast<float>(x), static_cast<float>(y)).unknown > 0.5F)
        variance += key_.enabled()[i] != 0 ? silence : outside;
      ofTaxels_[static_cast<std::size_t>(i)] = variance;
    }
  grid_.begin(key_, ofTaxels_, largest, {outside, silence});
  beginInformation(frame, noise2, largest);
  frames_ = 1;
  return true;
}

// The values of taxels below the threshold are those of KeyFrame: near the contact a fraction of
// the threshold, in the second place from it 0.
void MostProbableSurface::beginInformation(const ConstMatrixMap& frame,
                                           float noise2,
                                           float largest) {
  information_.begin(options_.priorSd * static_cast<double>(largest));
  const MatrixLayout& layout = key_.layout();
  const SplineWeights weights = spline::weights(0.0F);
  const auto nearSilence = squareOf(0.5F * static_cast<float>(options_.belowThresholdSd) * least_);
  const auto farSilence = squareOf(kFarSilence * least_);
  const auto isActiveAround = [&](int y, int x, int reach) {
    for (int ny = std::max(y - reach, 0); ny <= std::min(y + reach, layout.rows - 1); ++ny)
      for (int nx = std::max(x - reach, 0); nx <= std::min(x + reach, layout.columns - 1); ++nx)
        if (isTouched(frame(ny, nx))) return true;
    return false;
  };
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      const int taxel = y * layout.columns + x;
      if (key_.enabled()[taxel] == 0 || !isActiveAround(y, x, 2)) continue;
      const float variance = isTouched(frame(y, x))    ? noise2
                             : isActiveAround(y, x, 1) ? nearSilence
                                                       : farSilence;
      information_.add(grid_.coefficients(),
                       grid_.cornerOf(2 * y, 2 * x),
                       weights.data(),
                       weights.data(),
                       1.0F,
                       key_.filled()[static_cast<std::size_t>(taxel)],
                       variance);
    }
  information_.solve(grid_.coefficients(), options_.startIterations);
}

void MostProbableSurface::learn(const ConstMatrixMap& frame,
                                const RegistrationResult& found,
                                const RegistrationOptions& options) noexcept {
  if (empty() || found.motion.gain <= 0.0) return;
  const float forgotten = static_cast<float>(options_.processNoiseRatio) *
                          squareOf(static_cast<float>(options.noiseCounts));
  registration::forEachReading(grid_,
                               key_,
                               frame,
                               found,
                               options,
                               kMaxProbableMotionCounts,
                               least_,
                               [&](const registration::SurfaceReading& reading) {
                                 information_.add(grid_.coefficients(),
                                                  reading.corner,
                                                  reading.weightsX.data(),
                                                  reading.weightsY.data(),
                                                  reading.gain,
                                                  reading.measured,
                                                  reading.all - reading.variance);
                                 registration::updateVariances(
                                     grid_, reading, forgotten, [](int, const SplineWeights&) {});
                               });
  if (++frames_ % kFadeEvery == 0)
    information_.fade(grid_.coefficients(),
                      std::pow(1.0F - static_cast<float>(options_.forgottenPerFrame), kFadeEvery));
  information_.solve(grid_.coefficients(),
                     frames_ <= kYoungSurfaceFrames ? options_.iterations : kLaterIterations);
}

RegistrationResult registerFrame(const MostProbableSurface& surface,
                                 const ConstMatrixMap& frame,
                                 const RigidMotion& start,
                                 const RegistrationOptions& options) {
  return registration::registerToSurface(surface, frame, start, options);
}

}  // namespace palpate
