#include "palpate/device/sdh_controller.h"

#include <array>
#include <limits>

#include "device/sdh_on_a_wire.h"

namespace palpate::sdh_controller_test {
namespace {

using testing::bytesOf;
using testing::errorOf;
using Values = SdhController::Values;
using SdhControllerTest = testing::SdhOnAWire;

TEST_F(SdhControllerTest, OpensAndLearnsWhatTheHandIs) {
  const SdhControllerInfo facts = controller.open();
  EXPECT_EQ(facts.firmware, "0.0.3.3");
  EXPECT_EQ(facts.date, "2013-09-19");
  EXPECT_EQ(facts.soc, "SDH_SOC 7");
  EXPECT_EQ(facts.serial, "48");
  EXPECT_EQ(facts.id, "SDH");
  EXPECT_EQ(facts.maximumVelocity, hand.values["vlim"]);
  EXPECT_EQ(facts.maximumAcceleration, hand.values["alim"]);
  EXPECT_EQ(facts.controller, 0);
  EXPECT_LT(seconds(), 0.5);
}

TEST_F(SdhControllerTest, ReadsAndMovesTheAxes) {
  controller.open();
  EXPECT_EQ(controller.angles(), hand.pos);
  EXPECT_EQ(controller.targets(), hand.values["p"]);
  EXPECT_EQ(controller.temperatures(),
            (Values{40.5, 45.75, 37, 41.75, 34, 44, 36.75, 48.5, 48.25}));
  const Values goal{0, -20, -30, -40, 5, 60, 7.5};
  EXPECT_EQ(controller.setTargets(goal), goal);
  EXPECT_DOUBLE_EQ(controller.move(), 4.51);
  EXPECT_EQ(controller.states(), std::vector<int>(7, 1));
  controller.states();
  EXPECT_EQ(controller.states(), std::vector<int>(7, 0));
  EXPECT_EQ(controller.angles(), goal);
  controller.stop();
  EXPECT_EQ(hand.stops, 1);
}

// --- What is refused before a byte leaves (R18)

TEST_F(SdhControllerTest, RefusesValuesOutOfRangeAndSendsNoByte) {
  controller.open();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf, 90.01, -90.01, 1e300}) {
    const Values target{0, 0, 0, 0, 0, bad, 0};
    expectRefused([&] { controller.setTargets(target); },
                  {"axis 5", "finger 2 proximal", "target angle", "-90..90 deg"});
    expectRefused([&] { controller.setTargetsGetAngles(target); }, {"axis 5"});
    expectRefused(
        [&] {
          controller.setSoftLimits(SdhSoftLimit::kMaximum, {0, bad * 3, 0, 0, 0, 0, 0});
        },
        {"axis 1"});
  }
  expectRefused([&] { controller.setTargets({-0.5, 0, 0, 0, 0, 0, 0}); }, {"axis 0", "0..90"});
  expectRefused([&] { controller.setVelocities({0, 0, 0, 0, 0, 0, 201}); }, {"axis 6", "0..200"});
  expectRefused([&] { controller.setVelocities({0, -1, 0, 0, 0, 0, 0}); }, {"axis 1", "0..140"});
  expectRefused([&] { controller.setVelocitiesGetVelocities({84, 0, 0, 0, 0, 0, 0}); }, {"axis 0"});
  expectRefused(
      [&] {
        controller.setAccelerations({0, 0, 0, 401, 0, 0, 0});
      },
      {"axis 3", "0..400"});
  expectRefused([&] { controller.setPower(Values{1, 1, 0.5, 1, 1, 1, 1}); }, {"axis 2", "power"});
  expectRefused([&] { controller.setPower(Values{1, 1, nan, 1, 1, 1, 1}); }, {"axis 2"});
  expectRefused([&] { controller.setCurrentLimits(SdhCurrent::kGrip, Values(7, 1.1)); },
                {"axis 0", "0..1 A"});
  expectRefused([&] { controller.setTargets({0, 0, 0}); }, {"3 values", "seven"});
  expectRefused([&] { controller.setTargets(Values(8, 0.0)); }, {"8 values"});
  expectRefused([&] { controller.setTarget(7, 0.0); }, {"axis 7", "0..6"});
  expectRefused([&] { controller.setVelocity(7, 0.0); }, {"axis 7"});
  expectRefused([&] { controller.setAxisPower(99, true); }, {"axis 99"});
  expectRefused([&] { controller.setController(3); }, {"controller", "0..2"});
  expectRefused([&] { controller.setController(-1); }, {"0..2"});
  expectRefused([&] { controller.setProfile(2); }, {"profile", "0..1"});
  expectRefused([&] { controller.setVelocityGain(2, nan); }, {"axis 2", "velocity gain"});
  expectRefused([&] { controller.setPid(2, {1, inf, 1}); }, {"axis 2"});
  expectRefused([&] { controller.referenceRun({0, 0, 3, 0, 0, 0, 0}); }, {"axis 2", "0..2"});
  expectRefused([&] { controller.savePositions({0, 0, -1, 0, 0, 0, 0}); }, {"axis 2"});
  EXPECT_EQ(hand.values["p"], (Values{0, -10, 20, -30, 40, -50, 60}));
}

