// When two neighbours in time are a gap apart: further than max(kShortestGapS, kGapIntervals of their usual interval).
#pragma once

#include <cstdint>

namespace palpate {

inline constexpr std::int64_t kShortestGapUs = 1'000'000;  // [us]
inline constexpr double kShortestGapS = 1.0;               // [s]
inline constexpr int kGapIntervals = 5;                    // median intervals

}  // namespace palpate
