// Targets of slip detection (docs/notes/slip.md), tested on synthetic contacts with known motion
// and on the real recordings if they are present.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/laboratory/slip_evaluation.h"
#include "palpate/laboratory/synthetic_slip.h"
#include "palpate/recording/recording.h"
#include "palpate/slip/slip_detector.h"

#include "testing/testing.h"

namespace palpate::slip_targets_test {
namespace {

constexpr int kRest = 40;
constexpr std::int64_t kFrameUs = 31'500;

class Trial {
 public:
  Trial(SlipShape shape, std::uint64_t seed) : random_(seed), slip_(SyntheticSensor{}, seed) {
    std::uniform_real_distribution<double> half(-0.5, 0.5);
    contact.shape = shape;
    contact.x += half(random_);
    contact.y += 2.0 * half(random_);
    if (hasOrientation(shape)) contact.angleDeg = 60.0 * half(random_);
    direction = 6.283185 * half(random_);
  }
  const SlipDetection& read() {
    slip_.read(contact, MatrixMap(values_.data(), 14, 6));
    timeUs_ += kFrameUs;
    return detector_.update(ConstMatrixMap(values_.data(), 14, 6), timeUs_);
  }
  SyntheticContact contact;
  double direction = 0.0;

 private:
  std::mt19937_64 random_;
  SyntheticSlip slip_;
  SlipDetector detector_{MatrixLayout::full(14, 6, 3.4)};
  MatrixValues values_ = MatrixValues::Zero(14, 6);
  std::int64_t timeUs_ = 0;
};

// Largest reported motion, and whether there was an alarm.
struct Tilted {
  double reading = 0.0;
  bool alarm = false;
};
Tilted tilt(SlipShape shape, std::uint64_t seed, int ramp) {
  Trial trial(shape, seed);
  Tilted result;
  for (int i = 0; i < kRest + ramp + 30; ++i) {
    trial.contact.tiltY = (seed % 2 == 0 ? 0.4 : -0.4) *
                          std::clamp((i - kRest) / static_cast<double>(ramp), 0.0, 1.0);
    const SlipDetection& detection = trial.read();
    result.alarm |= detection.slipping;
    if (i > kRest && detection.motion.refValid)
      result.reading =
          std::max(result.reading, std::hypot(detection.motion.refDx, detection.motion.refDy));
  }
  return result;
}

int framesToAlarm(SlipShape shape, std::uint64_t seed, double step, int most) {
  Trial trial(shape, seed);
  for (int i = 0; i < kRest; ++i)
    if (trial.read().slipping) return -1;
  for (int i = 1; i <= most; ++i) {
    trial.contact.x += step * std::cos(trial.direction);
    trial.contact.y += step * std::sin(trial.direction);
    if (trial.read().slipping) return i;
  }
  return most + 1;
}

TEST(SlipTargets, ATiltOfTheLoadIsNoSlip) {
  int alarms = 0, ramps = 0;
  for (const SlipShape shape : slipShapes()) {
    double worst = 0.0;
    for (const int ramp : {2, 5, 12, 25})
      for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const Tilted result = tilt(shape, 1000 + seed, ramp);
        worst = std::max(worst, result.reading);
        alarms += result.alarm ? 1 : 0;
        ++ramps;
      }
    RecordProperty("worst_" + std::string(nameOf(shape)), std::to_string(worst));
    EXPECT_LT(worst, hasEdge(shape) ? 0.1 : 0.2) << nameOf(shape);
  }
  RecordProperty("alarms", alarms);
  EXPECT_LT(alarms, 0.01 * ramps) << alarms << " of " << ramps;
}

TEST(SlipTargets, SlipIsFlaggedWithinThreeFrames) {
  int found = 0, trials = 0;
  for (const SlipShape shape : slipShapes())
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const int frames = framesToAlarm(shape, 2000 + seed, 0.2, 3);
      found += frames >= 1 && frames <= 3 ? 1 : 0;
      ++trials;
    }
  RecordProperty("found", found);
  EXPECT_GE(found, 0.98 * trials) << found << " of " << trials;
}

TEST(SlipTargets, CreepIsFlaggedWithinFortyFrames) {
  int found = 0, trials = 0;
  for (const SlipShape shape : slipShapes())
    for (std::uint64_t seed = 1; seed <= 15; ++seed) {
      const int frames = framesToAlarm(shape, 3000 + seed, 0.05, 40);
      found += frames >= 1 && frames <= 40 ? 1 : 0;
      ++trials;
    }
  RecordProperty("found", found);
  EXPECT_GE(found, 0.98 * trials) << found << " of " << trials;
}

// At most 15 alarms per matrix and hour of settled contact, 90 % of the slips found, and better
// than the plain centroid.
TEST(SlipTargets, RealHoldsAreQuietAndRealSlipsFound) {
  const auto folder = testing::recordingsFolder();
  PALPATE_NEED(folder);
  SlipEvaluation evaluation;
  std::vector<std::filesystem::path> holds;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(*folder / "grasps_by_class"))
    if (entry.path().extension() == ".dsa") holds.push_back(entry.path());
  std::sort(holds.begin(), holds.end());
  for (const auto& path : holds) evaluation.addNoSlipRecording(openRecording(path));
  for (const char* name : {"slip_and_rotation_teapot_handle.dsa", "slip_test.dsa"})
    evaluation.addSlipRecording(openRecording(*folder / "slip-detection" / name));
  const SlipEvaluationReport report = evaluation.report();
  double centroidPerHour = 0.0;
  for (const ScoredAlarm& alarm : report.alarms) {
    const SlipScore& score = alarm.score;
    if (alarm.name == "centroid-step") centroidPerHour = score.perHour(kSettledContact);
    if (alarm.name.starts_with("contest")) {
      EXPECT_LE(score.perHour(kSettledContact), 15.0) << alarm.name;
      EXPECT_GE(score.detectionRate(), 0.9) << alarm.name;
      EXPECT_LT(score.perHour(kSettledContact), centroidPerHour) << alarm.name;
    }
  }
  EXPECT_GT(report.alarms[0].score.slips, 40U);
}

}  // namespace
}  // namespace palpate::slip_targets_test
