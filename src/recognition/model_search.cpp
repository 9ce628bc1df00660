#include "palpate/recognition/model_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/parallel.h"

namespace palpate {
namespace {

std::vector<std::optional<std::size_t>> componentsOf(const SampleSet& samples,
                                                     const ModelSearchOptions& options) {
  const std::vector<std::size_t> counts = samples.counts();
  const auto classes = static_cast<std::size_t>(
      std::count_if(counts.begin(), counts.end(), [](std::size_t n) { return n > 0; }));
  const std::size_t most = std::min(samples.numFeatures(), classes > 0 ? classes - 1 : 0);
  if (options.components) return {options.components};
  std::vector<std::optional<std::size_t>> list;
  for (const std::size_t wanted : options.componentGrid)
    if (wanted <= most) list.emplace_back(wanted);
  if (list.empty() && most > 0) list.emplace_back(most);
  list.emplace_back(std::nullopt);
  return list;
}

// Result of one split: accuracy with n, n - 1, .. 1 features, and the order in which they were
// removed.
struct Elimination {
  std::vector<double> accuracy;
  std::vector<std::size_t> dropped;
};

double shareRight(const ClassifierPipeline& pipeline, const SampleSet& test) {
  const Eigen::MatrixXd scores = pipeline.scores(test.x);
  std::size_t right = 0;
  for (std::size_t i = 0; i < test.numSamples(); ++i)
    right +=
        rankedClasses(scores.row(static_cast<Eigen::Index>(i)).transpose()).front() == test.y[i]
            ? 1
            : 0;
  return static_cast<double>(right) / static_cast<double>(test.numSamples());
}

// If `test` is empty, only the order is determined.
Elimination eliminate(const SampleSet& train,
                      const SampleSet& test,
                      const PipelineOptions& options) {
  std::vector<std::size_t> left(train.numFeatures());
  std::iota(left.begin(), left.end(), std::size_t{0});
  Elimination result;
  while (!left.empty()) {
    const auto pipeline = ClassifierPipeline::of(train.columns(left), options);
    if (test.numSamples() > 0) result.accuracy.push_back(shareRight(pipeline, test.columns(left)));
    Eigen::Index least = 0;
    pipeline.featureWeights().minCoeff(&least);
    result.dropped.push_back(left[static_cast<std::size_t>(least)]);
    left.erase(left.begin() + least);
  }
  return result;
}

}  // namespace

std::vector<PipelineOptions> modelGrid(const SampleSet& samples,
                                       const ModelSearchOptions& options) {
  if (options.components && *options.components == 0)
    throw std::invalid_argument("ModelSearchOptions: components must be 1 or more");
  std::vector<PipelineOptions> grid;
  const auto wanted = [&](ClassifierKind kind) {
    return !options.classifier || *options.classifier == kind;
  };
  const auto components = componentsOf(samples, options);
  const auto add = [&](ClassifierKind kind, const auto& change) {
    for (const auto& count : components) {
      PipelineOptions one;
      one.classifier = kind;
      one.components = count;
      change(one);
      grid.push_back(std::move(one));
    }
  };
  if (wanted(ClassifierKind::kGauss) && !options.components) {
    PipelineOptions gauss;
    gauss.classifier = ClassifierKind::kGauss;
    grid.push_back(gauss);
  }
  if (wanted(ClassifierKind::kLda)) add(ClassifierKind::kLda, [](PipelineOptions&) {});
  if (wanted(ClassifierKind::kQda))
    for (const double share : options.pooledShares)
      add(ClassifierKind::kQda, [&](PipelineOptions& one) { one.gaussian.pooledFraction = share; });
  if (wanted(ClassifierKind::kSvm))
    for (const double cost : options.costs)
      add(ClassifierKind::kSvm, [&](PipelineOptions& one) { one.svm.c = cost; });
  return grid;
}

ModelSearchReport searchModel(const SampleSet& samples,
                              const ModelSearchOptions& options,
                              const Progress& progress) {
  requireLearnable(samples);
  const std::vector<PipelineOptions> grid = modelGrid(samples, options);
  if (grid.empty()) throw std::invalid_argument("searchModel: nothing to choose from");
  ModelSearchReport report;
  const auto splits = blockSplits(samples.y, options.blocks);
  const auto testPredictions = crossValidateAll(samples, grid, splits, options.threads, progress);
  for (std::size_t i = 0; i < grid.size(); ++i)
    report.candidates.push_back({grid[i],
                                 testPredictions[i].accuracyMean,
                                 testPredictions[i].accuracySd,
                                 !testPredictions[i].accuracies.empty()});
  const auto best = std::max_element(
      report.candidates.begin(), report.candidates.end(), [](const auto& a, const auto& b) {
        return a.accuracyMean < b.accuracyMean;
      });
  if (!best->fitted)
    throw Error("too few grasps to choose a classifier by cross-validation: " +
                std::to_string(samples.numSamples()) + " of " +
                std::to_string(samples.numClasses()) + " classes");
  const double slack = 0.5 * best->accuracySd / std::sqrt(static_cast<double>(splits.size()));
  const auto chosen = std::find_if(
      report.candidates.begin(), report.candidates.end(), [&](const ModelCandidate& one) {
        return one.fitted && one.accuracyMean >= best->accuracyMean - slack;
      });
  report.chosen = static_cast<std::size_t>(chosen - report.candidates.begin());
  return report;
}

Json jsonOf(const PipelineOptions& options) {
  Json json = Json::object().set("classifier", classifierName(options.classifier));
  json.set("lda", options.components ? Json(*options.components) : Json());
  if (options.classifier == ClassifierKind::kSvm) json.set("c", options.svm.c);
  if (options.classifier == ClassifierKind::kQda)
    json.set("pooled_share", options.gaussian.pooledFraction);
  return json;
}

Json jsonOf(const ModelSearchReport& report) {
  Json list = Json::array();
  for (const ModelCandidate& one : report.candidates) {
    Json entry = jsonOf(one.options);
    if (one.fitted)
      entry.set("accuracy_mean", one.accuracyMean).set("accuracy_sd", one.accuracySd);
    else
      entry.set("accuracy_mean", Json()).set("accuracy_sd", Json());
    list.push(std::move(entry));
  }
  return list;
}

std::vector<EliminationStep> eliminateFeatures(const SampleSet& samples,
                                               const PipelineOptions& options,
                                               const std::vector<SampleSplit>& splits,
                                               std::size_t threads,
                                               const Progress& progress) {
  requireLearnable(samples);
  std::vector<Elimination> all(splits.size() + 1);
  forEachInParallel(
      all.size(),
      [&](std::size_t i) {
        all[i] =
            i == splits.size()
                ? eliminate(samples, {{}, {}, samples.classes, samples.features}, options)
                : eliminate(samples.rows(splits[i].train), samples.rows(splits[i].test), options);
      },
      progress,
      threads);
  std::vector<EliminationStep> steps;
  for (std::size_t k = 0; k < samples.numFeatures(); ++k) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < splits.size(); ++i) sum += all[i].accuracy[k];
    const auto n = static_cast<double>(splits.size());
    const double mean = n > 0.0 ? sum / n : 0.0;
    for (std::size_t i = 0; i < splits.size(); ++i)
      squares += (all[i].accuracy[k] - mean) * (all[i].accuracy[k] - mean);
    steps.push_back({samples.numFeatures() - k,
                     all.back().dropped[k],
                     mean,
                     n > 1.0 ? std::sqrt(squares / (n - 1.0)) : 0.0});
  }
  return steps;
}

}  // namespace palpate
