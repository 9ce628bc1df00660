// Tests of the limit of a grasp under tactile control: whether it can be measured, the reading
// after the stop, and grasps with an unexpected exception.
#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/laboratory/synthetic_slip.h"

#include "calibration/sample_calibrations.h"
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
  EXPECT_EQ(
      report->text,
      "limit reached: finger 0 distal, x 2, y 3: 250 counts; rose to 1200 counts after the stop, "
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

TEST(GraspStateMachine, AFingerWithALowerLimitStopsTheHandAtIt) {
  for (const bool lower : {true, false}) {
    Bench bench;
    GraspRequest request = reactive(800);
    request.fingerLimitCounts = {800, 300, 800};
    bench.begin(request);
    bench.take();
    // Matrix 3 is on finger 1, matrix 1 on finger 0; the largest reading is on finger 0.
    bench.us += kPeriodUs;
    TactileFrame felt(sdh2().layout);
    felt.hostUs = 1'700'000'000'000'000 + bench.us;
    felt.matrix(1)(3, 2) = 700.0F;
    felt.matrix(3)(5, 1) = lower ? 301.0F : 300.0F;
    bench.machine.onFrame(felt, bench.us);
    EXPECT_EQ(bench.takeStop(), lower);
    if (!lower) continue;
    EXPECT_EQ(bench.machine.running().text, "limit reached: finger 1 distal, x 1, y 5: 301 counts");
  }
}

TEST(GraspStateMachine, RefusesAGraspWhoseFingerIsOverItsOwnLimit) {
  Bench bench;
  bench.frames(1, 250.0F);  // matrix 1: finger 0
  GraspRequest request = reactive(800);
  request.fingerLimitCounts = {200, 800, 800};
  EXPECT_THROW(bench.begin(request), DeviceError);
  EXPECT_FALSE(bench.machine.takeCommand().has_value());
  request.fingerLimitCounts = {800, 200, 800};
  EXPECT_NO_THROW(bench.begin(request));
}

Calibration kiloPascals() { return testing::linearCalibration({0.5, 100.0, false}); }

TEST(GraspStateMachine, ALimitInNewtonsStopsTheHandAtTheForce) {
  Bench bench;
  bench.machine.setCalibration(kiloPascals());
  bench.machine.setSettings(std::vector<MatrixSettings>(6, {0.5, 100}));
  GraspRequest request = reactive(3000);
  request.forceLimitsN = {5.0};
  bench.begin(request);
  bench.take();
  FingerForces expected(kiloPascals(), sdh2(), std::vector<MatrixSettings>(6, {0.5, 100}));
  int frames = 0;
  double before = 0.0, now = 0.0;
  bool stopped = false;
  for (float counts = 10.0F; !stopped && counts < 2000.0F; counts += 10.0F, ++frames) {
    bench.us += kPeriodUs;
    TactileFrame felt(sdh2().layout);
    felt.hostUs = 1'700'000'000'000'000 + bench.us;
    felt.matrix(4).setConstant(counts);  // finger 2
    expected.apply(felt, {});
    before = now;
    now = expected.forcesN()[2];
    bench.machine.onFrame(felt, bench.us);
    stopped = bench.takeStop();
  }
  EXPECT_TRUE(stopped);
  EXPECT_LE(before, 5.0);
  EXPECT_GT(now, 5.0);
  const GraspReport& report = bench.machine.running();
  EXPECT_TRUE(report.text.starts_with("limit reached: finger 2: 5.")) << report.text;
  EXPECT_EQ(report.forceFinger, 2u);
  EXPECT_EQ(report.forceN, now);
  // It goes on rising after the stop: said in newtons, as the limit was.
  bench.machine.onStopAcknowledged(bench.us);
  double highest = now;
  for (int i = 0; i < 17; ++i) {
    bench.us += kPeriodUs;
    TactileFrame felt(sdh2().layout);
    felt.hostUs = 1'700'000'000'000'000 + bench.us;
    felt.matrix(4).setConstant(3000.0F);
    expected.apply(felt, {});
    highest = std::max(highest, expected.forcesN()[2]);
    bench.machine.onFrame(felt, bench.us);
    bench.machine.onTime(bench.us);
  }
  const auto ended = bench.machine.takeReport();
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->forceAfterStopN, highest);
  ASSERT_GT(highest, 1.5 * 5.0);
  std::array<char, 128> rise{};
  std::snprintf(rise.data(),
                rise.size(),
                "; rose to %.1f N (3000 counts) after the stop, %.1f times the limit: close more "
                "slowly",
                highest,
                highest / 5.0);
  EXPECT_TRUE(ended->text.ends_with(rise.data())) << ended->text;
}

