// The real program on an emulated hand that runs in the test: what it says, and what arrives at the
// hand.
#include <algorithm>
#include <csignal>

#include "palpate/control/motion_sequence.h"
#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"

#include "commands/grasp_lines.h"
#include "commands/palpate_program.h"
#include "control/emulated_bench.h"
#include "testing/background_program.h"
#include "testing/punctuality.h"

namespace palpate::grasp_command_test {
namespace {
using namespace testing;

TEST(GraspCommand, PlainGraspGoesToThePreshape) {
  EmulatedBench bench(stillHand(), {.rate = EmulationRate::kFixed, .hz = 30.0});
  const auto result = palpate({"grasp",
                               "--sdh",
                               bench.hand->sdhPort(),
                               "--preshape",
                               "cylindrical",
                               "--close",
                               "0.4",
                               "--velocity",
                               "83"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(statesOf(result.out), (States{"connecting", "ready", "closing", "finished"}));
  EXPECT_EQ(handOf(result.out), (States{"moving", "ready"}));
  std::vector<double> angles;
  bench.hand->withModel([&](HandModel& model) { angles = model.joints().angles(); });
  // Table of the study: 0 | -30 + 30 c, 30 + 35 c.
  for (std::size_t axis = 0; axis < 7; ++axis)
    EXPECT_NEAR(angles[axis], axis == 0 ? 0.0 : axis % 2 == 1 ? -18.0 : 44.0, 0.01) << axis;
  EXPECT_TRUE(bench.log.named("grip").empty());
  EXPECT_TRUE(bench.log.named("selgrip").empty());
  EXPECT_TRUE(bench.log.named("power").empty());
  EXPECT_TRUE(bench.log.named("stop").empty());
}

TEST(GraspCommand, SaysThatTheHandWasMovingWhenItWasConnected) {
  EmulatedBench bench(stillHand(), {.rate = EmulationRate::kFixed, .hz = 30.0});
  bench.hand->withModel([](HandModel& model) {
    model.joints().setVelocities(std::vector<double>(7, 5.0));
    model.joints().setTargets({60, 7, -7, 7, -7, 7, -7});
    model.joints().startMotion();
  });
  const auto result = palpate({"grasp",
                               "--sdh",
                               bench.hand->sdhPort(),
                               "--preshape",
                               "centrical",
                               "--close",
                               "0",
                               "--velocity",
                               "83"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(statesOf(result.out), (States{"connecting", "stopped", "ready", "closing", "finished"}))
      << result.out;
  EXPECT_NE(result.out.find("stopped: the hand was moving unattended when it was connected\n"),
            std::string::npos)
      << result.out;
}

TEST(GraspCommand, WhatBelongsToKeepingTheLimitIsChecked) {
  const auto wrong = [](std::vector<std::string> more) {
    std::vector<std::string> words{
        "grasp", "--sdh", "/dev/null", "--dsa", "/dev/null", "--preshape", "centrical"};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = palpate(words);
    EXPECT_EQ(result.exitCode, 2) << result.out;
    return result.err;
  };
  EXPECT_NE(wrong({"--object", "pen"}).find("needs --mode reactive or slip"), std::string::npos);
  EXPECT_NE(wrong({"--quick"}).find("needs --mode reactive or slip"), std::string::npos);
  EXPECT_NE(wrong({"--mode", "reactive", "--quick", "--object-size", "70"}).find("exclude"),
            std::string::npos);
  EXPECT_NE(wrong({"--mode", "reactive", "--object-size", "0"}).find("object-size"),
            std::string::npos);
  EXPECT_NE(wrong({"--mode", "reactive", "--object", std::string(101, 'x')}).find("100 bytes"),
            std::string::npos);
}

TEST(GraspCommand, DamagedMemoryOfTouchesIsRefusedBeforeAnythingMoves) {
  EmulatedBench bench(stillHand());
  const TemporaryFolder home;
  std::filesystem::create_directories(home / "palpate");
  writeFile(home / "palpate/touches.json", "{}");
  const auto result = palpate({"grasp",
                               "--sdh",
                               bench.hand->sdhPort(),
                               "--dsa",
                               bench.hand->dsaPort(),
                               "--preshape",
                               "centrical",
                               "--mode",
                               "reactive",
                               "--object",
                               "ball"},
                              {{"XDG_DATA_HOME", home.path().string()}});
  expectOneLineError(result, 1, {"touches.json", "delete or repair it"});
  EXPECT_TRUE(bench.log.deeds().empty());
}

std::vector<std::string> slowClosing(const EmulatedBench& bench) {
  const std::string port = bench.hand->sdhPort();
  return {"grasp", "--sdh", port, "--preshape", "centrical", "--close", "1", "--velocity", "5"};
}

// From the signal to the stop that arrives at the hand.
void stopBySignal(Punctuality& stops, int number) {
  EmulatedBench bench(stillHand());
  BackgroundProgram program(PALPATE_PROGRAM, slowClosing(bench));
  ASSERT_TRUE(program.awaitLine("closing").has_value()) << program.err();
  ASSERT_TRUE(bench.awaitMotion());
  const std::int64_t pressedUs = systemClock().monotonicUs();
  program.signal(number);
  EXPECT_EQ(program.wait(), 3) << program.err();
  EXPECT_EQ(statesOf(program.out()),
            (States{"connecting", "ready", "closing", "stopping", "stopped"}));
  EXPECT_EQ(handOf(program.out()), (States{"moving", "stopped"}));
  EXPECT_NE(program.err().find("stopped before the grasp was done"), std::string::npos);
  EXPECT_FALSE(bench.handMoves());
  const auto stop = bench.log.firstSince("stop", pressedUs);
  ASSERT_TRUE(stop.has_value());
  stops.took(pressedUs, stop->monoUs);
}

TEST(GraspCommand, CtrlCStopsTheHandFirst) {
  Punctuality stops("signal_to_stop");
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE("signal " + std::to_string(number));
    ASSERT_NO_FATAL_FAILURE(stopBySignal(stops, number));
  }
  stops.judge();
}

// The program dies in a motion: by a signal that nothing can handle, and by one of a crash, after
// which the crash handler and palpate_stop both send stops. docs/notes/safety.md
void dieInAMotion(int number, std::size_t stops) {
  EmulatedBench bench(stillHand());
  BackgroundProgram program(PALPATE_PROGRAM, slowClosing(bench));
  ASSERT_TRUE(program.awaitLine("closing").has_value()) << program.err();
  ASSERT_TRUE(bench.awaitMotion());
  EXPECT_EQ(program.err(), "") << "palpate_stop runs";
  program.signal(number);
  EXPECT_EQ(program.wait(), 128 + number);
  EXPECT_TRUE(eventuallyTrue([&] { return !bench.handMoves(); }));
  EXPECT_TRUE(eventuallyTrue([&] { return bench.log.named("stop").size() == stops; }))
      << bench.log.named("stop").size();
  bench.connect();
  EXPECT_EQ(bench.log.named("stop").size(), stops) << "it was found at rest";
}

TEST(GraspCommand, KilledInAMotionTheHandIsStopped) { dieInAMotion(SIGKILL, 3); }

TEST(GraspCommand, CrashedInAMotionTheHandIsStopped) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer ends the program";
#endif
  dieInAMotion(SIGSEGV, 6);
}

TEST(GraspCommand, AHandThatIsUnpluggedIsSaid) {
  EmulatedBench bench(stillHand());
  BackgroundProgram program(PALPATE_PROGRAM, slowClosing(bench));
  ASSERT_TRUE(program.awaitLine("closing").has_value()) << program.err();
  ASSERT_TRUE(bench.awaitMotion());
  bench.hand->unplug(false, true);
  ASSERT_TRUE(program.awaitLine("waiting").has_value()) << program.err();
  EXPECT_EQ(statesOf(program.out()).at(statesOf(program.out()).size() - 2), "port_gone");
  bench.hand->replug();
  EXPECT_EQ(program.wait(), 1) << program.out();
  EXPECT_NE(program.err().find("it is back, and the hand was stopped"), std::string::npos)
      << program.err();
  EXPECT_FALSE(bench.handMoves());
}

TEST(GraspCommand, WhoDoesNotWaitForAPortIsToldThatTheStateIsUnknown) {
  EmulatedBench bench(stillHand());
  BackgroundProgram program(
      PALPATE_PROGRAM,
      {"grasp", "--sdh", bench.hand->sdhPort(), "--preshape", "centrical", "--close", "1"});
  ASSERT_TRUE(program.awaitLine("closing").has_value()) << program.err();
  ASSERT_TRUE(bench.awaitMotion());
  bench.hand->unplug(false, true);
  ASSERT_TRUE(program.awaitLine("waiting").has_value()) << program.err();
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(), 1) << program.out();
  EXPECT_NE(program.err().find("state unknown: use the power switch"), std::string::npos)
      << program.err();
}

TEST(GraspCommand, WrongUsageMovesNothing) {
  EmulatedBench bench(stillHand());
  const std::string sdh = bench.hand->sdhPort();
  const auto refused = [&](std::vector<std::string> more, const std::string& word) {
    more.insert(more.begin(), "grasp");
    expectOneLineError(palpate(more), 2, {word});
  };
  refused({"--preshape", "centrical"}, "--sdh");
  refused({"--sdh", sdh}, "--preshape");
  refused({"--sdh", sdh, "--preshape", "fist"}, "pinch-tilted");
  refused({"--sdh", sdh, "--preshape", "centrical", "--close", "1.5"}, "close");
  refused({"--sdh", sdh, "--preshape", "centrical", "--close", "nan"}, "close");
  refused({"--sdh", sdh, "--preshape", "centrical", "--velocity", "0"}, "velocity");
  refused({"--sdh", sdh, "--preshape", "centrical", "--velocity", "inf"}, "velocity");
  refused({"--sdh", sdh, "--preshape", "centrical", "--mode", "crush"}, "mode");
  refused({"--sdh", sdh, "--preshape", "centrical", "--mode", "reactive"}, "--dsa");
  refused({"--sdh", sdh, "--preshape", "centrical", "--limit", "100"}, "limit");
  refused({"--sdh",
           sdh,
           "--dsa",
           bench.hand->dsaPort(),
           "--preshape",
           "centrical",
           "--mode",
           "reactive",
           "--limit",
           "2"},
          "limit");
  EXPECT_TRUE(bench.log.all().empty());
}

TEST(GraspCommand, AHandThatDoesNotAnswerIsOneLine) {
  const TemporaryFolder folder;
  const auto result = palpate({"grasp",
                               "--sdh",
                               folder / "nothing",
                               "--preshape",
                               "centrical",
                               "--wait",
                               "0.3",
                               "--quiet"});
  expectOneLineError(result, 1, {"nothing"});
  EXPECT_EQ(result.out, "");
}

TEST(GraspCommand, OverTheLimitAlreadyIsRefused) {
  auto still = std::make_unique<StillHand>(std::vector<double>{60, -75, 75, -75, 75, -75, 75});
  still->values[3] = 900;
  EmulatedBench bench(std::move(still), {.rate = EmulationRate::kFixed, .hz = 60.0});
  const auto result = palpate({"grasp",
                               "--sdh",
                               bench.hand->sdhPort(),
                               "--dsa",
                               bench.hand->dsaPort(),
                               "--preshape",
                               "centrical",
                               "--mode",
                               "reactive"});
  expectOneLineError(result, 1, {"over the limit of 200 already", "900 counts"});
  EXPECT_TRUE(bench.log.deeds().empty());
}

TEST(GraspCommand, LimitsOfFingersAndInNewtonsAreChecked) {
  const auto wrong = [](std::vector<std::string> more) {
    std::vector<std::string> words{
        "grasp", "--sdh", "/dev/null", "--dsa", "/dev/null", "--preshape", "centrical"};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = palpate(words);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    return result.err;
  };
  EXPECT_NE(wrong({"--finger-limits", "200,200,200"}).find("needs --mode"), std::string::npos);
  EXPECT_NE(wrong({"--mode", "reactive", "--finger-limits", "200,200"}).find("takes 3 numbers"),
            std::string::npos);
  EXPECT_NE(
      wrong({"--mode", "reactive", "--finger-limits", "200,2,200"}).find("is not a count in 3"),
      std::string::npos);
  EXPECT_NE(wrong({"--mode", "reactive", "--force-limit", "2"}).find("need one another"),
            std::string::npos);
  EXPECT_NE(
      wrong({"--mode", "reactive", "--force-limit", "0", "--calibration", "x"}).find("0.05..500"),
      std::string::npos);
}

}  // namespace
}  // namespace palpate::grasp_command_test
