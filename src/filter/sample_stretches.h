// Cuts a series of samples into stretches at its gaps, for filters of whole series.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpate {

struct SampleRange {
  std::size_t begin = 0;
  std::size_t end = 0;  // index after the last
};

// `gapSamples` are the last samples before each gap. Throws std::invalid_argument unless they
// ascend and each has a sample after it.
std::vector<SampleRange> sampleStretches(std::size_t numSamples,
                                         std::span<const std::size_t> gapSamples);

}  // namespace palpate
