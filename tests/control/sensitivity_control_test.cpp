#include "palpate/control/sensitivity_control.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/device/sdh2.h"

#include "calibration/sample_calibrations.h"
#include "control/emulated_bench.h"
#include "control/scripted_hand.h"
#include "testing/testing.h"

namespace palpate::sensitivity_control_test {
namespace {
using namespace testing;

// Test bench: a hand that executes every command at once, and its SensitivityControl, on the test's
// clock.
struct SensitivityBench {
  GraspBench bench;
  SensitivityControl control{*bench.session, *bench.control, bench.clock};
  std::size_t heeded = 0;

  SensitivityBench() { bench.hand->says.matrices.assign(6, {0.5, 200}); }
  // Applies the received commands to the settings that the hand reports.
  void obey() {
    auto& matrices = bench.hand->says.matrices;
    for (; heeded < bench.hand->commands.size(); ++heeded) {
      const DeviceCommand& command = bench.hand->commands[heeded];
      for (std::size_t m = 0; m < matrices.size(); ++m) {
        if (const auto* set = std::get_if<SetThreshold>(&command))
          if (!set->matrix || static_cast<std::size_t>(*set->matrix) == m)
            matrices[m].thresholdCounts = set->counts;
        if (const auto* set = std::get_if<SetSensitivity>(&command))
          if (!set->matrix || static_cast<std::size_t>(*set->matrix) == m)
            matrices[m].sensitivity = set->sensitivity;
      }
    }
  }
  // Sends frames with a period and calls step() after every eighth; readings follow the
  // sensitivity.
  void run(double seconds, std::int64_t periodUs, double gain, double degC) {
    const auto frames = static_cast<int>(seconds * 1e6 / static_cast<double>(periodUs));
    for (int i = 0; i < frames; ++i) {
      bench.clock.pass(periodUs);
      const std::int64_t now = bench.clock.hostUs();
      if (i % 16 == 0) bench.hand->temperatures(degC, now);
      TactileFrame frame(sdh2().layout);
      frame.hostUs = now;
      const MatrixSettings& is = bench.hand->says.matrices[1];
      const double reading = is.sensitivity * gain - is.thresholdCounts;
      frame.values[100] = static_cast<float>(std::clamp(reading, 0.0, 4095.0));
      bench.hand->sink->onFrame(std::move(frame));
      if (i % 8 == 7) {
        bench.control->step();
        control.step();
        obey();
      }
    }
  }
  const TactileSettings& settings() const { return bench.hand->says.matrices; }
};

constexpr std::int64_t kPeriodUs = 31'500;

TEST(SensitivityControl, HighSensitivityPutsThresholdsAboveTheNoiseAndFollowsTheTemperature) {
  SensitivityBench bench;
  bench.control.beginHighSensitivity(evenNoise(0.5, 30.0, 2.0));
  EXPECT_TRUE(bench.control.status().measuring);
  bench.run(2.0, kPeriodUs, 0.0, 30.0);
  EXPECT_FALSE(bench.control.status().measuring);
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_EQ(bench.settings()[m].sensitivity, 1.0);
    // 30 + m + 0.5 * 30 + 3 * 2
    EXPECT_EQ(bench.settings()[m].thresholdCounts, 51 + static_cast<int>(m));
  }
  bench.run(20.0, kPeriodUs, 0.0, 44.0);
  for (std::size_t m = 0; m < 6; ++m)
    EXPECT_EQ(bench.settings()[m].thresholdCounts, 58 + static_cast<int>(m));
  EXPECT_TRUE(bench.control.status().noise.extrapolated.empty());
  bench.run(20.0, kPeriodUs, 0.0, 70.0);
  EXPECT_EQ(bench.control.status().noise.extrapolated.size(), 6u);
}

TEST(SensitivityControl, TheGuardRaisesThresholdsWhenTheRateCollapses) {
  SensitivityBench bench;
  bench.control.beginHighSensitivity(evenNoise(0.5, 30.0, 2.0));
  bench.run(3.0, kPeriodUs, 0.0, 30.0);
  EXPECT_EQ(bench.settings()[0].thresholdCounts, 51);
  bench.run(6.0, 3 * kPeriodUs, 0.0, 30.0);
  EXPECT_TRUE(bench.control.status().noise.guarding);
  EXPECT_GE(bench.settings()[0].thresholdCounts, 61);
  // A pause, for instance for a setting, must not count as a low rate.
  SensitivityBench paused;
  paused.control.beginHighSensitivity(evenNoise(0.5, 30.0, 2.0));
  paused.run(3.0, kPeriodUs, 0.0, 30.0);
  for (int i = 0; i < 10; ++i) {
    paused.bench.clock.pass(700'000);
    const std::int64_t now = paused.bench.clock.hostUs();
    paused.bench.session->note({now, now, "settings", std::nullopt, "changed", ""});
    paused.run(0.5, kPeriodUs, 0.0, 30.0);
  }
  EXPECT_FALSE(paused.control.status().noise.guarding);
}

TEST(SensitivityControl, WaitsWhileFingersMoveUnderTactileControl) {
  SensitivityBench bench;
  bench.control.beginHighSensitivity(evenNoise(0.5, 30.0, 2.0));
  bench.run(0.2, kPeriodUs, 0.0, 30.0);
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.closeRatio = 1.0;
  request.limitCounts = 500;
  bench.bench.feel(3);
  bench.bench.control->grasp(request);
  bench.bench.hand->states.assign(7, 1);
  bench.run(2.0, kPeriodUs, 0.0, 30.0);
  EXPECT_EQ(bench.settings()[0].sensitivity, 0.5) << "nothing was set";
  EXPECT_NE(bench.control.status().waiting, "");
  bench.bench.control->stop();
  bench.bench.hand->states.assign(7, 0);
  bench.run(2.0, kPeriodUs, 0.0, 30.0);
  EXPECT_EQ(bench.settings()[0].sensitivity, 1.0);
  EXPECT_EQ(bench.control.status().waiting, "");
}

TEST(SensitivityControl, AdaptiveFindsTheHighestThatDoesNotSaturate) {
  // Readings are s * gain - 200: at gain 5000 the target of 3150 counts needs s = 0.67.
  SensitivityBench bench;
  bench.control.beginAdaptiveSensitivity();
  bench.run(30.0, kPeriodUs, 5000.0, 30.0);
  EXPECT_TRUE(bench.control.status().settled);
  EXPECT_NEAR(bench.settings()[1].sensitivity, 0.67, 0.04);
  const double reading = bench.settings()[1].sensitivity * 5000.0 - 200.0;
  EXPECT_LT(reading, 3500.0);
  EXPECT_GT(reading, 2800.0);
  // A larger load saturates, so the sensitivity is lowered at once.
  bench.run(30.0, kPeriodUs, 9000.0, 30.0);
  EXPECT_LT(bench.settings()[1].sensitivity * 9000.0 - 200.0, 3500.0);
  for (const MatrixSettings& matrix : bench.settings()) EXPECT_EQ(matrix.thresholdCounts, 200);
}

TEST(SensitivityControl, LettingGoLeavesAndResetBringsBack) {
  SensitivityBench bench;
  bench.control.beginHighSensitivity(evenNoise(0.5, 30.0, 2.0));
  bench.run(3.0, kPeriodUs, 0.0, 30.0);
  bench.control.endMode();
  bench.run(15.0, kPeriodUs, 0.0, 50.0);
  EXPECT_EQ(bench.settings()[0].thresholdCounts, 51);
  EXPECT_EQ(bench.control.status().mode, SensitivityMode::kManual);
  bench.control.reset();
  bench.run(0.5, kPeriodUs, 0.0, 50.0);
  const TactileSettings expected = defaultTactileSettings(sdh2());
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_EQ(bench.settings()[m].sensitivity, expected[m].sensitivity);
    EXPECT_EQ(bench.settings()[m].thresholdCounts, expected[m].thresholdCounts);
  }
}

TEST(SensitivityControl, SaysWhatIsMissing) {
  SensitivityBench bench;
  NoiseFloor none = evenNoise(0.5, 30.0, 2.0);
  for (NoiseLine& line : none.lines) line.valid = false;
  EXPECT_THROW(bench.control.beginHighSensitivity(none), std::invalid_argument);
  NoiseFloor other = evenNoise(0.5, 30.0, 2.0);
  other.lines.back().matrix = 6;
  EXPECT_THROW(bench.control.beginHighSensitivity(other), std::invalid_argument);
  EXPECT_EQ(bench.control.status().mode, SensitivityMode::kManual);
  bench.bench.hand->says.matrices.clear();
  bench.control.beginAdaptiveSensitivity();
  bench.bench.clock.pass(1000);
  bench.control.step();
  EXPECT_EQ(bench.control.status().waiting, "no tactile controller is connected");
}

// Over its ports and with its own sensor model: settings are read back from the controller.
TEST(SensitivityControl, OnTheEmulatedHand) {
  EmulatedBench bench(handWith("empty"));
  bench.connect();
  SensitivityControl control(*bench.session, *bench.control);
  control.beginHighSensitivity(evenNoise(0.3, 40.0, 2.0));
  const auto set = [&] {
    control.step();
    const TactileSettings now = bench.session->device().info().matrices;
    return !now.empty() && now[0].sensitivity == 1.0 && now[0].thresholdCounts < 100 &&
           !control.status().setting;
  };
  EXPECT_TRUE(eventuallyTrue(set)) << control.status().waiting << control.status().failure;
  control.reset();
  const auto back = [&] {
    control.step();
    const TactileSettings now = bench.session->device().info().matrices;
    return now[0].sensitivity == 0.5 && now[0].thresholdCounts == 150 &&
           now[1].thresholdCounts == 300;
  };
  EXPECT_TRUE(eventuallyTrue(back));
}

}  // namespace
}  // namespace palpate::sensitivity_control_test
