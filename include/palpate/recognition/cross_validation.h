// Cross-validation: the pipeline is fitted anew for each split, so that the test samples are never
// used for fitting. Splits run in parallel; the results do not depend on the number of threads.
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

// One sample that examined.
struct TestPrediction {
  std::size_t sample = 0;
  std::size_t split = 0;
  int called = 0;           // class
  bool inTop3 = false;      // the truth is among the three best
  double confidence = 0.0;  // probability of `called`; 0 where the pipeline doesn't calibrate
  double novelty = 0.0;     // 0 where it doesn't
};

struct ValidationReport {
  explicit ValidationReport(std::vector<std::string> classes) : confusion(std::move(classes)) {}
  double accuracyMean = 0.0;                    // over splits
  double accuracySd = 0.0;                      // of splits (n - 1); 0 with one
  double top3 = 0.0;                            // share of all samples that examined
  ConfusionMatrix confusion;                    // over all splits
  std::vector<double> accuracies;               // per split
  std::vector<TestPrediction> testPredictions;  // split after split
};

// Throws Error (requireLearnable, also of a split), std::invalid_argument (options, a split without
// samples), Cancelled.
ValidationReport crossValidate(const SampleSet& samples,
                               const PipelineOptions& options,
                               const std::vector<SampleSplit>& splits,
                               std::size_t threads = 0,
                               const Progress& progress = {});

// Several pipelines on the same splits. One that can't be fitted has no report: accuracyMean 0, no
// accuracies.
std::vector<ValidationReport> crossValidateAll(const SampleSet& samples,
                                               const std::vector<PipelineOptions>& options,
                                               const std::vector<SampleSplit>& splits,
                                               std::size_t threads = 0,
                                               const Progress& progress = {});

// Accuracy as a function of the number of training grasps per class (learning curve).
struct LearningPoint {
  std::size_t perClass = 0;
  double trainSamples = 0.0;  // mean over splits
  double accuracyMean = 0.0;
  double accuracySd = 0.0;
};
// For every number of `perClass` (>= 2) so many of each class's training samples, evenly over the
// recording, of the seed's stratified splits; classes with fewer teach with all.
std::vector<LearningPoint> learningCurve(const SampleSet& samples,
                                         const PipelineOptions& options,
                                         const std::vector<std::size_t>& perClass,
                                         std::size_t splits = 10,
                                         std::uint64_t seed = 0,
                                         std::size_t threads = 0,
                                         const Progress& progress = {});

}  // namespace palpate
