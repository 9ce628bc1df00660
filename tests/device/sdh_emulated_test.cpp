// Tests the driver of the SDH-2 and the probe with the emulated hand. The emulator was written from
// the protocol document without the driver's code, so that each reveals errors of the other.
#include <algorithm>
#include <chrono>

#include "palpate/device/byte_channel.h"
#include "palpate/device/live_hand.h"
#include "palpate/device/port_probe.h"
#include "palpate/device/sdh_controller.h"
#include "palpate/emulator/emulated_hand.h"

#include "device/collecting_sink.h"
#include "emulator/still_hand.h"
#include "testing/testing.h"

namespace palpate::sdh_emulated_test {
namespace {

using SteadyClock = std::chrono::steady_clock;
using Values = SdhController::Values;

EmulatedHandOptions quick() {
  EmulatedHandOptions options;
  options.rate = EmulationRate::kFixed;  // no delays, time runs normally
  options.hz = 30.0;
  return options;
}

double secondsSince(SteadyClock::time_point start) {
  return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

// Polls until no axis moves.
void awaitRest(SdhController& hand) {
  const auto start = SteadyClock::now();
  while (true) {
    const std::vector<int> states = hand.states();
    if (std::none_of(states.begin(), states.end(), [](int s) { return s == 1 || s == 2; })) return;
    ASSERT_LT(secondsSince(start), 10.0) << "the motion doesn't end";
  }
}

void expectNear(const Values& got, const Values& expected, double tolerance) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t axis = 0; axis < got.size(); ++axis)
    EXPECT_NEAR(got[axis], expected[axis], tolerance) << "axis " << axis;
}

// Firmware releases: with records, without, with @ lines.
class SdhEmulated : public ::testing::TestWithParam<const char*> {};

TEST_P(SdhEmulated, MovesTheJointsToWhereTheyWereSent) {
  EmulatedHandOptions options = quick();
  options.sdh.firmware = GetParam();
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), options);
  const auto channel = openChannel(emulated.sdhPort());
  SdhController hand(*channel);
  const SdhControllerInfo facts = hand.open();
  EXPECT_EQ(facts.firmware, GetParam());
  EXPECT_EQ(facts.serial, emulated.sdhSerial());
  expectNear(hand.angles(), Values(7, 0.0), 1e-3);
  const Values goal{5, -8, 7, 6.5, -5, 4, 8.25};
  hand.setPower(true);
  hand.setVelocities({80, 130, 130, 130, 130, 130, 130});
  hand.setTargets(goal);
  const double duration = hand.move();
  EXPECT_GT(duration, 0.01);
  EXPECT_LT(duration, 3.0);
  const auto start = SteadyClock::now();
  awaitRest(hand);
  EXPECT_NEAR(secondsSince(start), duration, 0.3);
  expectNear(hand.angles(), goal, 0.1);
  EXPECT_EQ(hand.temperatures().size(), 9u);
  EXPECT_EQ(hand.stats().retries, 0u);
  EXPECT_EQ(hand.stats().badChecksums, 0u);
}

INSTANTIATE_TEST_SUITE_P(Firmware,
                         SdhEmulated,
                         ::testing::Values("0.0.3.3", "0.0.2.15", "0.0.2.7", "0.0.2.0"));

TEST(SdhEmulatedHand, StopsInMidMotionAndTheAxesStayWhereTheyAre) {
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), quick());
  const auto channel = openChannel(emulated.sdhPort());
  SdhController hand(*channel);
  hand.open();
  hand.setPower(true);
  hand.setVelocities(Values(7, 20.0));
  hand.setTargets({0, 80, 0, 0, 0, 0, 0});
  EXPECT_GT(hand.move(), 3.0);
  const auto start = SteadyClock::now();
  while (hand.angles()[1] < 2.0) ASSERT_LT(secondsSince(start), 5.0);
  hand.stop();
  awaitRest(hand);
  const double stopped = hand.angles()[1];
  EXPECT_LT(stopped, 40.0);
  EXPECT_EQ(hand.power(), Values(7, 1.0)) << "a stop leaves the power on";
  expectNear(hand.angles(), {0, stopped, 0, 0, 0, 0, 0}, 0.05);
}

