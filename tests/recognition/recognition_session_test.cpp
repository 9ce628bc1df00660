#include "palpate/recognition/recognition_session.h"

#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/recognition/plateau_features.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::recognition_session_test {
namespace {

constexpr std::int64_t kHourUs = 3600LL * 1'000'000;
constexpr std::int64_t kTrainedUs = 100 * kHourUs, kTodayUs = 3000 * kHourUs;

// Grasps of objects of 20, 30, .. mm that differ in size (sd .5 mm) and in one more feature,
// measured with an offset.
SampleSet things(int perClass, double offsetMm, std::uint64_t seed) {
  SampleSet samples = testing::clouds(5, perClass, 2, 0.0, seed);
  samples.features = {"size_z", "ln_sum"};
  for (Eigen::Index i = 0; i < samples.x.rows(); ++i) {
    const int c = samples.y[static_cast<std::size_t>(i)];
    samples.x(i, 0) = sizeZ(20.0 + 10.0 * c + 0.5 * samples.x(i, 0) + offsetMm);
    samples.x(i, 1) = 8.0 + 0.3 * (c % 3) + 0.1 * samples.x(i, 1);
  }
  return samples;
}

TrainedModel model(ClassifierKind kind = ClassifierKind::kGauss) {
  PipelineOptions options;
  options.classifier = kind;
  TrainedModel made = trainModel(things(20, 0.0, 1), FeatureSet::kBest, "a sensor", options);
  made.inputs = {{"a.dsa", "00", "class 0", 3, kTrainedUs, kTrainedUs + kHourUs}};
  return made;
}

std::vector<double> row(const SampleSet& samples, std::size_t i) {
  const auto at = static_cast<Eigen::Index>(i);
  return {samples.x(at, 0), samples.x(at, 1)};
}

double shareRight(const RecognitionSession& day, const SampleSet& test) {
  double right = 0.0;
  for (std::size_t i = 0; i < test.numSamples(); ++i)
    right += day.predict(row(test, i), kTodayUs).label == test.y[i] ? 1.0 : 0.0;
  return right / static_cast<double>(test.numSamples());
}

TEST(RecognitionSession, OnTheDayOfTrainingItMayBeSure) {
  RecognitionSession day(model());
  const SampleSet test = things(4, 0.0, 2);
  EXPECT_EQ(day.offset().origin, OffsetSource::kNone);
  day.add(row(test, 0), kTrainedUs);
  EXPECT_EQ(day.unsure(), "");
  EXPECT_TRUE(day.predict(row(test, 0), kTrainedUs).sure);
}

TEST(RecognitionSession, OnAnotherDayNothingIsSureBeforeItIsKnown) {
  RecognitionSession day(model());
  const SampleSet test = things(4, 0.0, 2);
  day.add(row(test, 0), kTodayUs);
  EXPECT_NE(day.unsure().find("not the session of the training"), std::string::npos);
  EXPECT_FALSE(day.predict(row(test, 0), kTodayUs).sure);
}

TEST(RecognitionSession, InAnotherSessionTheOffsetIsLeftOpen) {
  RecognitionSession day(model());
  const SampleSet today = things(4, -5.0, 2);
  const Prediction first = day.predict(row(today, 0), kTodayUs);
  EXPECT_EQ(first.membership, Membership::kNotKnownYet);
  EXPECT_EQ(day.predict(row(today, 0), kTrainedUs).membership, Membership::kUnknown)
      << "in the session of the training nothing else explains the size";
  day.add(row(today, 0), kTodayUs);
  EXPECT_EQ(day.offset().origin, OffsetSource::kUnknown);
  EXPECT_EQ(day.predict(row(today, 0), kTodayUs).p, first.p);
  EXPECT_EQ(day.adapted().offset.origin, OffsetSource::kNone) << "nothing was learnt to be saved";
}

TEST(RecognitionSession, WhatIsToldGivesTheOffset) {
  RecognitionSession day(model());
  const SampleSet today = things(6, -4.0, 3);
  day.choose({OffsetChoice::Kind::kGiven, 0.0});
  EXPECT_LT(shareRight(day, today), 0.9) << "sizes are read wrong";
  day.choose({});
  day.setLabel(day.add(row(today, 0), kTodayUs), today.y[0]);
  EXPECT_EQ(day.offset().objects, 1u);
  EXPECT_FALSE(day.offset().trusted);
  EXPECT_NE(day.unsure().find("one object only"), std::string::npos);
  std::size_t other = 0;
  while (today.y[other] != (today.y[0] + 2) % 5) ++other;
  const std::size_t second = day.add(row(today, other), kTodayUs + 60'000'000);
  day.setLabel(second, today.y[other]);
  EXPECT_EQ(day.numLabelled(), 2u);
  EXPECT_EQ(day.offset().origin, OffsetSource::kReferences);
  EXPECT_NEAR(day.offset().mm, -4.0, 1.0);
  EXPECT_TRUE(day.offset().trusted);
  EXPECT_EQ(day.unsure(), "");
  EXPECT_GT(shareRight(day, today), 0.9);
  const TrainedModel adapted = day.adapted();
  EXPECT_EQ(adapted.offset.mm, day.offset().mm);
  EXPECT_EQ(adapted.pipeline.sessionAdaptive->data().today.size(), 2u);
  EXPECT_TRUE(adapted.sameSession(kTodayUs + kHourUs));
  EXPECT_NO_THROW(trainedModelFrom(Json::parse(jsonOf(adapted).text())));
  day.setLabel(second, std::nullopt);
  EXPECT_EQ(day.numLabelled(), 1u);
  day.reset();
  EXPECT_EQ(day.offset().origin, OffsetSource::kNone);
  EXPECT_TRUE(day.grasps().empty());
}

TEST(RecognitionSession, TheZeroOfTheEmptyHandGivesTheOffset) {
  EmptyHandZero training, today;
  training.mm = -1.0;
  today.mm = -5.0;
  training.sdMm = today.sdMm = 0.2;
  training.touches = today.touches = 1;
  RecognitionSession without(model());
  EXPECT_THROW(without.setZero(today), Error) << "nothing to compare with";
  TrainedModel kept = model();
  kept.trainingZero = training;
  kept = trainedModelFrom(Json::parse(jsonOf(kept).text()));  // through a file
  ASSERT_TRUE(kept.trainingZero);
  RecognitionSession day(kept);
  day.setZero(today);
  EXPECT_NEAR(day.offset().mm, -4.0, 0.1);
  EXPECT_EQ(day.offset().origin, OffsetSource::kEmptyHand);
  EXPECT_TRUE(day.offset().trusted);
  EXPECT_GT(shareRight(day, things(6, -4.0, 3)), 0.9);
  EmptyHandZero bad;
  bad.problem = "no touch";
  EXPECT_THROW(day.setZero(bad), Error);
}

TEST(RecognitionSession, TheDaysUnnamedGraspsGiveItWhereTheyAreChosen) {
  RecognitionSession day(model());
  const SampleSet today = things(3, -3.0, 5);
  day.choose({OffsetChoice::Kind::kBatch, 0.0});
  for (std::size_t i = 0; i < today.numSamples(); ++i)
    day.add(row(today, i), kTodayUs + static_cast<std::int64_t>(i) * 60'000'000);
  EXPECT_EQ(day.offset().origin, OffsetSource::kBatch);
  EXPECT_NEAR(day.offset().mm, -3.0, 1.0);
  day.choose({OffsetChoice::Kind::kGiven, -3.0});
  EXPECT_EQ(day.offset().mm, -3.0);
  day.choose({OffsetChoice::Kind::kNone, 0.0});
  EXPECT_EQ(day.offset().origin, OffsetSource::kUnknown);
}

TEST(RecognitionSession, AnotherDayForgetsTheLast) {
  RecognitionSession day(model());
  const SampleSet today = things(2, -3.0, 5);
  day.setLabel(day.add(row(today, 0), kTodayUs), today.y[0]);
  EXPECT_EQ(day.add(row(today, 1), kTodayUs + kHourUs), 1u);
  EXPECT_EQ(day.add(row(today, 1), kTodayUs + kHourUs), 1u) << "the same one";
  EXPECT_EQ(day.add(row(today, 2), kTodayUs + 20 * kHourUs), 0u);
  EXPECT_EQ(day.numLabelled(), 0u);
}

TEST(RecognitionSession, WhatDoesNotFitIsRefused) {
  RecognitionSession day(model());
  EXPECT_THROW(day.add({1.0}, 0), std::invalid_argument);
  EXPECT_THROW(day.predict({1.0}, 0), std::invalid_argument);
  EXPECT_THROW(day.setLabel(0, 0), std::out_of_range);
  day.add({20.0, 8.0}, kTodayUs);
  EXPECT_THROW(day.setLabel(0, 5), std::out_of_range);
  RecognitionSession svm(model(ClassifierKind::kSvm));
  svm.add({20.0, 8.0}, kTodayUs);
  EXPECT_THROW(svm.setLabel(0, 0), Error);
  EXPECT_THROW(svm.choose({OffsetChoice::Kind::kBatch, 0.0}), Error);
  EXPECT_NE(svm.unsure(), "");
}

}  // namespace
}  // namespace palpate::recognition_session_test
