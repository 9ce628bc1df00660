#include "palpate/recognition/classifier_pipeline.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "palpate/core/error.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::classifier_pipeline_test {
namespace {

using testing::clouds;

const ClassifierKind kAll[] = {
    ClassifierKind::kSvm, ClassifierKind::kQda, ClassifierKind::kLda, ClassifierKind::kGauss};

double shareRight(const ClassifierPipeline& pipeline, const SampleSet& samples) {
  const Eigen::MatrixXd scores = pipeline.scores(samples.x);
  int right = 0;
  for (Eigen::Index i = 0; i < scores.rows(); ++i)
    right +=
        rankedClasses(scores.row(i).transpose()).front() == samples.y[static_cast<std::size_t>(i)]
            ? 1
            : 0;
  return static_cast<double>(right) / static_cast<double>(scores.rows());
}

TEST(ClassifierPipeline, EveryClassifierTellsCloudsApart) {
  const SampleSet train = clouds(6, 15, 4, 9.0, 1), test = clouds(6, 15, 4, 9.0, 2);
  for (const ClassifierKind kind : kAll)
    for (const bool lda : {false, true}) {
      PipelineOptions options;
      options.classifier = kind;
      if (lda && kind != ClassifierKind::kGauss) options.components = 3;
      EXPECT_GT(shareRight(ClassifierPipeline::of(train, options), test), 0.98)
          << classifierName(kind) << lda;
    }
}

TEST(ClassifierPipeline, ProbabilitiesMeanWhatTheySay) {
  // Clouds at a distance of 2.5 overlap: about 75 of 100 predictions are correct.
  const SampleSet train = clouds(4, 100, 4, 2.5, 3), test = clouds(4, 500, 4, 2.5, 4);
  for (const ClassifierKind kind : kAll) {
    PipelineOptions options;
    options.classifier = kind;
    options.calibrationBlocks = 5;
    const auto pipeline = ClassifierPipeline::of(train, options);
    const Eigen::MatrixXd p = pipeline.probabilities(test.x);
    double said = 0.0, right = 0.0;
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
      EXPECT_NEAR(p.row(i).sum(), 1.0, 1e-9);
      Eigen::Index called = 0;
      said += p.row(i).maxCoeff(&called);
      right += called == test.y[static_cast<std::size_t>(i)] ? 1.0 : 0.0;
    }
    // gauss allows for differences between sessions: within one session it is more accurate than
    // its probabilities state.
    EXPECT_LT(said / right, 1.05) << classifierName(kind);
    EXPECT_GT(said / right, kind == ClassifierKind::kGauss ? 0.8 : 0.95) << classifierName(kind);
    EXPECT_GT(right, 0.7 * 2000) << classifierName(kind);
  }
}

TEST(ClassifierPipeline, WhatIsFarFromEverythingIsNovel) {
  PipelineOptions options;
  options.calibrationBlocks = 3;
  const SampleSet train = clouds(4, 30, 3, 8.0, 5);
  const auto pipeline = ClassifierPipeline::of(train, options);
  Eigen::MatrixXd x(2, 3);
  x << 8.0, 0.0, 0.0, 40.0, -40.0, 40.0;
  const Eigen::VectorXd novelty = pipeline.noveltyScores(x);
  EXPECT_LT(novelty[0], 15.0);
  EXPECT_GT(novelty[1], 300.0);
}

TEST(ClassifierPipeline, ComesBackFromItsFileBitByBit) {
  const SampleSet train = clouds(5, 12, 4, 5.0, 6), test = clouds(5, 3, 4, 5.0, 7);
  for (const ClassifierKind kind : kAll)
    for (const bool lda : {false, true}) {
      PipelineOptions options;
      options.classifier = kind;
      options.calibrationBlocks = 4;
      if (lda && kind != ClassifierKind::kGauss) options.components = 2;
      const auto pipeline = ClassifierPipeline::of(train, options);
      const auto back = pipelineFrom(Json::parse(jsonOf(pipeline).text()));
      EXPECT_EQ(back.probabilities(test.x), pipeline.probabilities(test.x));
      EXPECT_EQ(back.noveltyScores(test.x), pipeline.noveltyScores(test.x));
      EXPECT_EQ(back.scores(test.x), pipeline.scores(test.x));
    }
}

