// How well a classifier did: confusion, precision, recall and F per class, intervals, confidence
// against truth.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/json.h>

namespace palpate {

// Wilson's score interval of a share, by default at 95 % (Wilson 1927, J. American Statistical
// Association 22): it stays inside 0..1 and holds for small numbers. 0..1 where there is no trial.
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
  double precision = 0.0;  // of those called so: right; 0 where none was
  double recall = 0.0;     // of those that are so: found; 0 where there is none
  double f = 0.0;          // harmonic mean of both; 0 where both are 0
  std::size_t support = 0;
};

// Counts of (truth, called). A sample may be called nothing of the classes ("unknown"): the last
// column.
class ConfusionMatrix {
 public:
  explicit ConfusionMatrix(std::vector<std::string> classes);
  static constexpr int kUnknown = -1;
  // Throws std::out_of_range.
  void add(int truth, int called);
  void add(const ConfusionMatrix& other);  // of the same classes; throws std::invalid_argument
  std::size_t at(int truth, int called) const;
  std::size_t total() const noexcept { return total_; }
  std::size_t right() const noexcept { return right_; }
  double accuracy() const noexcept;  // 0 where nothing was counted
  const std::vector<std::string>& classes() const noexcept { return classes_; }
  std::vector<ClassMetrics> classMetrics() const;
  // `classes` of figures (those with support or called), and `confusion` {labels,
  // counts[truth][called]} with the column "unknown" last where anything was called so.
  Json classesJson() const;
  Json confusionJson() const;

 private:
  std::size_t index(int truth, int called) const;
  std::vector<std::string> classes_;
  std::vector<std::size_t> counts_;  // classes x (classes + 1)
  std::size_t total_ = 0, right_ = 0;
};

// One classified sample, for curves.
struct ScoredPrediction {
  double confidence = 0.0;  // 0..1
  bool right = false;
};
// Coverage: of all answers the share with at least this confidence, and how many of those are
// right.
struct CoveragePoint {
  double confidence = 0.0;
  double coverage = 0.0;
  double accuracy = 0.0;
  std::size_t answers = 0;
};
// At every distinct confidence, falling: the last point covers all.
std::vector<CoveragePoint> coverageCurve(std::vector<ScoredPrediction> answers);
// The lowest confidence from which on Wilson's lower bound at 90 % (one-sided 95 %) of the share
// that is right reaches `target`, if any; more than 1 when none does: never sure.
double confidenceThreshold(const std::vector<ScoredPrediction>& answers, double target = 0.95);
// Expected calibration error: confidences in ten equal bins, |mean confidence - share right|
// weighed by number.
double expectedCalibrationError(std::span<const ScoredPrediction> answers);

// Area under the receiver operating characteristic: how often a value of `positive` exceeds one of
// `negative` (ties half). NaN where either is empty.
double auroc(std::span<const double> positive, std::span<const double> negative);

}  // namespace palpate
