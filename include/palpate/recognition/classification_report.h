// Measures of classification performance: confusion matrix, precision, recall and F per class,
// confidence intervals, coverage curves and calibration. Cross-validation and model evaluation use
// them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/json.h>

namespace palpate {

// Wilson's score interval of a proportion, by default at 95 % (Wilson 1927, J. American Statistical
// Association 22). It stays inside 0..1 and holds for small numbers; it is 0..1 when there is no
// trial.
struct BinomialInterval {
  double low = 0.0;
  double high = 1.0;
};
// Throws std::invalid_argument when successes > trials.
BinomialInterval wilsonInterval(std::size_t successes,
                                std::size_t trials,
                                double z = 1.959963984540054);

struct ClassMetrics {
  std::string name;
  // Fraction of the samples predicted as this class that belong to it; 0 when there is none.
  double precision = 0.0;
  // Fraction of the samples of this class that are predicted as it; 0 when there is none.
  double recall = 0.0;
  // Harmonic mean of precision and recall; 0 when both are 0.
  double f = 0.0;
  // Number of samples of this class.
  std::size_t support = 0;
};

// Number of samples per true class and predicted class (`called`). The last column counts samples
// that were predicted as unknown.
class ConfusionMatrix {
 public:
  explicit ConfusionMatrix(std::vector<std::string> classes);
  static constexpr int kUnknown = -1;
  // Throws std::out_of_range.
  void add(int truth, int called);
  // Adds the counts of a matrix with the same classes; throws std::invalid_argument otherwise.
  void add(const ConfusionMatrix& other);
  std::size_t at(int truth, int called) const;
  std::size_t total() const noexcept { return total_; }
  std::size_t right() const noexcept { return right_; }
  // Fraction of correct predictions; 0 when nothing was counted.
  double accuracy() const noexcept;
  const std::vector<std::string>& classes() const noexcept { return classes_; }
  std::vector<ClassMetrics> classMetrics() const;
  // JSON of the class metrics (classes with samples or predictions), and of the confusion matrix
  // {labels, counts[truth][called]}; its last column is "unknown" if anything was predicted so.
  Json classesJson() const;
  Json confusionJson() const;

 private:
  std::size_t index(int truth, int called) const;
  std::vector<std::string> classes_;
  std::vector<std::size_t> counts_;  // classes x (classes + 1)
  std::size_t total_ = 0, right_ = 0;
};

// Confidence and correctness of one prediction, for coverage curves and calibration.
struct ScoredPrediction {
  double confidence = 0.0;  // 0..1
  bool right = false;
};
// Coverage: fraction of all predictions with at least this confidence. Accuracy: fraction of these
// that are correct.
struct CoveragePoint {
  double confidence = 0.0;
  double coverage = 0.0;
  double accuracy = 0.0;
  std::size_t answers = 0;
};
// Returns one point per distinct confidence, in descending order; the last point covers all
// predictions.
std::vector<CoveragePoint> coverageCurve(std::vector<ScoredPrediction> answers);
// Returns the lowest confidence for which Wilson's lower bound at 90 % (one-sided 95 %) of the
// accuracy reaches `target`. A value above 1 means that no confidence reaches it.
double confidenceThreshold(const std::vector<ScoredPrediction>& answers, double target = 0.95);
// Expected calibration error over ten equal bins of confidence: |mean confidence - accuracy|,
// weighted by the number of predictions in the bin.
double expectedCalibrationError(std::span<const ScoredPrediction> answers);

// Area under the receiver operating characteristic: probability that a value of `positive` exceeds
// one of `negative` (ties count half). NaN when either is empty.
double auroc(std::span<const double> positive, std::span<const double> negative);

}  // namespace palpate
