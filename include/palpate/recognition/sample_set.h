// Samples to learn from: one row of features per grasp, with its class. Rows of one class stand in
// the order in which they were recorded (protocol B goes by it).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <palpate/recognition/feature_table.h>

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

// The rows of a table that have a class; classes sorted by name. With `classes` given: those, and a
// row of none of them is refused. Throws Error (a row without class, or of an unknown one).
SampleSet samplesOf(const FeatureTable& table);
SampleSet samplesOf(const FeatureTable& table, const std::vector<std::string>& classes);

// The parts of the study's 54 features that its table 6.1 compares.
enum class StudyPart {
  kDiameter,  // the first
  kFirst4,    // diameter, compressibility, both standard deviations
  kMoments,   // the other 50
  kAll
};
// Columns of a sample set of the study's features. Throws std::invalid_argument when it has other
// features.
SampleSet studyPart(const SampleSet& study, StudyPart part);

// Throws Error (one line: what, which sample or class) when nothing can be learnt from it: no
// sample, fewer than two classes with samples, no class with two samples, a value that is no
// number, no feature that varies.
void requireLearnable(const SampleSet& samples);
// What can be learnt from, but should be said, a line each: features that never vary, classes with
// one sample.
std::vector<std::string> learningNotes(const SampleSet& samples);

}  // namespace palpate
