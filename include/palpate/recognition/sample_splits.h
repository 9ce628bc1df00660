// Protocols S and B: how samples are split into those that teach and those that examine
// (docs/recognition.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpate {

// Indices of samples, ascending; every sample is in one of the two (S, B).
struct SampleSplit {
  std::vector<std::size_t> train;
  std::vector<std::size_t> test;
};

// S: stratified shuffles. Of every split ceil(testFraction n) samples examine, shared among the
// classes in proportion (largest remainders, equal ones by lot); a class with one sample only
// teaches. The same for the same seed on every machine. Throws std::invalid_argument (no sample,
// share not inside 0..1, nothing left on one side).
std::vector<SampleSplit> stratifiedSplits(const std::vector<int>& y,
                                          std::size_t splits,
                                          std::uint64_t seed,
                                          double testFraction = 0.2);

// B: split k of `blocks` examines the k-th of as many contiguous blocks of every class, in the
// order of the samples (their order in time): what lies close together in time stays together.
// Throws std::invalid_argument (no sample, blocks < 2).
std::vector<SampleSplit> blockSplits(const std::vector<int>& y, std::size_t blocks = 5);

// One split a class that has samples: it examines, the others teach (what is unknown must be found
// so).
std::vector<SampleSplit> leaveClassOutSplits(const std::vector<int>& y);

}  // namespace palpate
