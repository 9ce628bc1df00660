// Cross-validation: the pipeline is fitted anew for each split, so that the test samples are never
// used for fitting. Splits run in parallel; the results do not depend on the number of threads.
// Training, model search and `palpate evaluate` use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/recognition/classification_report.h>
#include <palpate/recognition/classifier_pipeline.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/sample_splits.h>

namespace palpate {

// Prediction for one test sample.
struct TestPrediction {
  std::size_t sample = 0;
  std::size_t split = 0;
  // Predicted class.
  int called = 0;
  // Whether the true class is among the three best.
  bool inTop3 = false;
  // Probability of the predicted class; 0 if the pipeline is not calibrated.
  double confidence = 0.0;
  // Novelty score; 0 if the pipeline is not calibrated.
  double novelty = 0.0;
};

struct ValidationReport {
  explicit ValidationReport(std::vector<std::string> classes) : confusion(std::move(classes)) {}
  // Mean accuracy over the splits.
  double accuracyMean = 0.0;
  // Standard deviation of the accuracy between splits (divisor n - 1); 0 with one split.
  double accuracySd = 0.0;
  // Fraction of all test samples with inTop3.
  double top3 = 0.0;
  // Over all splits.
  ConfusionMatrix confusion;
  // Accuracy of each split.
  std::vector<double> accuracies;
  // Predictions for all test samples, split after split.
  std::vector<TestPrediction> testPredictions;
};

// Fits and tests a pipeline on each split. Throws Error (requireLearnable, also for a split),
// std::invalid_argument (options, a split without samples), Cancelled.
ValidationReport crossValidate(const SampleSet& samples,
                               const PipelineOptions& options,
                               const std::vector<SampleSplit>& splits,
                               std::size_t threads = 0,
                               const Progress& progress = {});

// Fits and tests several pipelines on the same splits. The report of a pipeline that can't be
// fitted is empty: accuracyMean 0, no accuracies.
std::vector<ValidationReport> crossValidateAll(const SampleSet& samples,
                                               const std::vector<PipelineOptions>& options,
                                               const std::vector<SampleSplit>& splits,
                                               std::size_t threads = 0,
                                               const Progress& progress = {});

// Accuracy as a function of the number of training grasps per class (learning curve).
struct LearningPoint {
  std::size_t perClass = 0;
  // Mean number of training samples over the splits.
  double trainSamples = 0.0;
  double accuracyMean = 0.0;
  double accuracySd = 0.0;
};
// Computes the learning curve at each number in `perClass` (>= 2). Of the seed's stratified splits,
// that many training samples of each class are used, evenly spaced over the recording; smaller
// classes are used whole.
std::vector<LearningPoint> learningCurve(const SampleSet& samples,
                                         const PipelineOptions& options,
                                         const std::vector<std::size_t>& perClass,
                                         std::size_t splits = 10,
                                         std::uint64_t seed = 0,
                                         std::size_t threads = 0,
                                         const Progress& progress = {});

}  // namespace palpate
