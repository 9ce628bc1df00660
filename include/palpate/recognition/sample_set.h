// Training samples: one row of features per grasp, with its class. The rows of one class are in the
// order in which they were recorded (protocol B depends on it).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <palpate/recognition/feature_table.h>

namespace palpate {

struct SampleSet {
  // Samples x features.
  Eigen::MatrixXd x;
  // Class of each sample, an index into `classes`.
  std::vector<int> y;
  // Distinct names; a class may have no sample.
  std::vector<std::string> classes;
  // Names of the columns.
  std::vector<std::string> features;

  std::size_t numSamples() const noexcept { return y.size(); }
  std::size_t numFeatures() const noexcept { return features.size(); }
  std::size_t numClasses() const noexcept { return classes.size(); }
  // Number of samples per class.
  std::vector<std::size_t> counts() const;

  // Return a set with some of the samples, or with some of the features. Throw std::out_of_range.
  SampleSet rows(std::span<const std::size_t> indices) const;
  SampleSet columns(std::span<const std::size_t> indices) const;

  // Throws std::invalid_argument when sizes or class numbers don't agree.
  void validate() const;
};

// Makes a sample set from a table; the classes are sorted by name, or are `classes` if given.
// Throws Error when a row has no class or is of a class that is not in `classes`.
SampleSet samplesOf(const FeatureTable& table);
SampleSet samplesOf(const FeatureTable& table, const std::vector<std::string>& classes);

// The subsets of the study's 54 features that its table 6.1 compares.
enum class StudyPart {
  // The first feature.
  kDiameter,
  // Diameter, compressibility and both standard deviations.
  kFirst4,
  // The other 50 features.
  kMoments,
  kAll
};
// Returns a subset of the columns of a sample set with the study's features. Throws
// std::invalid_argument when it has other features.
SampleSet studyPart(const SampleSet& study, StudyPart part);

// Throws Error (one line, with the sample or class) when no classifier can be fitted: no sample,
// fewer than two classes with samples, no class with two samples, a value that is not a number, no
// feature that varies.
void requireLearnable(const SampleSet& samples);
// Returns warnings about samples that can be used, one line each: features that are constant,
// classes with one sample.
std::vector<std::string> learningNotes(const SampleSet& samples);

}  // namespace palpate
