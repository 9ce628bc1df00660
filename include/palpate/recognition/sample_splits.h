// Splits samples into training and test samples by the protocols S and B
// (docs/notes/recognition.md). Cross-validation and the calibration of probabilities use the
// splits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpate {

// One split: indices of training and test samples, ascending. With the protocols S and B every
// sample is in one of the two.
struct SampleSplit {
  std::vector<std::size_t> train;
  std::vector<std::size_t> test;
};

// Protocol S: stratified random splits. Each split has ceil(testFraction n) test samples,
// distributed over the classes in proportion (largest remainders, ties by lot). A class with one
// sample is used for training only. The same seed gives the same splits on every machine. Throws
// std::invalid_argument (no sample, testFraction not inside 0..1, no test or training samples
// left).
std::vector<SampleSplit> stratifiedSplits(const std::vector<int>& y,
                                          std::size_t splits,
                                          std::uint64_t seed,
                                          double testFraction = 0.2);

// Protocol B: divides every class into `blocks` contiguous blocks in the order of its samples
// (their order in time); split k tests the k-th block of every class. Grasps that are close in time
// stay together. Throws std::invalid_argument (no sample, blocks < 2).
std::vector<SampleSplit> blockSplits(const std::vector<int>& y, std::size_t blocks = 5);

// Returns one split per class with samples: this class is the test set, the others are the training
// set. It serves to test how unknown objects are detected.
std::vector<SampleSplit> leaveClassOutSplits(const std::vector<int>& y);

}  // namespace palpate
