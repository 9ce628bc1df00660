#include "palpate/live/live_measurement.h"

#include <limits>
#include <stdexcept>

#include "palpate/device/sdh2.h"

#include "testing/testing.h"

namespace palpate::live_measurement_test {
namespace {

using State = LiveMeasurement::State;
constexpr std::int64_t kBeginUs = 1'400'000'000'000'000;
constexpr std::int64_t kPeriodUs = 100'000;  // 10 frames/s

SharedFrame frameAt(std::int64_t us, float value = 0.0F, const HandDescription& hand = sdh2()) {
  TactileFrame frame(hand.layout);
  frame.hostUs = kBeginUs + us;
  frame.matrix(1)(7, 2) = value;
  return std::make_shared<const TactileFrame>(std::move(frame));
}

Sample anglesAt(std::int64_t us, double deg) {
  return {kBeginUs + us, std::vector<double>(sdh2().axes.size(), deg)};
}

Event eventOf(const std::string& kind, const std::string& json = {}) {
  return {kBeginUs, kBeginUs, kind, std::nullopt, "what happened", json};
}

void addFrames(LiveMeasurement& measurement, int from, int to, float value = 0.0F) {
  for (int i = from; i < to; ++i) measurement.add(frameAt(i * kPeriodUs, value));
}

TEST(LiveMeasurement, EndsWithTheFirstFrameAfterItsTime) {
  LiveMeasurement measurement(sdh2(), {.seconds = 2.0});
  EXPECT_EQ(measurement.state(), State::kRunning);
  EXPECT_DOUBLE_EQ(measurement.secondsLeft(), 2.0);
  EXPECT_EQ(measurement.numScanned(), sdh2().layout->numTaxels());
  addFrames(measurement, 0, 20);
  EXPECT_EQ(measurement.state(), State::kRunning);
  EXPECT_NEAR(measurement.secondsLeft(), 0.1, 1e-9);
  addFrames(measurement, 20, 40);
  ASSERT_EQ(measurement.state(), State::kComplete);
  EXPECT_EQ(measurement.numFrames(), 21u) << "0 to 2.0 s, both included; nothing after it";
  EXPECT_EQ(measurement.secondsLeft(), 0.0);
  EXPECT_TRUE(measurement.warnings().empty());
}

TEST(LiveMeasurement, TheProfileHasWhatArrived) {
  LiveMeasurement measurement(sdh2(), {.seconds = 1.0});
  const std::size_t sensors = sdh2().temperatureSensors.size();
  for (int i = 0; i <= 10; ++i) {
    measurement.add(
        Sample{kBeginUs + i * kPeriodUs, std::vector(sensors, 20.0 + i), kTemperatureSeries});
    measurement.add(anglesAt(i * kPeriodUs, 5.0));
    measurement.add(frameAt(i * kPeriodUs, static_cast<float>(i)));
  }
  ProfileInfo info;
  info.serial = "1D9B0057";
  const Profile profile = measurement.takeProfile(info);
  ASSERT_EQ(profile.numFrames(), 11u);
  EXPECT_EQ(profile.frameTimeUs(10), kBeginUs + 1'000'000);
  EXPECT_EQ(std::as_const(profile).frame(7).matrix(1)(7, 2), 7.0F);
  EXPECT_EQ(profile.numAngles(), 11u);
  ASSERT_TRUE(profile.temperaturesAtFrame(4));
  EXPECT_EQ(profile.temperaturesAtFrame(4)->values.at(0), 24.0);
  EXPECT_EQ(profile.info().serial, "1D9B0057");
  EXPECT_EQ(profile.info().format, kLiveMeasurementFormat);
  EXPECT_EQ(profile.hand().name, sdh2().name);
  EXPECT_THROW(measurement.takeProfile(), std::logic_error) << "once only";
}

TEST(LiveMeasurement, AGapEndsIt) {
  LiveMeasurement measurement(sdh2(), {.seconds = 10.0});
  addFrames(measurement, 0, 10);
  measurement.add(frameAt(10 * kPeriodUs + 1'500'000));
  EXPECT_EQ(measurement.state(), State::kFailed);
  EXPECT_EQ(measurement.failure(), "no frames for 1.6 s");
  addFrames(measurement, 40, 200);
  EXPECT_EQ(measurement.numFrames(), 10u) << "nothing is added any more";
  EXPECT_THROW(measurement.takeProfile(), std::logic_error);
}

TEST(LiveMeasurement, ASilentDeviceEndsIt) {
  LiveMeasurement none(sdh2());
  none.noteSilence(4.9);
  EXPECT_EQ(none.state(), State::kRunning);
  none.noteSilence(5.1);
  EXPECT_EQ(none.state(), State::kFailed);
  EXPECT_EQ(none.failure(), "no frames for 5.1 s");
  EXPECT_EQ(none.numFrames(), 0u);
  LiveMeasurement stopped(sdh2());
  addFrames(stopped, 0, 10);
  stopped.noteSilence(0.9);
  EXPECT_EQ(stopped.state(), State::kRunning) << "the shortest gap is 1 s";
  stopped.noteSilence(1.1);
  EXPECT_EQ(stopped.state(), State::kFailed);
}

// 2 s between frames: five of these are no gap.
TEST(LiveMeasurement, ASlowDeviceIsNotSilent) {
  LiveMeasurement measurement(sdh2(), {.seconds = 30.0});
  for (int i = 0; i < 10; ++i) measurement.add(frameAt(i * 2'000'000LL));
  measurement.noteSilence(9.0);
  EXPECT_EQ(measurement.state(), State::kRunning);
  measurement.noteSilence(11.0);
  EXPECT_EQ(measurement.state(), State::kFailed);
}

TEST(LiveMeasurement, OtherTaxelsEndIt) {
  LiveMeasurement measurement(sdh2());
  addFrames(measurement, 0, 3);
  // The same taxels in another object are no change.
  HandDescription same = sdh2();
  same.layout = std::make_shared<const SensorLayout>(*sdh2().layout);
  measurement.add(frameAt(3 * kPeriodUs, 0.0F, same));
  EXPECT_EQ(measurement.state(), State::kRunning);
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[2].dynamicMask[5] = 0;
  HandDescription masked = sdh2();
  masked.layout = std::make_shared<const SensorLayout>(matrices);
  measurement.add(frameAt(4 * kPeriodUs, 0.0F, masked));
  EXPECT_EQ(measurement.state(), State::kFailed);
  EXPECT_EQ(measurement.failure(), "the scanned taxels differ from those at the start");
  EXPECT_EQ(LiveMeasurement(masked).numScanned(), sdh2().layout->numTaxels() - 1);
}

TEST(LiveMeasurement, AMovingHandEndsIt) {
  LiveMeasurement measurement(sdh2());
  measurement.add(anglesAt(0, 10.0));
  measurement.add(anglesAt(kPeriodUs, 10.9));
  EXPECT_EQ(measurement.state(), State::kRunning);
  measurement.add(anglesAt(2 * kPeriodUs, 11.5));
  EXPECT_EQ(measurement.state(), State::kFailed);
  EXPECT_EQ(measurement.failure(), "the hand moved: " + sdh2().axes[0].name + " by 1.5 deg");
  LiveMeasurement commanded(sdh2());
  commanded.add(eventOf("motion"));
  EXPECT_EQ(commanded.failure(), "the hand was commanded: what happened");
}

TEST(LiveMeasurement, OtherSettingsEndIt) {
  LiveMeasurement measurement(sdh2());
  addFrames(measurement, 0, 3);
  measurement.add(eventOf("settings"));
  EXPECT_EQ(measurement.state(), State::kFailed);
  EXPECT_EQ(measurement.failure(), "the sensor's settings were changed");
}

TEST(LiveMeasurement, LostAndUnusableFramesAreNamed) {
  LiveMeasurement measurement(sdh2(), {.seconds = 1.0});
  addFrames(measurement, 0, 5);
  measurement.add(eventOf("gap", R"({"seconds": 0.6, "lost": 6, "estimated": true})"));
  measurement.add(eventOf("gap", R"({"stream": "tactile", "lost": 1, "reason": "r"})"));
  measurement.add(eventOf("gap", R"({"stream": "angles", "lost": 50, "reason": "r"})"));
  measurement.add(eventOf("gap", "no JSON"));
  measurement.add(eventOf("gap", R"({"seconds": 0.6})"));
  measurement.add(eventOf("mark"));
  measurement.add(frameAt(2 * kPeriodUs));  // not later
  measurement.add(frameAt(6 * kPeriodUs, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(measurement.numLost(), 7u);
  EXPECT_EQ(measurement.numUnusable(), 2u);
  addFrames(measurement, 7, 11);
  ASSERT_EQ(measurement.state(), State::kComplete);
  const Profile profile = measurement.takeProfile();
  EXPECT_EQ(profile.numFrames(), 9u);
  EXPECT_EQ(profile.info().warnings,
            (std::vector<std::string>{"7 frames were lost",
                                      "2 frames without a valid time or value left out"}));
}

TEST(LiveMeasurement, IsCancelledOnce) {
  LiveMeasurement measurement(sdh2());
  addFrames(measurement, 0, 3);
  measurement.fail("cancelled");
  measurement.fail("disconnected");
  EXPECT_EQ(measurement.failure(), "cancelled");
  EXPECT_THROW(measurement.takeProfile(), std::logic_error);
}

TEST(LiveMeasurement, RefusesImpossibleOptions) {
  EXPECT_THROW(LiveMeasurement(sdh2(), {.seconds = 0.5}), std::invalid_argument);
  EXPECT_THROW(LiveMeasurement(sdh2(), {.seconds = 3601.0}), std::invalid_argument);
  EXPECT_THROW(LiveMeasurement(sdh2(), {.seconds = std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
  EXPECT_THROW(LiveMeasurement(sdh2(), {.maxTravelDeg = 0.0}), std::invalid_argument);
  EXPECT_THROW(LiveMeasurement(sdh2(), {.firstFrameWithinS = 0.0}), std::invalid_argument);
  EXPECT_THROW(LiveMeasurement(HandDescription{}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::live_measurement_test
