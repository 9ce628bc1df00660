#include "palpate/recognition/cross_validation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/parallel.h"

namespace palpate {
namespace {

std::vector<TestPrediction> examine(const SampleSet& samples,
                                    const PipelineOptions& options,
                                    const SampleSplit& split,
                                    std::size_t number) {
  const ClassifierPipeline pipeline = ClassifierPipeline::of(samples.rows(split.train), options);
  const SampleSet test = samples.rows(split.test);
  const Eigen::MatrixXd scores =
      pipeline.calibrated ? pipeline.probabilities(test.x) : pipeline.scores(test.x);
  const Eigen::VectorXd novelty =
      pipeline.calibrated ? pipeline.noveltyScores(test.x) : Eigen::VectorXd::Zero(test.x.rows());
  std::vector<TestPrediction> testPredictions;
  for (Eigen::Index i = 0; i < test.x.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::vector<int> order = rankedClasses(scores.row(i).transpose());
    const auto top =
        order.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, order.size()));
    testPredictions.push_back({split.test[at],
                               number,
                               order.front(),
                               std::find(order.begin(), top, test.y[at]) != top,
                               pipeline.calibrated ? scores(i, order.front()) : 0.0,
                               novelty[i]});
  }
  return testPredictions;
}

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sdOf(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const double mean = meanOf(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

ValidationReport crossValidationReportOf(const SampleSet& samples,
                                         const std::vector<std::vector<TestPrediction>>& perSplit) {
  ValidationReport report(samples.classes);
  std::size_t inTop3 = 0;
  for (const auto& split : perSplit) {
    std::size_t right = 0;
    for (const TestPrediction& one : split) {
      const int truth = samples.y[one.sample];
      report.confusion.add(truth, one.called);
      right += one.called == truth ? 1 : 0;
      inTop3 += one.inTop3 ? 1 : 0;
      report.testPredictions.push_back(one);
    }
    report.accuracies.push_back(static_cast<double>(right) / static_cast<double>(split.size()));
  }
  report.accuracyMean = meanOf(report.accuracies);
  report.accuracySd = sdOf(report.accuracies);
  report.top3 = static_cast<double>(inTop3) / static_cast<double>(report.testPredictions.size());
  return report;
}

void requireSplits(const std::vector<SampleSplit>& splits) {
  if (splits.empty()) throw std::invalid_argument("crossValidate: no split");
  for (const SampleSplit& split : splits)
    if (split.train.empty() || split.test.empty())
      throw std::invalid_argument("crossValidate: a split without samples on one side");
}

}  // namespace

ValidationReport crossValidate(const SampleSet& samples,
                               const PipelineOptions& options,
                               const std::vector<SampleSplit>& splits,
                               std::size_t threads,
                               const Progress& progress) {
  options.validate();
  requireLearnable(samples);
  requireSplits(splits);
  std::vector<std::vector<TestPrediction>> perSplit(splits.size());
  forEachInParallel(
      splits.size(),
      [&](std::size_t i) { perSplit[i] = examine(samples, options, splits[i], i); },
      progress,
      threads);
  return crossValidationReportOf(samples, perSplit);
}

std::vector<ValidationReport> crossValidateAll(const SampleSet& samples,
                                               const std::vector<PipelineOptions>& options,
                                               const std::vector<SampleSplit>& splits,
                                               std::size_t threads,
                                               const Progress& progress) {
  for (const PipelineOptions& one : options) one.validate();
  requireLearnable(samples);
  requireSplits(splits);
  std::vector<std::vector<std::vector<TestPrediction>>> all(
      options.size(), std::vector<std::vector<TestPrediction>>(splits.size()));
  forEachInParallel(
      options.size() * splits.size(),
      [&](std::size_t i) {
        const std::size_t which = i / splits.size(), split = i % splits.size();
        try {
          all[which][split] = examine(samples, options[which], splits[split], split);
        } catch (const Error&) {  // this split leaves too little to fit it
        }
      },
      progress,
      threads);
  std::vector<ValidationReport> reports;
  for (const auto& perSplit : all) {
    const bool whole = std::none_of(
        perSplit.begin(), perSplit.end(), [](const auto& split) { return split.empty(); });
    reports.push_back(whole ? crossValidationReportOf(samples, perSplit)
                            : ValidationReport(samples.classes));
  }
  return reports;
}

std::vector<LearningPoint> learningCurve(const SampleSet& samples,
                                         const PipelineOptions& options,
                                         const std::vector<std::size_t>& perClass,
                                         std::size_t splits,
                                         std::uint64_t seed,
                                         std::size_t threads,
                                         const Progress& progress) {
  const std::vector<SampleSplit> whole = stratifiedSplits(samples.y, splits, seed);
  std::vector<LearningPoint> curve;
  for (std::size_t k = 0; k < perClass.size(); ++k) {
    if (perClass[k] < 2)
      throw std::invalid_argument("learningCurve: at least two grasps per class are needed");
    std::vector<SampleSplit> part = whole;
    double taught = 0.0;
    for (SampleSplit& split : part) {
      std::vector<std::size_t> taken(samples.numClasses(), 0);
      // Evenly spaced over the recording, not only from its beginning.
      std::vector<std::size_t> there(samples.numClasses(), 0), seen(samples.numClasses(), 0);
      for (const std::size_t i : split.train) ++there[static_cast<std::size_t>(samples.y[i])];
      std::erase_if(split.train, [&](std::size_t i) {
        const auto c = static_cast<std::size_t>(samples.y[i]);
        const std::size_t wanted = std::min(perClass[k], there[c]);
        const std::size_t due = (++seen[c] * wanted + there[c] - 1) / there[c];
        if (due <= taken[c]) return true;
        ++taken[c];
        return false;
      });
      taught += static_cast<double>(split.train.size());
    }
    const Progress step = progress ? Progress([&](double fraction) {
      return progress((static_cast<double>(k) + fraction) / static_cast<double>(perClass.size()));
    })
                                   : Progress();
    const ValidationReport report = crossValidate(samples, options, part, threads, step);
    curve.push_back({perClass[k],
                     taught / static_cast<double>(part.size()),
                     report.accuracyMean,
                     report.accuracySd});
  }
  return curve;
}

}  // namespace palpate
