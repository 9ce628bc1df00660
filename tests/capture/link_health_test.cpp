#include "palpate/capture/link_health.h"

#include "palpate/device/dsa_frame.h"

#include "testing/testing.h"

namespace palpate::link_health_test {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

std::vector<AlarmKind> kindsOf(const LinkHealth& health) {
  std::vector<AlarmKind> kinds;
  for (const Alarm& alarm : health.alarms) kinds.push_back(alarm.kind);
  return kinds;
}

// Simulates a hand that delivers 31.25 frames per second for ten seconds.
LinkMonitor::Reading steady(LinkMonitor& meter, std::int64_t& monoUs) {
  for (int i = 0; i <= 312; ++i) {
    monoUs = i * 32'000;
    meter.frame(monoUs, false);
  }
  return meter.read(monoUs);
}

LinkInputs streaming() {
  LinkInputs inputs;
  inputs.started = true;
  inputs.device.tactile.state = PortState::kStreaming;
  LinkMonitor meter;
  std::int64_t monoUs = 0;
  inputs.frames = steady(meter, monoUs);
  return inputs;
}

TEST(LinkMonitor, tellsRateAndAgeExactly) {
  LinkMonitor meter;
  EXPECT_FALSE(meter.read(5).ageMs);
  EXPECT_EQ(meter.read(5).rateHz, 0.0);
  std::int64_t monoUs = 0;
  const auto reading = steady(meter, monoUs);
  EXPECT_EQ(reading.frames, 313u);
  EXPECT_NEAR(reading.rateHz, 31.25, 1e-9);
  EXPECT_NEAR(reading.meanRateHz, 31.25, 1e-9);
  EXPECT_EQ(meter.read(monoUs + 5'000).ageMs, 5.0);
}

TEST(LinkMonitor, theRateFallsWhenFramesCease) {
  LinkMonitor meter;
  std::int64_t monoUs = 0;
  steady(meter, monoUs);
  // Frames arrived in only 1 s of the last 2 s: 31.25 Hz * 1 s / 2 s.
  EXPECT_NEAR(meter.read(monoUs + kSecond).rateHz, 15.6, 0.3);
  EXPECT_EQ(meter.read(monoUs + 3 * kSecond).rateHz, 0.0);
  EXPECT_NEAR(meter.read(monoUs + 3 * kSecond).meanRateHz, 31.25, 1e-9);
}

TEST(LinkMonitor, countsSaturatedFramesAndTheirShareOfTheLastTwoSeconds) {
  LinkMonitor meter;
  for (int i = 0; i < 100; ++i) meter.frame(i * 100'000, i < 50 || i % 4 == 0);
  const auto reading = meter.read(99 * 100'000);
  EXPECT_EQ(reading.saturatedFrames, 50u + 12u);  // 52, 56, .., 96
  // Frames 79..99 are in the window; 80, 84, 88, 92 and 96 of them are saturated.
  EXPECT_NEAR(reading.saturatedFraction, 5.0 / 21.0, 1e-12);
}

TEST(LinkMonitor, lowIsMeasuredByTheExpectedRateAndLasts) {
  HealthOptions options;
  options.expectedRateHz = 31.25;
  LinkMonitor meter(options);
  std::int64_t monoUs = 0;
  EXPECT_EQ(steady(meter, monoUs).lowRateS, 0.0);
  for (int i = 0; i < 100; ++i) meter.frame(monoUs += 100'000, false);
  const auto reading = meter.read(monoUs);
  EXPECT_NEAR(reading.rateHz, 10.0, 1e-9);
  EXPECT_GT(reading.lowRateS, 7.0);
  EXPECT_LT(reading.lowRateS, 10.0);
  for (int i = 0; i < 200; ++i) meter.frame(monoUs += 32'000, false);
  EXPECT_EQ(meter.read(monoUs).lowRateS, 0.0);
}

TEST(LinkMonitor, lowStaysLowHoweverLongItLasts) {
  // As with thresholds of 0: 17.3 frames/s for ten minutes, from a hand that could deliver 31.7.
  LinkMonitor meter;
  meter.expect(dsaScanRateHz(456));
  std::int64_t monoUs = 0;
  for (int i = 0; i < 10'000; ++i) meter.frame(monoUs += 57'800, false, 330);
  const auto reading = meter.read(monoUs);
  EXPECT_NEAR(reading.expectedRateHz, 31.7, 0.05);
  EXPECT_NEAR(reading.rateHz, 17.3, 0.05);
  EXPECT_GT(reading.lowRateS, 500.0);
  EXPECT_NEAR(reading.lineRateHz, 17.1, 0.1);  // 11,520 bytes/s, 13 + 2 * 330 bytes each
  LinkInputs inputs = streaming();
  inputs.frames = reading;
  const LinkHealth health = assessHealth(inputs);
  ASSERT_EQ(kindsOf(health), std::vector{AlarmKind::kLowRate});
  EXPECT_EQ(health.alarms[0].text,
            "only 17.3 frames/s instead of 31.7: noise fills the line; raise the threshold (dock "
            "Hand), or scan fewer taxels");
  const PreflightCheck before = checkPreflight(inputs, {"/tmp", true, 1'000'000'000'000});
  EXPECT_FALSE(before.ready);
  EXPECT_NE(before.text.find("raise the threshold"), std::string::npos) << before.text;
}

TEST(LinkMonitor, fewFramesOfALineThatHasRoomAreAnotherTrouble) {
  LinkMonitor meter;
  meter.expect(dsaScanRateHz(456));
  std::int64_t monoUs = 0;
  for (int i = 0; i < 1000; ++i) meter.frame(monoUs += 57'800, false, 40);
  LinkInputs inputs = streaming();
  inputs.frames = meter.read(monoUs);
  const LinkHealth health = assessHealth(inputs);
  ASSERT_EQ(kindsOf(health), std::vector{AlarmKind::kLowRate});
  EXPECT_NE(health.alarms[0].text.find("late or not at all"), std::string::npos);
  // Masks change the expected rate, so the duration of the low rate starts again.
  meter.expect(dsaScanRateHz(2));
  EXPECT_EQ(meter.read(monoUs).lowRateS, 0.0);
}

TEST(LinkMonitor, staysBoundedAtAnyRate) {
  LinkMonitor meter;
  for (int i = 0; i < 1'000'000; ++i) meter.frame(i * 10, false);
  EXPECT_EQ(meter.read(10'000'000).frames, 1'000'000u);
  EXPECT_NEAR(meter.read(9'999'990).rateHz, 100'000.0, 1.0);
  meter.reset();
  EXPECT_EQ(meter.read(0).frames, 0u);
}

TEST(LinkHealth, aSteadyLinkRaisesNoAlarm) {
  LinkInputs inputs = streaming();
  inputs.device.tactile.badChecksums = 3;
  inputs.device.tactile.lost = 2;
  inputs.device.motion = PortStatus{};
  inputs.device.motion->badChecksums = 4;
  inputs.recorder.state = RecorderStatus::State::kRecording;
  inputs.recorder.recordedS = 100.0;
  inputs.recorder.bytesOnDisk = 2'000'000;
  inputs.recorder.freeBytes = 720'000'000;
  const LinkHealth health = assessHealth(inputs);
  EXPECT_TRUE(health.alarms.empty()) << health.alarms[0].text;
  EXPECT_EQ(health.badChecksums, 7u);
  EXPECT_EQ(health.lost, 2u);
  EXPECT_DOUBLE_EQ(health.bytesPerS, 20'000.0);
  ASSERT_TRUE(health.diskHours);
  EXPECT_DOUBLE_EQ(*health.diskHours, 10.0);
}

TEST(LinkHealth, everyTroubleHasItsAlarm) {
  LinkInputs inputs = streaming();
  inputs.frames.ageMs = 1200.0;
  EXPECT_EQ(kindsOf(assessHealth(inputs)), std::vector{AlarmKind::kNoData});
  inputs = streaming();
  inputs.frames.lowRateS = 2.5;
  EXPECT_EQ(kindsOf(assessHealth(inputs)), std::vector{AlarmKind::kLowRate});
  inputs = streaming();
  inputs.recorder.state = RecorderStatus::State::kWaiting;
  inputs.recorder.elapsedS = 1.9;
  EXPECT_TRUE(assessHealth(inputs).alarms.empty());
  inputs.recorder.elapsedS = 2.1;
  EXPECT_EQ(kindsOf(assessHealth(inputs)), std::vector{AlarmKind::kEmptyRecording});
  inputs = streaming();
  inputs.recorder.writeError = "a.palpate: the disk is full";
  inputs.recorder.lost = 4;
  inputs.recorder.blockedS = 3.0;
  EXPECT_EQ(kindsOf(assessHealth(inputs)),
            (std::vector{AlarmKind::kWriteError, AlarmKind::kSlowDisk, AlarmKind::kOverflow}));
  inputs = streaming();
  inputs.recorder.mcapFailure = "a.mcap: the disk is full";
  const LinkHealth stopped = assessHealth(inputs);
  EXPECT_EQ(kindsOf(stopped), std::vector{AlarmKind::kMcapStopped});
  EXPECT_NE(stopped.alarms[0].text.find("the recording continues: a.mcap: the disk is full"),
            std::string::npos);
  inputs = streaming();
  inputs.recorder.freeBytes = 18'000 * 3600 / 2;  // half an hour, at the nominal rate
  const LinkHealth low = assessHealth(inputs);
  EXPECT_EQ(kindsOf(low), std::vector{AlarmKind::kLowDisk});
  EXPECT_NE(low.alarms[0].text.find("30 minutes"), std::string::npos);
}

TEST(LinkHealth, aSlowDeviceIsNotSilent) {
  LinkInputs inputs = streaming();
  inputs.frames.meanRateHz = 0.33;  // pull mode: one frame in 3 s
  inputs.frames.ageMs = 3'100.0;
  EXPECT_TRUE(assessHealth(inputs).alarms.empty());
}

TEST(LinkHealth, aDeviceThatNeverCameIsAnAlarmOnlyOnceItIsSilentOrLost) {
  LinkInputs inputs;
  EXPECT_TRUE(assessHealth(inputs).alarms.empty());
  inputs.started = true;
  inputs.device.tactile.state = PortState::kConnecting;
  EXPECT_TRUE(assessHealth(inputs).alarms.empty());
  inputs.device.tactile.state = PortState::kLost;
  inputs.device.tactile.port = "/dev/ttyUSB0";
  const LinkHealth health = assessHealth(inputs);
  ASSERT_EQ(kindsOf(health), std::vector{AlarmKind::kNoData});
  EXPECT_EQ(health.alarms[0].text,
            "the tactile port /dev/ttyUSB0 is disconnected: plug it in again");
}

TEST(LinkHealth, saysTheNameOfAPortOnce) {
  LinkInputs inputs = streaming();
  inputs.device.tactile.state = PortState::kSilent;
  inputs.device.tactile.port = "/dev/ttyUSB0";
  inputs.device.tactile.message = "/dev/ttyUSB0: no frames for 0.5 s; check power and cable";
  inputs.frames.ageMs = 2'000.0;
  const LinkHealth health = assessHealth(inputs);
  ASSERT_EQ(health.alarms.size(), 1u);
  EXPECT_EQ(health.alarms[0].text,
            "the tactile port /dev/ttyUSB0 is silent: no frames for 0.5 s; check power and cable");
  EXPECT_EQ(withoutPort(PortStatus{}), "");
}

TEST(LinkHealth, aSenderOfAnotherHandIsNotSilent) {
  LinkInputs inputs = streaming();
  PortStatus& port = inputs.device.tactile;
  port.state = PortState::kSilent;
  port.port = "tcp:localhost:9871";
  port.message = "tcp:localhost:9871: packet 7: 384 values instead of 256";
  port.items = 0;
  port.suspect = 7;
  inputs.frames.ageMs = 2'000.0;
  EXPECT_EQ(assessHealth(inputs).alarms.at(0).text,
            "the tactile port tcp:localhost:9871 sends nothing that fits the hand: packet 7: 384 "
            "values instead of 256");
  port.items = 100;
  EXPECT_NE(assessHealth(inputs).alarms.at(0).text.find("sends no frames"), std::string::npos);
}

TEST(LinkHealth, aHandThatIsTooHotIsAnAlarm) {
  LinkInputs inputs = streaming();
  inputs.temperatures = Sample{0, {30.0, 65.0}, kTemperatureSeries};
  EXPECT_TRUE(assessHealth(inputs).alarms.empty());
  inputs.temperatures = Sample{0, {30.0, 70.2, 0.0}, kTemperatureSeries};
  const LinkHealth hot = assessHealth(inputs);
  ASSERT_EQ(kindsOf(hot), std::vector{AlarmKind::kTooHot});
  EXPECT_EQ(hot.alarms[0].text, "the hand is 70 °C hot: relax it and let it cool down below 65");
}

const FolderState kGoodFolder{"/data", true, std::uint64_t{18'000} * 3600 * 120};

TEST(CheckBeforeRun, saysReadyInOneLine) {
  LinkInputs inputs = streaming();
  inputs.device.motion = PortStatus{};
  inputs.device.motion->state = PortState::kStreaming;
  Sample temperatures{0, std::vector<double>(9, 31.0)};
  temperatures.values[4] = 38.4;
  inputs.temperatures = temperatures;
  const PreflightCheck check = checkPreflight(inputs, kGoodFolder);
  EXPECT_TRUE(check.ready);
  EXPECT_EQ(check.text, "ready: 31.2 frames/s, up to 38 °C, disk for 5 days");
}

TEST(CheckBeforeRun, isDoubtfulWhenValuesAreOutsideOfTheRange) {
  LinkInputs inputs = streaming();
  EXPECT_FALSE(checkPreflight(inputs, kGoodFolder).doubtful);
  inputs.device.tactile.outOfRange = 412;
  const PreflightCheck check = checkPreflight(inputs, kGoodFolder);
  EXPECT_TRUE(check.ready);
  EXPECT_TRUE(check.doubtful);
  EXPECT_TRUE(check.text.ends_with("; 412 frames with values outside the hand's range"))
      << check.text;
}

TEST(CheckBeforeRun, namesTheFirstThingThatIsWrong) {
  const Sample warm{0, {30.0}};
  const auto textOf = [&](LinkInputs inputs, const FolderState& folder = kGoodFolder) {
    inputs.temperatures = warm;
    const PreflightCheck check = checkPreflight(inputs, folder);
    EXPECT_FALSE(check.ready);
    EXPECT_EQ(check.text.find("not ready: "), 0u);
    EXPECT_EQ(check.text.find('\n'), std::string::npos);
    return check.text;
  };
  LinkInputs inputs;
  EXPECT_NE(textOf(inputs).find("no hand"), std::string::npos);
  inputs = streaming();
  inputs.device.tactile.state = PortState::kSilent;
  EXPECT_NE(textOf(inputs).find("silent"), std::string::npos);
  inputs = streaming();
  inputs.device.motion = PortStatus{};
  inputs.device.motion->state = PortState::kLost;
  EXPECT_NE(textOf(inputs).find("motion port"), std::string::npos);
  inputs = streaming();
  inputs.frames.rateHz = 20.0;
  EXPECT_NE(textOf(inputs).find("20.0 frames/s"), std::string::npos);
  inputs = streaming();
  EXPECT_NE(textOf(inputs, {"/ro", false, 1u << 30}).find("/ro can't be written"),
            std::string::npos);
  EXPECT_EQ(textOf(inputs, {"/full", true, 18'000 * 60 * 12}),
            "not ready: /full has space for 12 minutes: choose another folder, or free some space");
  EXPECT_EQ(textOf(inputs, {"/full", true, 18'000}),
            "not ready: /full has space for less than a minute: choose another folder, or free "
            "some space");
  inputs.temperatures = Sample{0, {30.0, 70.2}, kTemperatureSeries};
  const PreflightCheck hot = checkPreflight(inputs, kGoodFolder);
  EXPECT_FALSE(hot.ready);
  EXPECT_NE(hot.text.find("70 °C"), std::string::npos);
}

TEST(LinkHealth, theTimeForWhichADiskLastsIsSaidInTheUnitThatSuitsIt) {
  EXPECT_EQ(diskTimeText(-1.0), "less than a minute");
  EXPECT_EQ(diskTimeText(0.004), "less than a minute");
  EXPECT_EQ(diskTimeText(1.0 / 60.0), "1 minute");
  EXPECT_EQ(diskTimeText(0.5), "30 minutes");
  EXPECT_EQ(diskTimeText(1.0), "1.0 h");
  EXPECT_EQ(diskTimeText(9.5), "9.5 h");
  EXPECT_EQ(diskTimeText(30.0), "30 h");
  EXPECT_EQ(diskTimeText(72.0), "3 days");
  EXPECT_EQ(diskTimeText(9000.0), "over a year");
}

}  // namespace
}  // namespace palpate::link_health_test
