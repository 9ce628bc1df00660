// Tests the zero adjustment of the empty hand in another session of the emulated hand, after a new
// reference run of the joints. Seven cylinders differ by 4 mm in diameter and in nothing else. One
// touch of the empty hand makes the accuracy as good as in the session of training; without it, a
// hand that measures 4 mm wrong confuses each cylinder with its neighbour.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/emulator/simulated_recording.h"
#include "palpate/recognition/feature_table.h"
#include "palpate/recognition/grasp_features.h"
#include "palpate/recognition/model_evaluation.h"
#include "palpate/recognition/plateau_features.h"
#include "palpate/recognition/trained_model.h"

#include "testing/sdh2.h"

namespace palpate::empty_hand_session_test {
namespace {

constexpr int kThings = 7, kTaught = 10, kTried = 10;
constexpr double kTrainingZero = 0.0;

Scene pinch(double diameterMm) {
  Scene scene;
  SceneObject cylinder;
  cylinder.shape = {ShapeKind::kCylinder, {diameterMm, diameterMm, 120.0}};
  cylinder.positionMm = {19.05, 0.0, 150.0};
  cylinder.stiffnessNPerMm3 = 20.0;
  scene.objects = {cylinder};
  scene.preshape = "pinch-parallel";
  scene.script = {{0.5, GraspAction{std::nullopt, 1.0, 30.0}}, {6.0, ReleaseAction{30.0}}};
  return scene;
}

SimulatedRecordingOptions day(double zeroErrorDeg, std::uint64_t seed) {
  SimulatedRecordingOptions options;
  options.durationS = 8.0;
  options.hand.seed = seed;
  options.hand.zeroErrorDeg = {0, zeroErrorDeg, 0, zeroErrorDeg, 0, zeroErrorDeg, 0};
  return options;
}

FeatureTable grasps(int perThing, const SimulatedRecordingOptions& options) {
  FeatureTable table;
  table.names = featureNames(FeatureSet::kBest, sdh2());
  for (int thing = 0; thing < kThings; ++thing) {
    const Profile profile = simulateGrasps(pinch(12.0 + 4.0 * thing), perThing, {}, options);
    RecordingFeatures found = recordingFeatures(profile, FeatureSet::kBest);
    for (GraspFeatures& grasp : found.grasps)
      if (grasp.problem.empty()) {
        FeatureRow row;
        row.className = std::string(1, static_cast<char>('a' + thing));
        row.timeUs = profile.frameTimeUs(grasp.begin);
        row.values = std::move(grasp.values);
        table.rows.push_back(std::move(row));
      }
  }
  return table;
}

EmptyHandZero touch(double zeroErrorDeg, std::uint64_t seed) {
  Scene scene;
  scene.preshape = "pinch-empty";
  scene.script = {{0.5, GraspAction{std::nullopt, 1.0, 30.0}}};
  SimulatedRecordingOptions options = day(zeroErrorDeg, seed);
  options.durationS = 9.0;
  return emptyHandZero(simulateRecording(scene, options));
}

struct Tried {
  SampleSet samples;
  std::vector<std::int64_t> times;
};

Tried tried(const TrainedModel& model, double zeroErrorDeg, std::uint64_t seed) {
  const FeatureTable table = grasps(kTried, day(zeroErrorDeg, seed));
  Tried out{samplesOf(table, model.classes), {}};
  for (const FeatureRow& row : table.rows) out.times.push_back(row.timeUs);
  return out;
}

double shareRight(const TrainedModel& model, const Tried& of, const char* offset) {
  return evaluateModel(model, of.samples, of.times, {0, OffsetChoice::from(offset)})
      .confusion.accuracy();
}

// Accuracy when the session contains one object only, for each object by itself.
double shareRightAlone(const TrainedModel& model, const Tried& of, const char* offset) {
  double right = 0.0;
  for (int thing = 0; thing < kThings; ++thing) {
    std::vector<std::size_t> those;
    std::vector<std::int64_t> times;
    for (std::size_t i = 0; i < of.samples.y.size(); ++i)
      if (of.samples.y[i] == thing) {
        those.push_back(i);
        times.push_back(of.times[i]);
      }
    const auto one =
        evaluateModel(model, of.samples.rows(those), times, {0, OffsetChoice::from(offset)});
    right += static_cast<double>(one.confusion.right());
  }
  return right / static_cast<double>(of.samples.y.size());
}

double meanSizeMm(const Tried& of) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < of.samples.x.rows(); ++i) sum += distanceOfSizeZ(of.samples.x(i, 0));
  return sum / static_cast<double>(of.samples.x.rows());
}

TEST(EmptyHandDay, OneTouchMakesAnotherDayAsGoodAsTheFirst) {
  PipelineOptions options;
  options.classifier = ClassifierKind::kGauss;
  TrainedModel model = trainModel(
      samplesOf(grasps(kTaught, day(kTrainingZero, 100))), FeatureSet::kBest, "s", options);
  model.trainingZero = touch(kTrainingZero, 100);
  ASSERT_EQ(model.trainingZero->problem, "");
  ASSERT_EQ(model.features.front(), "size_z");
  const Tried first = tried(model, kTrainingZero, 300);
  const double sameDay = shareRight(model, first, "model");
  EXPECT_GT(sameDay, 0.95);
  const std::vector<double> errorsDeg = {-1.0, -0.5, 0.7, 1.0};
  double ofAllDays = 0.0;
  for (const double errorDeg : errorsDeg) {
    const Tried today = tried(model, errorDeg, 300);
    TrainedModel adapted = model;
    adaptToEmptyHand(adapted, touch(errorDeg, 500));
    const double trueMm = meanSizeMm(today) - meanSizeMm(first);
    const double zero = shareRight(adapted, today, "model"),
                 zeroAlone = shareRightAlone(adapted, today, "model"),
                 fresh = shareRight(model, today, "model"), none = shareRight(model, today, "none"),
                 batch = shareRight(model, today, "batch"),
                 batchAlone = shareRightAlone(model, today, "batch");
    std::printf(
        "  offset %.2f mm, by the touch %.2f +- %.2f; same day %.3f; fresh %.3f, none %.3f, batch "
        "%.3f (one thing at a time %.3f), empty hand %.3f (%.3f)\n",
        trueMm,
        adapted.offset.mm,
        adapted.offset.sdMm,
        sameDay,
        fresh,
        none,
        batch,
        batchAlone,
        zero,
        zeroAlone);
    EXPECT_GT(std::abs(trueMm), 1.5) << "another day it is";
    EXPECT_NEAR(adapted.offset.mm, trueMm, 2.0 * adapted.offset.sdMm);
    EXPECT_TRUE(adapted.offset.trusted);
    EXPECT_GE(zero, 0.93) << errorDeg;
    ofAllDays += zero / static_cast<double>(errorsDeg.size());
    EXPECT_EQ(zeroAlone, zero) << "it needs no other object";
    EXPECT_LT(fresh, 0.7);
    EXPECT_LT(none, zero);
  }
  EXPECT_GE(ofAllDays, 0.96);
  EXPECT_GE(ofAllDays, sameDay - 0.03);
}

}  // namespace
}  // namespace palpate::empty_hand_session_test
