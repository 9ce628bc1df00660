#include "palpate/recognition/model_evaluation.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/recognition/plateau_features.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::model_evaluation_test {
namespace {

using testing::clouds;
using testing::recordingsFolder;

constexpr std::int64_t kHourUs = 3600LL * 1'000'000;

SampleSet things(int classes, int perClass, double offsetMm, std::uint64_t seed) {
  SampleSet samples = clouds(classes, perClass, 2, 0.0, seed);
  samples.features = {"size_z", "ln_sum"};
  for (Eigen::Index i = 0; i < samples.x.rows(); ++i) {
    const int c = samples.y[static_cast<std::size_t>(i)];
    samples.x(i, 0) = sizeZ(20.0 + 10.0 * c + 0.5 * samples.x(i, 0) + offsetMm);
    samples.x(i, 1) = 8.0 + 0.6 * (c % 3) + 0.1 * samples.x(i, 1);
  }
  return samples;
}

TrainedModel modelOf(ClassifierKind kind) {
  PipelineOptions options;
  options.classifier = kind;
  TrainedModel model = trainModel(things(6, 20, 0.0, 1), FeatureSet::kBest, "s", options);
  model.inputs = {{"a.dsa", "00", "class 0", 3, 100 * kHourUs, 101 * kHourUs}};
  return model;
}

std::vector<std::int64_t> times(std::size_t count, std::int64_t hour) {
  std::vector<std::int64_t> all;
  for (std::size_t i = 0; i < count; ++i)
    all.push_back(hour * kHourUs + static_cast<std::int64_t>(i) * 1'000'000);
  return all;
}

TEST(ModelEvaluation, ReadsTheChoiceOfAnOffset) {
  EXPECT_EQ(OffsetChoice::from("model").kind, OffsetChoice::Kind::kModel);
  EXPECT_EQ(OffsetChoice::from("none").kind, OffsetChoice::Kind::kNone);
  EXPECT_EQ(OffsetChoice::from("batch").kind, OffsetChoice::Kind::kBatch);
  EXPECT_EQ(OffsetChoice::from("-3.5").mm, -3.5);
  for (const char* text : {"", "batches", "21", "nan", "1mm"})
    EXPECT_THROW(OffsetChoice::from(text), std::invalid_argument) << text;
}

TEST(ModelEvaluation, AFreshModelIsSureOnlyInItsSession) {
  const TrainedModel model = modelOf(ClassifierKind::kGauss);
  const SampleSet test = things(6, 4, 0.0, 2);
  const SessionContext here = sessionFor(model, test.x, times(24, 101), {});
  EXPECT_TRUE(here.sameSession);
  EXPECT_TRUE(here.warnings.empty());
  EXPECT_EQ(here.offset.mm, 0.0);
  const SessionContext later = sessionFor(model, test.x, times(24, 2000), {});
  EXPECT_FALSE(later.sameSession);
  EXPECT_EQ(later.warnings.size(), 1u);
  const auto inside = evaluateModel(model, test, times(24, 101));
  EXPECT_GT(inside.sure, 12u);
  EXPECT_EQ(evaluateModel(model, test, times(24, 2000)).sure, 0u);
}

// Sizes read 3.5 mm too small are not those of any class, unless the offset is left open.
TEST(ModelEvaluation, InAnotherSessionAFreshModelAssumesNoOffset) {
  TrainedModel model = modelOf(ClassifierKind::kGauss);
  const SampleSet test = things(6, 4, -3.5, 2);
  const auto fresh = evaluateModel(model, test, times(24, 2000));
  const auto none =
      evaluateModel(model, test, times(24, 2000), {0, {OffsetChoice::Kind::kNone, 0.0}});
  EXPECT_EQ(fresh.sessions.at(0).offset.origin, OffsetSource::kUnknown);
  EXPECT_EQ(fresh.confusion.right(), none.confusion.right());
  const auto called = [](const ModelEvaluation& evaluation) {
    return std::count_if(
        evaluation.grasps.begin(), evaluation.grasps.end(), [](const EvaluatedGrasp& one) {
          return one.prediction.label == Prediction::kUnknown;
        });
  };
  EXPECT_EQ(called(fresh), 0) << "known objects";
  EXPECT_GT(fresh.notKnownYet, 0u);
  EXPECT_EQ(jsonOf(fresh).at("not_known_yet").asInteger(),
            static_cast<std::int64_t>(fresh.notKnownYet));
  const std::string warning = fresh.sessions.at(0).warnings.back();
  EXPECT_NE(warning.find("can't be known yet"), std::string::npos) << warning;
  EXPECT_NE(warning.find("label grasps of two objects"), std::string::npos) << warning;
  EXPECT_EQ(warning.find("empty hand"), std::string::npos) << "the model has no zero to compare";
  model.trainingZero = EmptyHandZero{};
  EXPECT_NE(notKnownYetText(model, unknownOffset()).find("the zero of the empty hand"),
            std::string::npos);
  // In the session of the training the offset is 0, and everything is decided.
  const auto here = evaluateModel(model, test, times(24, 101));
  EXPECT_EQ(here.notKnownYet, 0u);
  EXPECT_GT(called(here), 0);
}

TEST(ModelEvaluation, AnAdaptationOfYesterdayIsNotTrustedToday) {
  TrainedModel model = modelOf(ClassifierKind::kGauss);
  adaptModel(model, things(6, 1, 3.0, 4));
  ASSERT_TRUE(model.offset.trusted);
  model.adaptedFrom = {{"b.dsa", "00", "class 0", 6, 2000 * kHourUs, 2000 * kHourUs}};
  const SampleSet test = things(6, 4, 3.0, 2);
  EXPECT_TRUE(sessionFor(model, test.x, times(24, 2001), {}).offset.trusted);
  const SessionContext later = sessionFor(model, test.x, times(24, 2100), {});
  EXPECT_FALSE(later.offset.trusted);
  EXPECT_EQ(later.warnings.size(), 1u);
}

TEST(ModelEvaluation, ABatchIsTrustedFromTwoObjectsOn) {
  const TrainedModel model = modelOf(ClassifierKind::kGauss);
  const SampleSet test = things(6, 4, 3.0, 2);
  const SessionContext all =
      sessionFor(model, test.x, times(24, 2000), {OffsetChoice::Kind::kBatch, 0.0});
  EXPECT_NEAR(all.offset.mm, 3.0, 0.7);
  EXPECT_TRUE(all.offset.trusted);
  const SessionContext one =
      sessionFor(model, test.x.topRows(4), times(4, 2000), {OffsetChoice::Kind::kBatch, 0.0});
  EXPECT_FALSE(one.offset.trusted);
  EXPECT_EQ(one.warnings.size(), 1u);
}

TEST(ModelEvaluation, AClassifierWithoutOffsetRefusesOne) {
  const TrainedModel model = modelOf(ClassifierKind::kSvm);
  const SampleSet test = things(6, 4, 0.0, 2);
  EXPECT_NO_THROW(sessionFor(model, test.x, times(24, 101), {}));
  EXPECT_THROW(sessionFor(model, test.x, times(24, 101), {OffsetChoice::Kind::kBatch, 0.0}), Error);
  EXPECT_THROW(sessionFor(model, test.x, times(24, 101), {OffsetChoice::Kind::kGiven, 1.0}), Error);
  EXPECT_THROW(evaluateModel(model, test, times(24, 101), {1, {}}), Error);
}

TEST(ModelEvaluation, SessionsAreWhatPausesPart) {
  const auto sessions = sessionsOf({50 * kHourUs, 1, 2, 51 * kHourUs, 57 * kHourUs});
  ASSERT_EQ(sessions.size(), 2u);
  EXPECT_EQ(sessions[0], (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(sessions[1], (std::vector<std::size_t>{0, 3, 4})) << "6 hours are no pause";
  EXPECT_TRUE(sessionsOf({}).empty());
}

TEST(ModelEvaluation, WhatAdaptsDoesNotCount) {
  const TrainedModel model = modelOf(ClassifierKind::kGauss);
  const SampleSet test = things(6, 4, 4.0, 2);
  const auto evaluation = evaluateModel(model, test, times(24, 2000), {1, {}});
  EXPECT_EQ(evaluation.adapted, (std::vector<std::size_t>{0, 4, 8, 12, 16, 20}))
      << "the first in time of each class";
  EXPECT_EQ(evaluation.confusion.total(), 18u);
  EXPECT_GT(evaluation.confusion.accuracy(), 0.9);
  EXPECT_EQ(evaluation.sessions.at(0).offset.origin, OffsetSource::kReferences);
  EXPECT_THROW(evaluateModel(model, test, times(24, 2000), {4, {}}), Error);
  EXPECT_THROW(evaluateModel(model, test, times(23, 2000)), std::invalid_argument);
}

TEST(ModelEvaluation, JsonHasWhatIsPromised) {
  const TrainedModel model = modelOf(ClassifierKind::kGauss);
  const Json json = jsonOf(evaluateModel(model, things(6, 4, 0.0, 2), times(24, 101)));
  for (const char* key : {"accuracy", "top3", "coverage", "accuracy_when_sure"})
    EXPECT_TRUE(json.at(key).isNumber()) << key;
  EXPECT_EQ(json.at("interval").size(), 2u);
  EXPECT_EQ(json.at("classes").size(), 6u);
  EXPECT_EQ(json.at("confusion").size(), 6u);
}

// Protocol X: the shared recordings of 11 weeks later. Nothing is tuned on these 42 grasps.
class OtherDay : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto folder = recordingsFolder();
    PALPATE_NEED(folder);
    const FeatureTable september = extractFeatures({*folder / "grasps_by_class"});
    PipelineOptions options;
    options.classifier = ClassifierKind::kGauss;
    model_ = trainModel(samplesOf(september), FeatureSet::kBest, september.sensor, options);
    model_.inputs = inputsOf(september);
    const std::map<std::string, std::string> files = {
        {"hockey ball", "grasps/hockey_ball.dsa"},
        {"foam ball", "grasps/foam_ball.dsa"},
        {"pen thick", "classification_video/pen_thick.dsa"}};
    FeatureTable later;
    for (const auto& [name, file] : files) {
      FeatureTable one = extractFeatures({*folder / file});
      for (FeatureRow& row : one.rows) row.className = name;
      later.names = one.names;
      later.rows.insert(later.rows.end(), one.rows.begin(), one.rows.end());
    }
    samples_ = samplesOf(later, model_.classes);
    for (const FeatureRow& row : later.rows) times_.push_back(row.timeUs);
    ASSERT_EQ(samples_.numSamples(), 42u);
  }
  ModelEvaluation with(const char* offset, std::size_t adapt = 0) const {
    return evaluateModel(model_, samples_, times_, {adapt, OffsetChoice::from(offset)});
  }

  TrainedModel model_;
  SampleSet samples_;
  std::vector<std::int64_t> times_;
};

TEST_F(OtherDay, ReachesItsTargets) {
  const auto fresh = with("model"), none = with("none"), batch = with("batch"),
             adapted = with("model", 1);
  const std::pair<const char*, const ModelEvaluation*> all[] = {
      {"model", &fresh}, {"none", &none}, {"batch", &batch}, {"adapt 1", &adapted}};
  for (const auto& [name, evaluation] : all)
    std::printf("  %-8s %zu of %zu right, top3 %zu, sure %zu, of these right %zu\n",
                name,
                evaluation->confusion.right(),
                evaluation->confusion.total(),
                evaluation->top3,
                evaluation->sure,
                evaluation->sureRight);
  EXPECT_EQ(fresh.sessions.size(), 2u) << "27 and 28 November";
  EXPECT_EQ(fresh.sure, 0u) << "without an offset nothing is sure";
  EXPECT_EQ(none.sure, 0u);
  EXPECT_GE(none.confusion.accuracy(), 0.60);
  EXPECT_GE(static_cast<double>(none.top3), 0.92 * 42);
  EXPECT_GE(batch.confusion.accuracy(), 0.90);
  EXPECT_GE(adapted.confusion.accuracy(), 0.95);
  for (const ModelEvaluation* one : {&batch, &adapted})
    EXPECT_GE(static_cast<double>(one->sureRight), 0.95 * static_cast<double>(one->sure));
}

}  // namespace
}  // namespace palpate::model_evaluation_test