TEST_F(SdhControllerTest, LimitsAreTheHandsOwn) {
  hand.values["vlim"] = {80, 100, 100, 100, 100, 100, 100};
  controller.open();
  expectRefused([&] { controller.setVelocities({0, 101, 0, 0, 0, 0, 0}); }, {"axis 1", "0..100"});
  hand.values["vlim"] = Values(7, 90.0);
  EXPECT_EQ(controller.velocityLimits(), Values(7, 90.0));
}

TEST_F(SdhControllerTest, NegativeVelocitiesNeedAVelocityController) {
  controller.open();
  controller.setController(1);
  EXPECT_EQ(hand.con, 1);
  const Values slow{-10, 20, -30, 0, 0, 0, 5};
  EXPECT_EQ(controller.setVelocities(slow), slow);
  expectRefused([&] { controller.setVelocities({0, -141, 0, 0, 0, 0, 0}); }, {"-140..140"});
  controller.setController(0);
  expectRefused([&] { controller.setVelocities(slow); }, {"axis 0", "0..83"});
}

// --- No axis becomes 0 by omission

TEST_F(SdhControllerTest, SettingOneAxisWritesAllSevenAsTheyWere) {
  controller.open();
  hand.values["power"] = Values(7, 1.0);
  controller.setTarget(5, 12.5);
  EXPECT_EQ(hand.values["p"], (Values{0, -10, 20, -30, 40, 12.5, 60}));
  controller.setAcceleration(2, 10);
  EXPECT_EQ(hand.values["a"], (Values{100, 100, 10, 100, 100, 100, 100}));
  controller.setVelocity(0, 7);
  EXPECT_EQ(hand.values["v"], (Values{7, 40, 40, 40, 40, 40, 40}));
  controller.setAxisPower(2, false);
  EXPECT_EQ(hand.values["power"], (Values{1, 1, 0, 1, 1, 1, 1}));
}

TEST_F(SdhControllerTest, ASingleAxisIsNotSetWhenTheOthersCantBeRead) {
  controller.open();
  hand.silentAnswers = 1000;
  EXPECT_EQ(errorOf([&] { controller.setTarget(5, 12.5); }).fault(), DeviceFault::kSilent);
  EXPECT_EQ(hand.values["p"], (Values{0, -10, 20, -30, 40, -50, 60}));
}

TEST_F(SdhControllerTest, NoticesTargetsThatTheHandUnderstoodOtherwise) {
  controller.open();
  hand.swapsTargets = true;
  const DeviceError error = errorOf([&] { controller.setTargets({0, 10, 20, 0, 0, 0, 0}); });
  EXPECT_EQ(error.fault(), DeviceFault::kProtocol);
}

// --- All the rest of the language