TEST(SdhEmulatedHand, MovesAtOnceInAVelocityController) {
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), quick());
  const auto channel = openChannel(emulated.sdhPort());
  SdhController hand(*channel);
  hand.open();
  hand.setPower(true);
  hand.setController(1);
  hand.setVelocities({0, -60, 0, 0, 0, 0, 0});
  const auto start = SteadyClock::now();
  while (hand.angles()[1] > -2.0) ASSERT_LT(secondsSince(start), 5.0);
  hand.setVelocities(Values(7, 0.0));
  awaitRest(hand);
  hand.setController(0);
  EXPECT_EQ(hand.controller(), 0);
}

TEST(SdhEmulatedHand, SettingsAreReadBackAsTheyWereSet) {
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), quick());
  const auto channel = openChannel(emulated.sdhPort());
  SdhController hand(*channel);
  hand.open();
  expectNear(hand.velocityLimits(), {83, 140, 200, 140, 200, 140, 200}, 1e-6);
  expectNear(hand.accelerationLimits(), {5000, 400, 1500, 400, 1500, 400, 1500}, 1e-6);
  hand.setAcceleration(3, 250.0);
  EXPECT_NEAR(hand.accelerations()[3], 250.0, 1e-3);
  EXPECT_NEAR(hand.accelerations()[4], 100.0, 1e-3);
  for (const SdhCurrent current : {SdhCurrent::kMotion, SdhCurrent::kGrip, SdhCurrent::kHold}) {
    hand.setCurrentLimits(current, Values(7, 0.25));
    expectNear(hand.currentLimits(current), Values(7, 0.25), 1e-3);
  }
  hand.setProfile(1);
  EXPECT_EQ(hand.profile(), 1);
  hand.setVelocityGain(2, 0.5);
  EXPECT_NEAR(hand.velocityGain(2), 0.5, 1e-3);
  hand.setPid(4, {1, 2, 3});
  EXPECT_NEAR(hand.pid(4)[2], 3.0, 1e-3);
  expectNear(hand.softLimits(SdhSoftLimit::kMaximum), Values(7, 90.0), 1e-6);
  hand.setTarget(5, 12.0);
  expectNear(hand.targets(), {0, 0, 0, 0, 0, 12, 0}, 1e-3);
  EXPECT_EQ(hand.stats().retries, 0u);
}

TEST(SdhEmulatedHand, SpeaksOverTheNetworkWithoutChecksums) {
  EmulatedHandOptions options = quick();
  options.dsaPort = "tcp:127.0.0.1:0";
  options.sdhPort = "tcp:127.0.0.1:0";
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), options);
  const auto channel = openChannel(emulated.sdhPort());
  ASSERT_TRUE(channel->isNetwork());
  SdhController hand(*channel);
  hand.open();
  hand.setTargets({1, 2, 3, 4, 5, 6, 7});
  expectNear(hand.targets(), {1, 2, 3, 4, 5, 6, 7}, 1e-3);
  expectNear(hand.angles(), Values(7, 0.0), 1e-3);
  EXPECT_EQ(hand.stats().retries, 0u);
}

// Section 2.7 of the protocol document: a real hand gave 105 to 140 angle records a second.
TEST(SdhEmulatedHand, IsAskedAsFastAsTheLineAllows) {
  EmulatedHandOptions options;
  options.rate = EmulationRate::kReal;
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), options);
  const auto channel = openChannel(emulated.sdhPort());
  SdhController hand(*channel);
  hand.open();
  const auto start = SteadyClock::now();
  constexpr int kPolls = 100;
  for (int i = 0; i < kPolls; ++i) hand.angles();
  const double rate = kPolls / secondsSince(start);
  RecordProperty("angle_records_per_s", static_cast<int>(rate));
  EXPECT_GT(rate, 75.0);
  EXPECT_LT(rate, 300.0);
}

