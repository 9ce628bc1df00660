// Training samples for tests: the study's features of the shared grasps
// (golden/grasp_features.csv), and small synthetic sets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/recognition/sample_set.h"

namespace palpate::testing {

inline std::vector<std::string> csvCells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

inline SampleSet goldenSamples(const std::filesystem::path& goldenFolder) {
  constexpr std::size_t kFirstFeature = 8;
  std::ifstream in(goldenFolder / "grasp_features.csv");
  std::string line;
  std::getline(in, line);
  SampleSet samples;
  const std::vector<std::string> header = csvCells(line);
  samples.features.assign(header.begin() + kFirstFeature, header.end());
  std::vector<std::vector<double>> rows;
  std::map<std::string, int> classes;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = csvCells(line);
    const auto [at, isNew] = classes.emplace(cells[0], static_cast<int>(classes.size()));
    if (isNew) samples.classes.push_back(cells[0]);
    samples.y.push_back(at->second);
    rows.emplace_back();
    for (std::size_t j = kFirstFeature; j < cells.size(); ++j)
      rows.back().push_back(parseDouble(cells[j]).value());
  }
  samples.x.resize(static_cast<Eigen::Index>(rows.size()),
                   static_cast<Eigen::Index>(samples.features.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      samples.x(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
  return samples;
}

// Returns a subset of the columns of the study's table: "diameter", "first4", "moments" or "study".
inline SampleSet studySubset(const SampleSet& study, const std::string& name) {
  std::vector<std::size_t> columns(study.numFeatures());
  std::iota(columns.begin(), columns.end(), 0);
  if (name == "diameter") columns = {0};
  if (name == "first4") columns = {0, 1, 2, 3};
  if (name == "moments") columns.erase(columns.begin(), columns.begin() + 4);
  return study.columns(columns);
}

// Makes `perClass` samples of each of `classes` isotropic Gaussian clouds of sd 1, whose centres
// have distances of at least `apart`, in `features` dimensions.
inline SampleSet clouds(int classes, int perClass, int features, double apart, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  SampleSet samples;
  samples.x.resize(classes * perClass, features);
  for (int c = 0; c < classes; ++c) samples.classes.push_back("class " + std::to_string(c));
  for (int j = 0; j < features; ++j) samples.features.push_back("feature " + std::to_string(j));
  for (int i = 0; i < classes * perClass; ++i) {
    const int c = i / perClass;
    samples.y.push_back(c);
    for (int j = 0; j < features; ++j)
      samples.x(i, j) = normal(generator) + (j == c % features ? apart * (1 + c / features) : 0.0);
  }
  return samples;
}

}  // namespace palpate::testing