// A finger pressed with `counts` on all taxels of a matrix, and its force.
struct PressedFinger {
  Bench bench;
  FingerForces expected{kiloPascals(), sdh2(), std::vector<MatrixSettings>(6, {0.5, 100})};

  PressedFinger() {
    bench.machine.setCalibration(kiloPascals());
    bench.machine.setSettings(std::vector<MatrixSettings>(6, {0.5, 100}));
  }
  double press(float counts) {
    bench.us += kPeriodUs;
    TactileFrame felt(sdh2().layout);
    felt.hostUs = 1'700'000'000'000'000 + bench.us;
    felt.matrix(4).setConstant(counts);  // finger 2
    expected.apply(felt, {});
    bench.machine.onFrame(felt, bench.us);
    bench.machine.onTime(bench.us);
    return expected.forcesN()[2];
  }
};

TEST(GraspStateMachine, AForceThatRisesOverItsLimitAfterAStopByCountsIsSaid) {
  PressedFinger finger;
  GraspRequest request = reactive(50);
  request.forceLimitsN = {10.0};
  finger.bench.begin(request);
  finger.bench.take();
  EXPECT_LT(finger.press(60.0F), 10.0);
  ASSERT_TRUE(finger.bench.takeStop());
  finger.bench.machine.onStopAcknowledged(finger.bench.us);
  double forceN = 0.0;
  std::optional<GraspReport> ended;
  for (int i = 0; i < 40 && !ended; ++i) {
    forceN = finger.press(2000.0F);
    ended = finger.bench.machine.takeReport();
  }
  ASSERT_TRUE(ended);
  ASSERT_GT(forceN, 10.0);
  std::array<char, 96> over{};
  std::snprintf(over.data(), over.size(), "; finger 2: %.2f N, above its limit of 10 N", forceN);
  EXPECT_NE(ended->text.find(over.data()), std::string::npos) << ended->text;
}

TEST(GraspStateMachine, AHandThatMayLoosenOpensToTheLimitInNewtons) {
  for (const bool mayLoosen : {true, false}) {
    PressedFinger finger;
    GraspRequest request = reactive(50);
    request.mode = GraspMode::kSlip;
    request.forceLimitsN = {5.0};
    request.holding.loosen = mayLoosen;
    request.holding.noSlipS = 1.0;
    finger.bench.begin(request);
    finger.bench.take();
    finger.press(60.0F);
    ASSERT_TRUE(finger.bench.takeStop());
    finger.bench.machine.onStopAcknowledged(finger.bench.us);
    for (int i = 0; i < 20; ++i) finger.press(2000.0F);
    ASSERT_EQ(finger.bench.machine.phase(), GraspPhase::kHolding);
    EXPECT_NE(finger.bench.machine.holdingText(finger.bench.us).find("above its limit of 5 N"),
              std::string::npos);
    for (int i = 0; i < 40; ++i) finger.press(2000.0F);
    const auto command = finger.bench.machine.takeCommand();
    ASSERT_EQ(command.has_value(), mayLoosen);
    if (!mayLoosen) continue;
    EXPECT_TRUE(std::holds_alternative<MoveJoints>(*command));
    EXPECT_EQ(finger.bench.machine.phase(), GraspPhase::kLoosening);
    finger.bench.machine.onMoveAcknowledged(20.0, finger.bench.us);
    bool stopped = false;
    double forceN = 0.0, before = 0.0;
    for (float counts = 2000.0F; !stopped && counts > 0.0F; counts -= 20.0F) {
      before = forceN;
      forceN = finger.press(counts);
      stopped = finger.bench.takeStop();
    }
    ASSERT_TRUE(stopped);
    EXPECT_GT(before, 5.0);
    EXPECT_LE(forceN, 5.0);
  }
}