TEST(SdhEmulatedHand, LosesNothingOnALineThatLosesBytes) {
  EmulatedHandOptions options = quick();
  options.faults.dropRate = 1e-3;
  options.faults.insertRate = 1e-3;
  options.seed = 5;
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), options);
  const auto channel = openChannel(emulated.sdhPort());
  SdhController hand(*channel);
  hand.open();
  for (int i = 0; i < 150; ++i) expectNear(hand.angles(), Values(7, 0.0), 1e-3);
  EXPECT_GT(hand.stats().retries, 0u);
}

TEST(SdhEmulatedHand, BothPortsAreToldApart) {
  EmulatedHandOptions options;
  options.rate = EmulationRate::kReal;
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), options);
  const PortProbe motion = probePort(emulated.sdhPort());
  EXPECT_EQ(motion.answer, PortAnswer::kMotion) << motion.message;
  EXPECT_EQ(motion.serial, emulated.sdhSerial());
  const PortProbe tactile = probePort(emulated.dsaPort());
  EXPECT_EQ(tactile.answer, PortAnswer::kTactile) << tactile.message;
  EXPECT_EQ(tactile.serial, emulated.dsaSerial());
  EXPECT_NE(describeSwap(motion, tactile), "");
  EXPECT_EQ(describeSwap(tactile, motion), "");
}

TEST(SdhEmulatedHand, SwappedPortsAreNoticedWhileTheTactileControllerStreams) {
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), quick());
  {
    const auto channel = openChannel(emulated.dsaPort());  // another program left it streaming
    const unsigned char start[] = {
        0xAA, 0xAA, 0xAA, 0x03, 0x03, 0x00, 0x81, 0x01, 0x00, 0x7C, 0x5C};
    channel->write(std::as_bytes(std::span(start)));
    std::vector<std::byte> frames(100);
    ASSERT_GT(channel->read(frames, std::chrono::milliseconds(2000)), 0u);
  }
  const auto channel = openChannel(emulated.dsaPort());
  SdhController hand(*channel);
  try {
    hand.open();
    ADD_FAILURE() << "opened";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kWrongDevice) << error.what();
  }
}

TEST(SdhEmulatedHand, WhatAnswersAtTheOtherOnesPortIsSaidInItsStatus) {
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), quick());
  testing::CollectingSink sink;
  LiveHandOptions options;
  options.dsaPort = emulated.sdhPort();  // the port of the motion controller
  LiveHand hand(options);
  hand.start(sink);
  EXPECT_EQ(hand.status().tactile.found, std::nullopt);
  ASSERT_TRUE(sink.await([&] {
    return std::any_of(sink.events.begin(), sink.events.end(), [](const Event& event) {
      return event.text.find("swapped") != std::string::npos;
    });
  }));
  EXPECT_EQ(hand.status().tactile.found, PortAnswer::kMotion);
  hand.stop();
}

// The states are read again after a stop, and after the motors went off in a motion: nobody waits
// for the end of a motion that has ended.
TEST(SdhEmulatedHand, AfterAStopAndWithoutPowerNoAxisIsSaidToMove) {
  EmulatedHand emulated(std::make_unique<testing::StillHand>(), quick());
  testing::CollectingSink sink;
  LiveHandOptions options;
  options.sdhPort = emulated.sdhPort();
  LiveHand hand(options);
  hand.start(sink);
  const auto moves = [&hand] {
    const std::vector<int> states = hand.axisStates();
    return std::any_of(states.begin(), states.end(), [](int s) { return s == 1 || s == 2; });
  };
  const MoveJoints slowly{{0.0, -40.0, 40.0, -40.0, 40.0, -40.0, 40.0}, Values(7, 5.0), false};
  for (const DeviceCommand& end : {DeviceCommand{StopMotion{}}, DeviceCommand{SetPower{}}}) {
    ASSERT_TRUE(sink.await([&] { return hand.status().motion->state == PortState::kStreaming; }));
    hand.submit(slowly).get();
    ASSERT_TRUE(moves());
    hand.submit(end).get();
    EXPECT_TRUE(sink.await([&] { return !moves(); })) << "command " << end.index();
    hand.submit(SetPower{true}).get();
  }
  hand.stop();
}

}  // namespace
}  // namespace palpate::sdh_emulated_test
