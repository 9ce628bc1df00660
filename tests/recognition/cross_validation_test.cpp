#include "palpate/recognition/cross_validation.h"

#include <stdexcept>

#include "palpate/core/error.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::cross_validation_test {
namespace {

using testing::clouds;
using testing::goldenFolder;
using testing::goldenSamples;
using testing::studySubset;

PipelineOptions ldaAndSvm(std::size_t components) {
  PipelineOptions options;
  options.components = components;
  return options;
}

double meanOfSeeds(const SampleSet& samples, const PipelineOptions& options) {
  constexpr std::uint64_t kSeeds = 5;
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
    sum += crossValidate(samples, options, stratifiedSplits(samples.y, 10, seed)).accuracyMean;
  return sum / static_cast<double>(kSeeds);
}

// Values from methods.md, section 8: scikit-learn on the same 571 grasps, mean of 50 splits.
TEST(CrossValidation, ReproducesTheStudysTable) {
  const auto folder = goldenFolder();
  PALPATE_NEED(folder);
  const SampleSet all = goldenSamples(*folder);
  ASSERT_EQ(all.numSamples(), 571u);
  EXPECT_NEAR(meanOfSeeds(studySubset(all, "diameter"), {}), 0.719, 0.01);
  EXPECT_NEAR(meanOfSeeds(studySubset(all, "first4"), {}), 0.859, 0.01);
  EXPECT_NEAR(meanOfSeeds(studySubset(all, "moments"), {}), 0.694, 0.01);
  EXPECT_NEAR(meanOfSeeds(all, {}), 0.869, 0.01);
  EXPECT_NEAR(meanOfSeeds(all, ldaAndSvm(14)), 0.971, 0.01);
}

TEST(CrossValidation, ShrinkageAndTheQuadraticRuleHoldOnRealGrasps) {
  const auto folder = goldenFolder();
  PALPATE_NEED(folder);
  const SampleSet all = goldenSamples(*folder);
  PipelineOptions options = ldaAndSvm(14);
  options.discriminant.shrinkage.reset();
  EXPECT_GT(meanOfSeeds(all, options), 0.955);
  options.discriminant.shrinkage = 0.0;
  options.classifier = ClassifierKind::kQda;
  EXPECT_GT(meanOfSeeds(all, options), 0.97);
}

// Each object is left out of the training in turn and compared with test grasps of known objects:
// unknown objects have a larger distance.
TEST(CrossValidation, StrangersAreTold) {
  const auto folder = goldenFolder();
  PALPATE_NEED(folder);
  const SampleSet all = goldenSamples(*folder);
  PipelineOptions options = ldaAndSvm(14);
  options.calibrationBlocks = 2;  // the distance doesn't depend on it
  std::vector<double> strange, known;
  for (const TestPrediction& one :
       crossValidate(all, options, leaveClassOutSplits(all.y)).testPredictions)
    strange.push_back(one.novelty);
  for (const TestPrediction& one : crossValidate(all, options, blockSplits(all.y)).testPredictions)
    known.push_back(one.novelty);
  EXPECT_GT(auroc(strange, known), 0.92);
}

TEST(CrossValidation, DoesNotDependOnTheNumberOfThreads) {
  const SampleSet samples = clouds(5, 12, 4, 3.0, 1);
  PipelineOptions options;
  options.calibrationBlocks = 3;
  const auto splits = stratifiedSplits(samples.y, 6, 3);
  const auto one = crossValidate(samples, options, splits, 1);
  const auto four = crossValidate(samples, options, splits, 4);
  EXPECT_EQ(one.accuracies, four.accuracies);
  ASSERT_EQ(one.testPredictions.size(), four.testPredictions.size());
  for (std::size_t i = 0; i < one.testPredictions.size(); ++i) {
    EXPECT_EQ(one.testPredictions[i].called, four.testPredictions[i].called);
    EXPECT_EQ(one.testPredictions[i].confidence, four.testPredictions[i].confidence);
    EXPECT_EQ(one.testPredictions[i].novelty, four.testPredictions[i].novelty);
  }
}

// One feature is the number of the sample, and the labels are random. A method that uses the test
// samples for fitting could be right about each; a correct one is right by chance only.
TEST(CrossValidation, NothingOfTheSamplesThatExamineIsKnown) {
  SampleSet samples = clouds(2, 60, 30, 0.0, 5);  // 30 features of pure noise
  PipelineOptions options = ldaAndSvm(1);
  const auto report = crossValidate(samples, options, stratifiedSplits(samples.y, 20, 1));
  EXPECT_NEAR(report.accuracyMean, 0.5, 0.1);
  EXPECT_GT(ClassifierPipeline::of(samples, options).scores(samples.x).rows(), 0);
}

TEST(CrossValidation, CountsEverySampleThatExamines) {
  const SampleSet samples = clouds(3, 10, 3, 9.0, 2);
  const auto report = crossValidate(samples, {}, blockSplits(samples.y));
  EXPECT_EQ(report.confusion.total(), 30u);
  EXPECT_EQ(report.testPredictions.size(), 30u);
  EXPECT_EQ(report.accuracies.size(), 5u);
  EXPECT_EQ(report.top3, 1.0) << "of three classes the truth is always among three";
  EXPECT_DOUBLE_EQ(report.accuracyMean, report.confusion.accuracy()) << "splits of one size";
}

TEST(CrossValidation, OneThatCantBeFittedDoesNotStopTheOthers) {
  SampleSet samples = clouds(3, 6, 2, 9.0, 2);
  const std::vector<SampleSplit> splits = {{{0, 1, 2, 3}, {4, 5}}, {{0, 1, 6, 7}, {2, 8}}};
  const auto reports = crossValidateAll(samples, {PipelineOptions{}}, splits);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_TRUE(reports[0].accuracies.empty()) << "a split of one class can't teach";
  EXPECT_THROW(crossValidate(samples, {}, splits), Error);
  EXPECT_THROW(crossValidate(samples, {}, {}), std::invalid_argument);
}

TEST(CrossValidation, IsCancelled) {
  const SampleSet samples = clouds(3, 10, 3, 9.0, 2);
  EXPECT_THROW(
      crossValidate(
          samples, {}, stratifiedSplits(samples.y, 50, 1), 1, [](double) { return false; }),
      Cancelled);
}

TEST(CrossValidation, MoreGraspsTeachMore) {
  const SampleSet samples = clouds(6, 40, 6, 2.5, 8);
  PipelineOptions options;
  options.classifier = ClassifierKind::kLda;
  const auto curve = learningCurve(samples, options, {3, 8, 30}, 10, 1);
  ASSERT_EQ(curve.size(), 3u);
  EXPECT_DOUBLE_EQ(curve[0].trainSamples, 18.0);
  EXPECT_DOUBLE_EQ(curve[2].trainSamples, 180.0);
  EXPECT_LT(curve[0].accuracyMean, curve[2].accuracyMean);
  EXPECT_THROW(learningCurve(samples, options, {1}, 10, 1), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::cross_validation_test
