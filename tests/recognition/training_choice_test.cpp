#include "palpate/recognition/training_choice.h"

#include "palpate/core/error.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::training_choice_test {
namespace {

using testing::clouds;

TEST(TrainingChoice, OfTheSetForOtherSessionsGaussIsTaken) {
  EXPECT_EQ(searchOptions(FeatureSet::kBest, {}).classifier, ClassifierKind::kGauss);
  EXPECT_EQ(searchOptions(FeatureSet::kBest, ClassifierKind::kQda).classifier,
            ClassifierKind::kQda);
  for (const FeatureSet set : {FeatureSet::kStudy, FeatureSet::kSession, FeatureSet::kStatistics}) {
    EXPECT_FALSE(searchOptions(set, {}).classifier);
    EXPECT_EQ(searchOptions(set, ClassifierKind::kLda).classifier, ClassifierKind::kLda);
  }
}

TEST(TrainingChoice, WhereThereIsOneCandidateNothingIsSearched) {
  const SampleSet samples = clouds(3, 15, 3, 30.0, 4);
  const auto gauss = choosePipeline(samples, searchOptions(FeatureSet::kBest, {}));
  EXPECT_EQ(gauss.options.classifier, ClassifierKind::kGauss);
  EXPECT_TRUE(gauss.report.candidates.empty());
  const auto svm = choosePipeline(samples, searchOptions(FeatureSet::kBest, ClassifierKind::kSvm));
  EXPECT_EQ(svm.options.classifier, ClassifierKind::kSvm);
  ASSERT_FALSE(svm.report.candidates.empty());
  for (const ModelCandidate& one : svm.report.candidates)
    EXPECT_EQ(one.options.classifier, ClassifierKind::kSvm);
  EXPECT_EQ(choosePipeline(samples, searchOptions(FeatureSet::kStudy, {})).options.classifier,
            searchModel(samples).candidates.front().options.classifier)
      << "of equal ones the first";
  EXPECT_THROW(choosePipeline(samples, {.classifier = ClassifierKind::kGauss, .components = 2}),
               std::invalid_argument);
  EXPECT_THROW(choosePipeline(samples, {}, [](double) { return false; }), Cancelled);
}

TEST(TrainingChoice, SaysWhatCanNotBeChosenAndWhatDoesNotCarryOver) {
  for (const FeatureSet set : {FeatureSet::kBest, FeatureSet::kStudy, FeatureSet::kSession}) {
    EXPECT_EQ(whyNoFeatures(set, true), "");
    EXPECT_NE(whyNoFeatures(set, false).find("no two pads that pinch"), std::string::npos);
  }
  EXPECT_EQ(whyNoFeatures(FeatureSet::kStatistics, false), "");
  EXPECT_EQ(whyBoundToSession(FeatureSet::kBest, ClassifierKind::kGauss), "");
  EXPECT_NE(whyBoundToSession(FeatureSet::kBest, ClassifierKind::kSvm).find("only gauss"),
            std::string::npos);
  EXPECT_NE(whyBoundToSession(FeatureSet::kSession, ClassifierKind::kGauss).find("pose"),
            std::string::npos);
  EXPECT_NE(whyBoundToSession(FeatureSet::kStudy, ClassifierKind::kGauss).find("has no size_z"),
            std::string::npos);
}

TEST(TrainingChoice, IsToldInWords) {
  PipelineOptions options;
  options.classifier = ClassifierKind::kGauss;
  EXPECT_EQ(madeWithText(FeatureSet::kBest, options), "best, gauss");
  options.classifier = ClassifierKind::kSvm;
  options.components = 2;
  options.svm.c = 10.0;
  EXPECT_EQ(madeWithText(FeatureSet::kStudy, options), "study, 2 components, svm (C = 10)");
  const auto pipeline = ClassifierPipeline::of(clouds(4, 15, 3, 30.0, 4), options);
  EXPECT_EQ(madeWithText(FeatureSet::kStudy, pipeline), "study, 2 components, svm");
}

}  // namespace
}  // namespace palpate::training_choice_test
