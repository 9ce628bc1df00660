// Tests of the limit of a grasp under tactile control: whether it can be measured, the reading
// after the stop, and grasps with an unexpected exception.
#include <stdexcept>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"

#include "control/machine_bench.h"
#include "testing/testing.h"

namespace palpate::grasp_state_machine_limit_test {
namespace {
using testing::kPeriodUs;
using testing::reactive;
using Bench = testing::MachineBench;

// L-M14.
TEST(GraspStateMachine, WhatIsReachedAfterTheStopIsSaidBesideWhatWasAsked) {
  Bench bench;
  bench.begin(reactive(200));
  bench.take();
  bench.frames(1, 250.0F);
  EXPECT_TRUE(bench.takeStop());
  bench.frames(2, 700.0F);  // until the hand has answered
  bench.machine.onStopAcknowledged(bench.us);
  EXPECT_EQ(bench.machine.phase(), GraspPhase::kSettling);
  EXPECT_TRUE(bench.machine.underTactileControl());
  bench.frames(3, 1200.0F);
  bench.frames(3, 1100.0F);
  EXPECT_FALSE(bench.machine.takeReport().has_value());
  bench.lookOn(900.0F);
  EXPECT_FALSE(bench.machine.takeCommand().has_value()) << "nothing moves any more";
  const auto report = bench.machine.takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kLimitReached);
  EXPECT_EQ(report->peak.counts, 250.0F);
  ASSERT_TRUE(report->peakAfterStop.has_value());
  EXPECT_EQ(report->peakAfterStop->counts, 1200.0F);
  EXPECT_EQ(report->text,
            "limit reached: finger 0 distal, x 2, y 3: 250 counts; rose to 1200 after the stop, "
            "6.0 times the limit: close more slowly");
}

// The hand was not closing yet, so it holds nothing and must not close.
TEST(GraspStateMachine, ASlipAwareGraspThatIsOverItsLimitOnTheWayToItsStartEndsThere) {
  Bench bench;
  GraspRequest request = reactive(200);
  request.mode = GraspMode::kSlip;
  request.startRatio = 0.0;
  bench.begin(request);
  bench.take();
  bench.frames(1, 250.0F);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  EXPECT_FALSE(bench.machine.active());
  const auto report = bench.machine.takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kLimitReached);
  bench.lookOn(300.0F);
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  EXPECT_FALSE(bench.machine.active());
}

TEST(GraspStateMachine, LookingOnEndsAtOnceWhenTheUserOrAPortEndsIt) {
  for (int how = 0; how < 4; ++how) {
    Bench bench;
    bench.begin(reactive(200));
    bench.take();
    bench.frames(1, 250.0F);
    EXPECT_TRUE(bench.takeStop());
    bench.machine.onStopAcknowledged(bench.us);
    if (how == 0) bench.machine.stop(bench.us);
    if (how == 1) bench.machine.onMotionPortGone("unplugged", bench.us);
    if (how == 2) bench.machine.onTactilePortGone("unplugged", bench.us);
    if (how == 3) bench.machine.fault("a bug", bench.us);
    EXPECT_FALSE(bench.machine.active()) << how;
    EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kLimitReached) << how;
  }
}

// C-A5, L-M2.
TEST(GraspStateMachine, RefusesALimitThatCannotBeFeltNamingTheMatrix) {
  const std::vector<MatrixSettings> usual = {
      {0.5, 150}, {0.5, 300}, {0.5, 150}, {0.5, 300}, {0.5, 150}, {0.5, 300}};
  const auto refusal = [&](const std::vector<MatrixSettings>& settings, GraspRequest request) {
    Bench bench;
    bench.machine.setSettings(settings);
    try {
      bench.begin(request);
      return std::string();
    } catch (const DeviceError& error) {
      EXPECT_EQ(error.fault(), DeviceFault::kRefused);
      EXPECT_FALSE(bench.machine.takeCommand().has_value());
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refusal(usual, reactive(200)), "");
  auto settings = usual;
  for (MatrixSettings& each : settings) each.thresholdCounts = 4095;
  EXPECT_NE(refusal(settings, reactive(200)).find("finger 0 proximal can't measure it"),
            std::string::npos);
  settings = usual;
  settings[3].sensitivity = 0.0;
  EXPECT_NE(refusal(settings, reactive(200)).find("finger 1 distal can't measure it"),
            std::string::npos)
      << refusal(settings, reactive(200));
  GraspRequest pinch = reactive(200);
  pinch.preshape = "pinch-parallel";  // finger 1 stays folded
  EXPECT_EQ(refusal(settings, pinch), "");
  GraspRequest slip = reactive(200);
  slip.mode = GraspMode::kSlip;
  settings = usual;
  settings[0].thresholdCounts = 2000;  // the first limit can be measured, the highest (2200) can't
  EXPECT_EQ(refusal(settings, reactive(200)), "");
  EXPECT_NE(refusal(settings, slip).find("2200 counts can't be measured"), std::string::npos);
}

TEST(GraspStateMachine, RefusesWhereNoTaxelOfAMatrixIsScanned) {
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[5].dynamicMask.assign(matrices[5].numCells(), 0);
  const auto layout = std::make_shared<const SensorLayout>(SensorLayout(matrices));
  Bench bench;
  for (int i = 0; i < 20; ++i) {
    TactileFrame felt(layout);
    felt.hostUs = 1'700'000'000'000'000 + (bench.us += kPeriodUs);
    bench.machine.onFrame(felt, bench.us);
  }
  try {
    bench.begin(reactive(200));
    FAIL();
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("finger 2 distal can't measure it: no taxel"),
              std::string::npos)
        << error.what();
  }
}

TEST(GraspStateMachine, ASaturatedTaxelIsOverTheHighestLimit) {
  EXPECT_LT(static_cast<float>(kMaxGraspLimitCounts), sdh2().saturationCounts);
  Bench bench;
  bench.begin(reactive(kMaxGraspLimitCounts));
  bench.take();
  bench.frames(1, sdh2().saturationCounts);
  EXPECT_TRUE(bench.takeStop());
  EXPECT_THROW(bench.begin(reactive(3500)), std::invalid_argument);
}

TEST(GraspStateMachine, AFaultStopsWhateverRuns) {
  Bench bench;
  bench.begin({});
  bench.take();
  bench.machine.fault("out of memory", bench.us);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.fault("again", bench.us);
  bench.machine.onStopAcknowledged(bench.us);
  const auto report = bench.machine.takeReport();
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->outcome, GraspOutcome::kFailed);
  EXPECT_EQ(report->text, "failed: out of memory: stopped");
  bench.machine.fault("idle", bench.us);
  EXPECT_FALSE(bench.machine.active());
}

// There is no memory for its text, as for a text longer than any string.
TEST(GraspStateMachine, AFaultThatFindsNoMemoryForItsTextStopsAllTheSame) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "such a text is not an object that a program may have, and the sanitizer says so";
#endif
  Bench bench;
  bench.begin({});
  bench.take();
  const char one = 'x';
  const std::string_view endless(&one, std::string().max_size() + 1);
  EXPECT_THROW(bench.machine.fault(endless, bench.us), std::length_error);
  EXPECT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  EXPECT_EQ(bench.machine.takeReport()->outcome, GraspOutcome::kFailed);
}

}  // namespace
}  // namespace palpate::grasp_state_machine_limit_test
