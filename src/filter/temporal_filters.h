// Filters that look at the frames of one taxel.
#pragma once

#include <memory>

#include "palpate/filter/frame_filter.h"

namespace palpate::detail {

// running-mean, temporal-gaussian, temporal-min, savitzky-golay, and kalman without smoothing.
std::unique_ptr<FrameFilter> temporalFilter(const FilterStep& step,
                                            std::shared_ptr<const SensorLayout> layout);
// median3d and min-median.
std::unique_ptr<FrameFilter> spatioTemporalFilter(const FilterStep& step,
                                                  std::shared_ptr<const SensorLayout> layout);
// What needs a whole stretch: rts, kalman and kelvin-voigt with smoothing, kelvin-voigt with
// unknown parameters.
std::unique_ptr<FrameFilter> stretchFilter(const FilterStep& step,
                                           std::shared_ptr<const SensorLayout> layout);

}  // namespace palpate::detail
