#include "palpate/recognition/sample_set.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/recognition/study_features.h"

namespace palpate {
namespace {

bool varies(const Eigen::MatrixXd& x, Eigen::Index column) {
  return x.rows() > 0 && x.col(column).maxCoeff() > x.col(column).minCoeff();
}

std::string listOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMaximum = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMaximum); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kMaximum) text += " and " + std::to_string(names.size() - kMaximum) + " more";
  return text;
}

}  // namespace

std::vector<std::size_t> SampleSet::counts() const {
  std::vector<std::size_t> counts(classes.size(), 0);
  for (const int label : y) ++counts.at(static_cast<std::size_t>(label));
  return counts;
}

SampleSet SampleSet::rows(std::span<const std::size_t> indices) const {
  SampleSet part{{}, {}, classes, features};
  part.x.resize(static_cast<Eigen::Index>(indices.size()), x.cols());
  part.y.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    part.y.push_back(y.at(indices[i]));
    part.x.row(static_cast<Eigen::Index>(i)) = x.row(static_cast<Eigen::Index>(indices[i]));
  }
  return part;
}

SampleSet SampleSet::columns(std::span<const std::size_t> indices) const {
  SampleSet part{{}, y, classes, {}};
  part.x.resize(x.rows(), static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i) {
    part.features.push_back(features.at(indices[i]));
    part.x.col(static_cast<Eigen::Index>(i)) = x.col(static_cast<Eigen::Index>(indices[i]));
  }
  return part;
}

void SampleSet::validate() const {
  const auto fail = [](const std::string& what) {
    throw std::invalid_argument("SampleSet: " + what);
  };
  if (static_cast<std::size_t>(x.rows()) != y.size())
    fail(std::to_string(x.rows()) + " rows of features for " + std::to_string(y.size()) +
         " labels");
  if (static_cast<std::size_t>(x.cols()) != features.size())
    fail(std::to_string(x.cols()) + " columns for " + std::to_string(features.size()) +
         " names of features");
  for (const int label : y)
    if (label < 0 || static_cast<std::size_t>(label) >= classes.size())
      fail("label " + std::to_string(label) + " of " + std::to_string(classes.size()) + " classes");
  if (std::set<std::string>(classes.begin(), classes.end()).size() != classes.size())
    fail("two classes have the same name");
}

SampleSet samplesOf(const FeatureTable& table) { return samplesOf(table, table.classes()); }

SampleSet samplesOf(const FeatureTable& table, const std::vector<std::string>& classes) {
  SampleSet samples{valuesOf(table), {}, classes, table.names};
  for (const FeatureRow& row : table.rows) {
    const auto found = std::find(classes.begin(), classes.end(), row.className);
    if (row.className.empty())
      throw FileError(row.file, "its class isn't known: name a folder with a folder per class");
    if (found == classes.end())
      throw FileError(row.file,
                      "its class '" + shortened(row.className) + "' isn't one of the model's");
    samples.y.push_back(static_cast<int>(found - classes.begin()));
  }
  return samples;
}

SampleSet studyPart(const SampleSet& study, StudyPart part) {
  constexpr std::size_t kFirst = 4;
  if (!isStudySet(study.features))
    throw std::invalid_argument("studyPart: these are not the study's features");
  std::vector<std::size_t> columns(study.numFeatures());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  if (part == StudyPart::kDiameter) columns.resize(1);
  if (part == StudyPart::kFirst4) columns.resize(kFirst);
  if (part == StudyPart::kMoments) columns.erase(columns.begin(), columns.begin() + kFirst);
  return study.columns(columns);
}

void requireLearnable(const SampleSet& samples) {
  samples.validate();
  if (samples.numSamples() == 0) throw Error("there is no grasp to train with");
  for (Eigen::Index row = 0; row < samples.x.rows(); ++row)
    for (Eigen::Index column = 0; column < samples.x.cols(); ++column)
      if (!std::isfinite(samples.x(row, column)))
        throw Error(
            "grasp " + std::to_string(row) + " (" +
            samples.classes[static_cast<std::size_t>(samples.y[static_cast<std::size_t>(row)])] +
            ") has no number for the feature " +
            samples.features[static_cast<std::size_t>(column)]);
  std::size_t withSamples = 0, most = 0;
  std::string only;
  const std::vector<std::size_t> counts = samples.counts();
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (counts[c] == 0) continue;
    ++withSamples;
    only = samples.classes[c];
    most = std::max(most, counts[c]);
  }
  if (withSamples < 2)
    throw Error("there is only one class (" + only +
                "), at least two are needed: a folder per class");
  if (most < 2)
    throw Error("no class has more than one grasp: record at least two grasps of an object");
  for (Eigen::Index column = 0; column < samples.x.cols(); ++column)
    if (varies(samples.x, column)) return;
  throw Error("no feature varies: every grasp gives the same numbers");
}

std::vector<std::string> learningNotes(const SampleSet& samples) {
  std::vector<std::string> constant, single, notes;
  for (Eigen::Index column = 0; column < samples.x.cols(); ++column)
    if (!varies(samples.x, column))
      constant.push_back(samples.features[static_cast<std::size_t>(column)]);
  const std::vector<std::size_t> counts = samples.counts();
  for (std::size_t c = 0; c < counts.size(); ++c)
    if (counts[c] == 1) single.push_back(samples.classes[c]);
  if (!constant.empty())
    notes.push_back("features that never vary have no effect: " + listOf(constant));
  if (!single.empty())
    notes.push_back("only one grasp, which is too few to estimate the scatter: " + listOf(single));
  return notes;
}

}  // namespace palpate