TEST_F(SdhControllerTest, SettingsGoForthAndBack) {
  controller.open();
  EXPECT_EQ(controller.currentLimits(SdhCurrent::kGrip), hand.values["igrip"]);
  EXPECT_EQ(controller.currentLimits(SdhCurrent::kHold), hand.values["ihold"]);
  controller.setCurrentLimits(SdhCurrent::kMotion, Values(7, 0.75));
  EXPECT_EQ(hand.values["ilim"], Values(7, 0.75));
  controller.setCurrentLimits(SdhCurrent::kHold, Values(7, 0.25));
  EXPECT_EQ(hand.values["ihold"], Values(7, 0.25));
  EXPECT_EQ(controller.softLimits(SdhSoftLimit::kMinimum), hand.values["p_min"]);
  controller.setSoftLimits(SdhSoftLimit::kOffset, Values(7, -1.5));
  EXPECT_EQ(hand.values["p_offset"], Values(7, -1.5));
  EXPECT_EQ(controller.softLimits(SdhSoftLimit::kMaximum), Values(7, 90.0));
  EXPECT_DOUBLE_EQ(controller.velocityGain(3), 0.25);
  controller.setVelocityGain(3, 0.5);
  EXPECT_EQ(hand.values["kv"], (Values{0.25, 0.25, 0.25, 0.5, 0.25, 0.25, 0.25}));
  EXPECT_EQ(controller.pid(6), (std::array<double, 3>{1, 2, 3.5}));
  controller.setPid(6, {1, 2, 3});
  EXPECT_EQ(hand.log.back(), "pid(6)=1.000000,2.000000,3.000000");
  controller.setProfile(1);
  EXPECT_EQ(controller.profile(), 1);
  controller.referenceRun({0, 0, 0, 2, 0, 0, 1});
  EXPECT_EQ(hand.values["ref"], (Values{0, 0, 0, 2, 0, 0, 1}));
  controller.savePositions({1, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(hand.values["pos_save"], (Values{1, 0, 0, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(controller.pendingDuration(), 3.25);
  hand.values["vel"] = {1, -2, 3, -4, 5, -6, 7};
  EXPECT_EQ(controller.velocities(), hand.values["vel"]);
  EXPECT_EQ(controller.setVelocitiesGetVelocities(Values(7, 30.0)), hand.values["vel"]);
  EXPECT_EQ(hand.values["v"], Values(7, 30.0));
  EXPECT_EQ(controller.setTargetsGetAngles(Values(7, 5.0)), hand.pos);
  EXPECT_EQ(hand.values["p"], Values(7, 5.0));
  EXPECT_EQ(controller.setPower(true), Values(7, 1.0));
  EXPECT_EQ(controller.power(), Values(7, 1.0));
}

TEST_F(SdhControllerTest, UsesRecordsWhereTheFirmwareHasThem) {
  controller.open();
  controller.angles();
  EXPECT_EQ(hand.log.back(), "pos?");
}

TEST_F(SdhControllerTest, OlderFirmwareIsAskedInLines) {
  hand.firmware = "0.0.2.14";
  controller.open();
  EXPECT_EQ(controller.angles(), hand.pos);
  EXPECT_EQ(hand.log.back(), "pos");
  const Values goal{0, -20, -30, -40, 5, 60, 7.5};
  controller.setTargets(goal);
  EXPECT_EQ(hand.values["p"], goal);
  EXPECT_EQ(controller.states(), std::vector<int>(7, 0));
}

TEST_F(SdhControllerTest, VeryOldFirmwareIsNotAskedForWhatItHasNot) {
  hand.firmware = "0.0.1.0";
  const SdhControllerInfo facts = controller.open();
  EXPECT_EQ(facts.maximumVelocity, (Values{83, 140, 200, 140, 200, 140, 200}));
  for (const std::string& asked : hand.log)
    EXPECT_FALSE(asked == "vlim" || asked == "alim" || asked == "con") << asked;
  const std::size_t before = hand.bytesSeen;
  for (const DeviceError& error : {errorOf([&] { controller.setController(1); }),
                                   errorOf([&] { controller.accelerationLimits(); }),
                                   errorOf([&] { controller.referenceVelocities(); })}) {
    EXPECT_EQ(error.fault(), DeviceFault::kUnsupported);
    EXPECT_NE(std::string(error.what()).find("0.0.1.0"), std::string::npos);
  }
  EXPECT_EQ(hand.bytesSeen, before);
}

TEST_F(SdhControllerTest, ANetworkHasNoChecksums) {
  hand.checksum = false;
  line.network = true;
  SdhController overNetwork(line, clock);
  overNetwork.open();
  EXPECT_EQ(overNetwork.angles(), hand.pos);
  overNetwork.setTargets(Values(7, 5.0));
  EXPECT_EQ(hand.values["p"], Values(7, 5.0));
}

// --- Opening

TEST_F(SdhControllerTest, OpensThroughLeftOversOfAnotherProgram) {
  line.arrive(bytesOf("83 20 07 00 00 00"), 20'000);
  hand.receive(bytesOf("85 1F 07 00 00"));  // a record that is incomplete
  hand.silentAnswers = 1;
  EXPECT_EQ(controller.open().firmware, "0.0.3.3");
  EXPECT_EQ(hand.values["p"], (Values{0, -10, 20, -30, 40, -50, 60}))
      << "the rest was taken for values";
}

TEST_F(SdhControllerTest, AnEmptyLineIsSaidToBeSilent) {
  hand.dead = true;
  const DeviceError error = errorOf([&] { controller.open(); });
  EXPECT_EQ(error.fault(), DeviceFault::kSilent);
  EXPECT_NE(std::string(error.what()).find("check cable and power"), std::string::npos);
  EXPECT_LT(seconds(), 5.0);
}

TEST_F(SdhControllerTest, ATactileControllerIsRecognised) {
  hand.dead = true;
  // An acknowledgement of the tactile controller, repeated at the rate of a stream (section 1.6).
  for (int i = 0; i < 40; ++i)
    line.arrive(bytesOf("AA AA AA 03 02 00 00 00 4B B9"), 150'000 + i * 30'000);
  const DeviceError error = errorOf([&] { controller.open(); });
  EXPECT_EQ(error.fault(), DeviceFault::kWrongDevice);
  EXPECT_NE(std::string(error.what()).find("swapped"), std::string::npos);
}

TEST_F(SdhControllerTest, AHandOfAnotherKindIsRefused) {
  hand.axes = 6;
  EXPECT_EQ(errorOf([&] { controller.open(); }).fault(), DeviceFault::kWrongDevice);
}

}  // namespace
}  // namespace palpate::sdh_controller_test
