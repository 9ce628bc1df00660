// Makes the filters that work over the frames of each taxel.
#pragma once

#include <memory>

#include "palpate/filter/frame_filter.h"

namespace palpate::detail {

// Makes running-mean, temporal-gaussian, temporal-min, savitzky-golay, and kalman and the
// Butterworth filters without smoothing.
std::unique_ptr<FrameFilter> temporalFilter(const FilterStep& step,
                                            std::shared_ptr<const SensorLayout> layout);
// Makes median3d and min-median.
std::unique_ptr<FrameFilter> spatioTemporalFilter(const FilterStep& step,
                                                  std::shared_ptr<const SensorLayout> layout);
// Makes the filters that need a whole stretch: rts, kalman, kelvin-voigt and the Butterworth
// filters over past and future frames, and kelvin-voigt with unknown parameters.
std::unique_ptr<FrameFilter> stretchFilter(const FilterStep& step,
                                           std::shared_ptr<const SensorLayout> layout);

}  // namespace palpate::detail
