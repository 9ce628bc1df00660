// A series of samples cut at its gaps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

struct SampleRange {
  std::size_t begin = 0;
  std::size_t end = 0;  // one behind the last
};

// `gapSamples`: last sample before each gap. Throws std::invalid_argument unless they ascend and
// each has a sample behind it.
std::vector<SampleRange> sampleStretches(std::size_t numSamples,
                                         std::span<const std::size_t> gapSamples);

}  // namespace palpate
