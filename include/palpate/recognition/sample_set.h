// Samples to learn from: one row of features per grasp, with its class. Rows of one class stand in the order in which
// they were recorded (protocol B goes by it).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace palpate {

struct SampleSet {
  Eigen::MatrixXd x;                  // samples x features
  std::vector<int> y;                 // class of each sample, index into `classes`
  std::vector<std::string> classes;   // distinct names; a class may have no sample
  std::vector<std::string> features;  // names of the columns

  std::size_t numSamples() const noexcept { return y.size(); }
  std::size_t numFeatures() const noexcept { return features.size(); }
  std::size_t numClasses() const noexcept { return classes.size(); }
  // Samples of each class.
  std::vector<std::size_t> counts() const;

  // The same classes and features with some samples; some features. Throw std::out_of_range.
  SampleSet rows(std::span<const std::size_t> indices) const;
  SampleSet columns(std::span<const std::size_t> indices) const;

  // Throws std::invalid_argument when sizes or class numbers don't agree.
  void validate() const;
};

// Throws Error (one line: what, which sample or class) when nothing can be learnt from it: no sample, fewer than two classes
// with samples, no class with two samples, a value that is no number, no feature that varies.
void requireLearnable(const SampleSet& samples);
// What can be learnt from, but should be said, a line each: features that never vary, classes with one sample.
std::vector<std::string> learningNotes(const SampleSet& samples);

}  // namespace palpate
