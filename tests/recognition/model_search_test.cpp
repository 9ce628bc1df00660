#include "palpate/recognition/model_search.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/core/error.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::model_search_test {
namespace {

using testing::clouds;

TEST(ModelSearch, TheGridKeepsToWhatIsThereAndWasAsked) {
  const SampleSet samples = clouds(4, 6, 9, 5.0, 1);
  const auto grid = modelGrid(samples, {});
  for (const PipelineOptions& one : grid) EXPECT_LE(one.components.value_or(0), 3u);
  EXPECT_EQ(std::count_if(grid.begin(),
                          grid.end(),
                          [](const auto& one) { return one.classifier == ClassifierKind::kGauss; }),
            1);
  const auto svm =
      modelGrid(samples, {.classifier = ClassifierKind::kSvm, .components = 2, .costs = {5.0}});
  ASSERT_EQ(svm.size(), 1u);
  EXPECT_EQ(svm[0].components, 2u);
  EXPECT_EQ(svm[0].svm.c, 5.0);
  EXPECT_TRUE(modelGrid(samples, {.classifier = ClassifierKind::kGauss, .components = 2}).empty());
  EXPECT_THROW(modelGrid(samples, {.components = 0}), std::invalid_argument);
}

// Two classes with the same mean, one narrow and one wide: no plane separates them, their
// covariances do.
TEST(ModelSearch, FindsTheClassifierThatFits) {
  SampleSet samples = clouds(2, 80, 3, 0.0, 4);
  for (Eigen::Index i = 80; i < 160; ++i) samples.x.row(i) *= 6.0;
  const auto report = searchModel(samples);
  const ModelCandidate& chosen = report.candidates[report.chosen];
  EXPECT_TRUE(chosen.options.classifier == ClassifierKind::kQda ||
              chosen.options.classifier == ClassifierKind::kGauss);
  EXPECT_FALSE(chosen.options.components) << "a discriminant analysis loses it";
  EXPECT_GT(chosen.accuracyMean, 0.85);
  for (const ModelCandidate& one : report.candidates)
    EXPECT_LE(one.accuracyMean, chosen.accuracyMean + 0.03);
  EXPECT_EQ(jsonOf(report).size(), report.candidates.size());
}

TEST(ModelSearch, OfEqualOnesTheSimplerIsTaken) {
  const auto report = searchModel(clouds(3, 15, 3, 30.0, 4));  // anything is right
  EXPECT_EQ(report.chosen, 0u);
}

TEST(ModelSearch, SaysWhenThereIsTooLittle) {
  EXPECT_THROW(searchModel(clouds(1, 10, 2, 1.0, 1)), Error);
  EXPECT_THROW(searchModel(clouds(5, 1, 2, 1.0, 1)), Error);
  EXPECT_THROW(searchModel(clouds(3, 15, 3, 30.0, 4), {}, [](double) { return false; }), Cancelled);
}

// Two of six features separate the classes: they are removed last, and removing the others does not
// reduce the accuracy.
TEST(ModelSearch, EliminationKeepsWhatTellsClassesApart) {
  SampleSet samples = clouds(4, 25, 6, 0.0, 6);
  for (std::size_t i = 0; i < samples.y.size(); ++i) {
    samples.x(static_cast<Eigen::Index>(i), 1) += 8.0 * (samples.y[i] % 2);
    samples.x(static_cast<Eigen::Index>(i), 4) += 8.0 * (samples.y[i] / 2);
  }
  const auto splits = stratifiedSplits(samples.y, 5, 1);
  for (const ClassifierKind kind :
       {ClassifierKind::kSvm, ClassifierKind::kQda, ClassifierKind::kGauss})
    for (const bool lda : {false, true}) {
      PipelineOptions options;
      options.classifier = kind;
      if (lda && kind == ClassifierKind::kGauss) continue;
      if (lda) options.components = 2;
      const auto steps = eliminateFeatures(samples, options, splits);
      ASSERT_EQ(steps.size(), 6u);
      EXPECT_EQ(steps[0].features, 6u);
      EXPECT_EQ(steps[5].features, 1u);
      EXPECT_EQ(steps[4].dropped + steps[5].dropped, 5u) << classifierName(kind) << lda;
      EXPECT_NE(steps[4].dropped, 0u);
      EXPECT_NE(steps[4].dropped, 5u);
      EXPECT_GT(steps[4].accuracyMean, 0.97);
      EXPECT_LT(steps[5].accuracyMean, 0.75) << "one of the two is gone";
    }
}

TEST(ModelSearch, EliminationDoesNotDependOnThreads) {
  const SampleSet samples = clouds(3, 12, 4, 3.0, 6);
  const auto splits = stratifiedSplits(samples.y, 4, 1);
  const auto one = eliminateFeatures(samples, {}, splits, 1);
  const auto three = eliminateFeatures(samples, {}, splits, 3);
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].accuracyMean, three[k].accuracyMean);
    EXPECT_EQ(one[k].dropped, three[k].dropped);
  }
}

}  // namespace
}  // namespace palpate::model_search_test