// Each key is removed and each number is replaced by a text; the result must never be accepted as a
// model.
TEST(ClassifierPipeline, RefusesDamagedFiles) {
  PipelineOptions options;
  options.calibrationBlocks = 3;
  options.components = 2;
  const Json whole = jsonOf(ClassifierPipeline::of(clouds(3, 6, 3, 5.0, 6), options));
  for (const std::string& missing : whole.keys()) {
    if (missing == "discriminant")
      // A pipeline without this key is a different valid one with other sizes.
      continue;
    Json damaged = Json::object();
    for (const std::string& key : whole.keys())
      if (key != missing) damaged.set(key, whole.at(key));
    EXPECT_THROW(pipelineFrom(damaged), Error) << missing;
    damaged.set(missing, "seven");
    EXPECT_THROW(pipelineFrom(damaged), Error) << missing;
  }
  Json nan = whole;
  nan.set("exponent", std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(pipelineFrom(nan), Error);
  Json other = whole;
  other.set("classifier", "oracle");
  EXPECT_THROW(pipelineFrom(other), Error);
  EXPECT_THROW(pipelineFrom(Json::array()), Error);
}

TEST(ClassifierPipeline, WeightsPointAtWhatTellsClassesApart) {
  SampleSet samples = clouds(3, 30, 4, 0.0, 9);
  for (std::size_t i = 0; i < samples.y.size(); ++i)
    samples.x(static_cast<Eigen::Index>(i), 2) += 20.0 * samples.y[i];
  for (const bool lda : {false, true}) {
    PipelineOptions options;
    if (lda) options.components = 2;
    const Eigen::VectorXd weights = ClassifierPipeline::of(samples, options).featureWeights();
    EXPECT_NEAR(weights.sum(), 1.0, 1e-9);
    Eigen::Index most = 0;
    weights.maxCoeff(&most);
    EXPECT_EQ(most, 2);
  }
}

TEST(ClassifierPipeline, BearsConstantFeaturesAndSingleSamples) {
  SampleSet samples = clouds(3, 8, 3, 6.0, 2);
  samples.x.col(1).setConstant(7.0);
  samples.y.back() = 1;
  samples.y[0] = 0;
  for (std::size_t i = 17; i < 23; ++i) samples.y[i] = 1;  // class 2 keeps one sample
  for (const ClassifierKind kind : kAll) {
    PipelineOptions options;
    options.classifier = kind;
    options.calibrationBlocks = 4;
    if (kind != ClassifierKind::kGauss) options.components = 2;
    const auto pipeline = ClassifierPipeline::of(samples, options);
    EXPECT_TRUE(pipeline.probabilities(samples.x).allFinite()) << classifierName(kind);
  }
}

TEST(ClassifierPipeline, SaysWhatItCant) {
  EXPECT_THROW(ClassifierPipeline::of(clouds(1, 5, 2, 1.0, 1)), Error);
  EXPECT_THROW(ClassifierPipeline::of(clouds(4, 1, 2, 1.0, 1)), Error);
  const SampleSet samples = clouds(2, 5, 2, 5.0, 1);
  PipelineOptions options;
  options.components = 0;
  EXPECT_THROW(ClassifierPipeline::of(samples, options), std::invalid_argument);
  const auto pipeline = ClassifierPipeline::of(samples);
  EXPECT_THROW(pipeline.probabilities(samples.x), std::invalid_argument) << "not calibrated";
  EXPECT_THROW(pipeline.scores(Eigen::MatrixXd::Zero(1, 3)), std::invalid_argument);
  for (const ClassifierKind kind : kAll) EXPECT_EQ(classifierNamed(classifierName(kind)), kind);
  EXPECT_FALSE(classifierNamed("SVM"));
}

}  // namespace
}  // namespace palpate::classifier_pipeline_test
