#include "palpate/filter/frame_filter.h"

#include <stdexcept>

#include "filter/spatial_filter.h"
#include "filter/temporal_filters.h"

namespace palpate {
namespace {

using detail::MatrixKernel;

std::unique_ptr<MatrixKernel> kernelOf(const FilterStep& step,
                                       const SensorLayout& sensor,
                                       std::size_t matrix) {
  const MatrixLayout& layout = sensor.matrix(matrix);
  if (step.name == "box") return detail::boxKernel(layout, step);
  if (step.name == "gaussian") return detail::gaussianKernel(layout, step);
  if (step.name == "median") return detail::medianKernel(layout, step.integer("size"));
  if (step.name == "bilateral") return detail::bilateralKernel(layout, step);
  if (step.name == "nlm") return detail::nonLocalMeansKernel(layout, step);
  if (step.name == "opening") return detail::openingKernel(layout, step);
  if (step.name == "threshold") return detail::thresholdKernel(layout, step);
  if (step.name == "baseline") return detail::baselineKernel(layout, sensor.offset(matrix), step);
  throw std::logic_error("makeFrameFilter: " + step.name + " has no kernel");
}

}  // namespace

std::unique_ptr<FrameFilter> makeFrameFilter(const FilterStep& step,
                                             std::shared_ptr<const SensorLayout> layout) {
  step.validate();
  for (const std::size_t matrix : step.matrices)
    if (matrix >= layout->numMatrices())
      throw std::invalid_argument(step.name + ": there is no matrix " + std::to_string(matrix) +
                                  ", only 0.." + std::to_string(layout->numMatrices() - 1));
  if (step.rest && step.rest->rest.size() != layout->numCells())
    throw std::invalid_argument("baseline: the rest has " + std::to_string(step.rest->rest.size()) +
                                " values, the hand " + std::to_string(layout->numCells()) +
                                " places: take the rest with this hand");
  switch (step.kind().domain) {
    case FilterDomain::kSpatial:
      return std::make_unique<detail::SpatialFilter>(
          step, layout, [&](std::size_t matrix) { return kernelOf(step, *layout, matrix); });
    case FilterDomain::kSpatioTemporal:
      return detail::spatioTemporalFilter(step, std::move(layout));
    case FilterDomain::kTemporal:
      break;
  }
  const bool smoother = step.name == "rts" || step.name == "kalman" ||
                        step.name == "kelvin-voigt" || butterworthOf(step).has_value();
  if (smoother && !step.causal()) return detail::stretchFilter(step, std::move(layout));
  return detail::temporalFilter(step, std::move(layout));
}

}  // namespace palpate
