#include "filter/sample_stretches.h"

#include <stdexcept>
#include <string>

namespace palpate {

std::vector<SampleRange> sampleStretches(std::size_t numSamples,
                                         std::span<const std::size_t> gapSamples) {
  std::vector<SampleRange> stretches;
  std::size_t begin = 0;
  for (const std::size_t gap : gapSamples) {
    if (gap < begin || gap + 1 >= numSamples)
      throw std::invalid_argument("gap after sample " + std::to_string(gap) +
                                  ": gaps must ascend and lie between two of the " +
                                  std::to_string(numSamples) + " samples");
    stretches.push_back({begin, gap + 1});
    begin = gap + 1;
  }
  if (begin < numSamples) stretches.push_back({begin, numSamples});
  return stretches;
}

}  // namespace palpate
