// Protocol S over the 571 shared grasps (features given): 10 splits, each fitting scaling,
// discriminant analysis and support vector machine anew. Reference: LIBSVM training and calling the
// same splits, already projected. And the answer for one grasp.
#include <vector>

#include <benchmark/benchmark.h>
#include <libsvm/svm.h>

#include "palpate/recognition/cross_validation.h"
#include "palpate/recognition/trained_model.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace {
using namespace palpate;

const SampleSet* grasps(benchmark::State& state) {
  static const auto folder = palpate::testing::goldenFolder();
  if (!folder) {
    state.SkipWithError("golden numbers are missing: set PALPATE_GOLDEN");
    return nullptr;
  }
  static const SampleSet samples = palpate::testing::goldenSamples(*folder);
  return &samples;
}

PipelineOptions studyPipeline() {
  PipelineOptions options;
  options.components = 14;
  return options;
}

void protocolS(benchmark::State& state) {
  const SampleSet* samples = grasps(state);
  if (!samples) return;
  const auto splits = stratifiedSplits(samples->y, 10, 0);
  for (auto _ : state)
    if (crossValidate(*samples, studyPipeline(), splits).accuracyMean < 0.95)
      return state.SkipWithError("not the accuracy that is known");
}

using Nodes = std::vector<std::vector<svm_node>>;
Nodes nodesOf(const Eigen::MatrixXd& x) {
  Nodes rows(static_cast<std::size_t>(x.rows()));
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    auto& row = rows[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < x.cols(); ++j) row.push_back({static_cast<int>(j) + 1, x(i, j)});
    row.push_back({-1, 0.0});
  }
  return rows;
}

struct Projected {
  Nodes train, test;
  std::vector<double> y;
};

void sameByLibsvm(benchmark::State& state) {
  const SampleSet* samples = grasps(state);
  if (!samples) return;
  std::vector<Projected> splits;
  for (const SampleSplit& split : stratifiedSplits(samples->y, 10, 0)) {
    const SampleSet train = samples->rows(split.train), test = samples->rows(split.test);
    const Standardisation scale = Standardisation::of(train.x);
    const auto lda = DiscriminantAnalysis::of(scale.apply(train.x), train.y, {.components = 14});
    splits.push_back({nodesOf(lda.apply(scale.apply(train.x))),
                      nodesOf(lda.apply(scale.apply(test.x))),
                      {train.y.begin(), train.y.end()}});
  }
  svm_set_print_string_function([](const char*) {});
  svm_parameter parameter{};
  parameter.svm_type = C_SVC;
  parameter.kernel_type = LINEAR;
  parameter.C = 100.0;
  parameter.eps = 1e-3;
  parameter.cache_size = 50;
  parameter.shrinking = 1;
  for (auto _ : state)
    for (Projected& split : splits) {
      std::vector<svm_node*> rows;
      for (auto& row : split.train) rows.push_back(row.data());
      const svm_problem problem{static_cast<int>(rows.size()), split.y.data(), rows.data()};
      svm_model* model = svm_train(&problem, &parameter);
      for (auto& row : split.test) benchmark::DoNotOptimize(svm_predict(model, row.data()));
      svm_free_and_destroy_model(&model);
    }
}

void oneVerdict(benchmark::State& state, ClassifierKind kind) {
  const SampleSet* samples = grasps(state);
  if (!samples) return;
  PipelineOptions options;
  options.classifier = kind;
  if (kind == ClassifierKind::kSvm) options.components = 14;
  const TrainedModel model = trainModel(*samples, FeatureSet::kStudy, "", options);
  const SessionOffset offset = unknownOffset();
  for (auto _ : state)
    benchmark::DoNotOptimize(classifyRows(model, samples->x.topRows(1), offset, true));
}

BENCHMARK(protocolS)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(sameByLibsvm)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(oneVerdict, svm, ClassifierKind::kSvm)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(oneVerdict, gauss, ClassifierKind::kGauss)->Unit(benchmark::kMicrosecond);

}  // namespace