// What slips at its limit in newtons can't be held harder; opening again would lose it.
TEST(GraspStateMachine, AHandThatSlippedAtItsLimitInNewtonsLoosensNoMore) {
  Bench bench;
  bench.machine.setCalibration(kiloPascals());
  bench.machine.setSettings(std::vector<MatrixSettings>(6, {0.5, 100}));
  SyntheticSensor sensor;
  sensor.layout = sdh2().layout->matrix(3);  // finger 1
  SyntheticSlip slip(sensor);
  SyntheticContact contact;
  contact.shape = SlipShape::kFlatEllipse;
  contact.y = 6.0;
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i) {
      bench.us += kPeriodUs;
      TactileFrame felt(sdh2().layout);
      felt.hostUs = 1'700'000'000'000'000 + bench.us;
      slip.read(contact, felt.matrix(3));
      bench.machine.onFrame(felt, bench.us);
      bench.machine.onTime(bench.us);
    }
  };
  GraspRequest request = reactive(50);
  request.mode = GraspMode::kSlip;
  request.forceLimitsN = {0.2};
  request.holding.loosen = true;
  request.holding.noSlipS = 1.0;
  bench.begin(request);
  bench.take();
  frames(1);
  ASSERT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  frames(60);
  ASSERT_EQ(bench.machine.phase(), GraspPhase::kLoosening);
  bench.take();
  for (int i = 0; i < 7 && bench.machine.phase() == GraspPhase::kLoosening; ++i) {
    contact.y += 0.1;
    frames(1);
  }
  ASSERT_TRUE(bench.takeStop());
  bench.machine.onStopAcknowledged(bench.us);
  frames(200);
  ASSERT_EQ(bench.machine.phase(), GraspPhase::kHolding);
  EXPECT_NE(bench.machine.holdingText(bench.us).find("above its limit of 0.2 N"), std::string::npos)
      << bench.machine.holdingText(bench.us);
  EXPECT_FALSE(bench.machine.takeCommand().has_value()) << "neither opened nor closed";
}

TEST(GraspStateMachine, RefusesALimitInNewtonsThatItCannotMeasure) {
  Bench bench;
  GraspRequest request = reactive(3000);
  request.forceLimitsN = {5.0};
  const auto refusal = [&] {
    try {
      bench.begin(request);
    } catch (const DeviceError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal().find("needs a calibration"), std::string::npos) << refusal();
  Calibration another = kiloPascals();
  another.hand = "another";
  bench.machine.setCalibration(another);
  EXPECT_NE(refusal().find("is for another hand: another"), std::string::npos) << refusal();
  Calibration half = kiloPascals();
  half.pressure.areaFraction = 0.5;  // saturated: 352 kPa on 1873 mm^2, half of it
  bench.machine.setCalibration(half);
  request.forceLimitsN = {1.0, 1.0, 340.0};
  EXPECT_NE(refusal().find("would not be felt: finger 2 measures no more than"), std::string::npos)
      << refusal();
  bench.us += kPeriodUs;
  TactileFrame felt(sdh2().layout);
  felt.hostUs = 1'700'000'000'000'000 + bench.us;
  felt.matrix(0).setConstant(400.0F);
  bench.machine.onFrame(felt, bench.us);
  request.forceLimitsN = {5.0};
  EXPECT_NE(refusal().find("over the limit of 5 N already, at finger 0"), std::string::npos)
      << refusal();
  EXPECT_FALSE(bench.machine.takeCommand().has_value()) << "nothing was sent";
}

TEST(GraspStateMachine, AMotionToJointAnglesUnderTactileControlStopsAtAContact) {
  Bench bench;
  GraspRequest request = reactive(200);
  request.targetDeg.assign(7, std::nullopt);
  request.targetDeg[4] = 10.0;
  EXPECT_THROW(bench.begin(request), std::invalid_argument) << "the present angles are not known";
  bench.machine.onAngles({60, -75, 75, -75, 75, -75, 75}, 0);
  bench.begin(request);
  EXPECT_EQ(bench.take().targetDeg, (std::vector<double>{60, -75, 75, -75, 10, -75, 75}));
  bench.frames(1, 250.0F);
  EXPECT_TRUE(bench.takeStop());
}

}  // namespace
}  // namespace palpate::grasp_state_machine_limit_test
