// Model search: chooses the settings that the user left open (classifier, components, C, mixing of
// covariance matrices) by cross-validation inside the training samples. Every candidate of a grid
// is tested on the same contiguous blocks (protocol B: grasps that are close in time stay
// together). `palpate train` and the training in the window use it.
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
  // If given, only this classifier is tested.
  std::optional<ClassifierKind> classifier = std::nullopt;
  // If given, only this number of components is tested, >= 1.
  std::optional<std::size_t> components = std::nullopt;
  // Values of C for svm.
  std::vector<double> costs = {1.0, 10.0, 100.0};
  std::vector<std::size_t> componentGrid = {8, 11, 14, 20};
  // Values of the pooled fraction for qda.
  std::vector<double> pooledShares = {0.3, 0.5, 0.7};
  // Number of blocks, >= 2.
  std::size_t blocks = 5;
  std::size_t threads = 0;
};

struct ModelCandidate {
  PipelineOptions options;
  double accuracyMean = 0.0;
  double accuracySd = 0.0;
  bool fitted = false;
};

struct ModelSearchReport {
  // In the order of the grid.
  std::vector<ModelCandidate> candidates;
  std::size_t chosen = 0;
};

// Returns the candidates of the grid: each classifier with and without discriminant analysis (gauss
// without); the number of components is limited by the number of features and by classes - 1.
std::vector<PipelineOptions> modelGrid(const SampleSet& samples, const ModelSearchOptions& options);

// Tests all candidates and chooses one: of those that are at most half a standard error below the
// most accurate one, the first in the grid, which goes from simple to complex. Throws Error
// (requireLearnable; no candidate can be fitted), std::invalid_argument (options), Cancelled.
ModelSearchReport searchModel(const SampleSet& samples,
                              const ModelSearchOptions& options = {},
                              const Progress& progress = {});

Json jsonOf(const PipelineOptions& options);
Json jsonOf(const ModelSearchReport& report);

// One step of recursive feature elimination (Guyon et al. 2002, Machine Learning 46): the model is
// fitted, and the feature with the smallest weight is removed.
struct EliminationStep {
  // Number of features that were used in this step.
  std::size_t features = 0;
  // Column of the feature that was removed after it, determined from all samples.
  std::size_t dropped = 0;
  // Accuracy with the features of this step; each split eliminates features by its own training
  // samples.
  double accuracyMean = 0.0;
  double accuracySd = 0.0;
};
// Eliminates from all features down to one. A discriminant analysis keeps at most as many
// components as there are features left.
std::vector<EliminationStep> eliminateFeatures(const SampleSet& samples,
                                               const PipelineOptions& options,
                                               const std::vector<SampleSplit>& splits,
                                               std::size_t threads = 0,
                                               const Progress& progress = {});

}  // namespace palpate
