// Chooses what a person left open (classifier, components, C, mixing of covariances) by
// cross-validation inside the training samples: a grid, every candidate on the same contiguous
// blocks (protocol B: what lies close in time stays together).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/progress.h>
#include <palpate/recognition/classifier_pipeline.h>
#include <palpate/recognition/cross_validation.h>
#include <palpate/recognition/sample_set.h>

namespace palpate {

struct ModelSearchOptions {
  std::optional<ClassifierKind> classifier = std::nullopt;  // given: not searched
  std::optional<std::size_t> components = std::nullopt;     // given: not searched; >= 1
  std::vector<double> costs = {1.0, 10.0, 100.0};           // C of svm
  std::vector<std::size_t> componentGrid = {8, 11, 14, 20};
  std::vector<double> pooledShares = {0.3, 0.5, 0.7};  // of qda
  std::size_t blocks = 5;                              // >= 2
  std::size_t threads = 0;
};

struct ModelCandidate {
  PipelineOptions options;
  double accuracyMean = 0.0;
  double accuracySd = 0.0;
  bool fitted = false;
};

struct ModelSearchReport {
  std::vector<ModelCandidate> candidates;  // in the order of the grid
  std::size_t chosen = 0;
};

// The candidates of a grid: each classifier with and without discriminant analysis (gauss without),
// components no more than features and classes - 1 allow.
std::vector<PipelineOptions> modelGrid(const SampleSet& samples, const ModelSearchOptions& options);

// The most accurate one; of those no worse than it by half a standard error the first of the grid,
// which goes from simple to elaborate. Throws Error (requireLearnable; none can be fitted),
// std::invalid_argument (options), Cancelled.
ModelSearchReport searchModel(const SampleSet& samples,
                              const ModelSearchOptions& options = {},
                              const Progress& progress = {});

Json jsonOf(const PipelineOptions& options);
Json jsonOf(const ModelSearchReport& report);

// Recursive feature elimination (Guyon et al. 2002, Machine Learning 46): fit, drop the feature of
// least weight, again.
struct EliminationStep {
  std::size_t features = 0;  // how many were left
  std::size_t dropped = 0;   // then this one was dropped (column; by all samples)
  // with those that were left; each split eliminates by its own training samples
  double accuracyMean = 0.0;
  double accuracySd = 0.0;
};
// From all features down to one. A discriminant analysis keeps at most as many components as
// features are left.
std::vector<EliminationStep> eliminateFeatures(const SampleSet& samples,
                                               const PipelineOptions& options,
                                               const std::vector<SampleSplit>& splits,
                                               std::size_t threads = 0,
                                               const Progress& progress = {});

}  // namespace palpate
