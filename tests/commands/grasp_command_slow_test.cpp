// The real program grasps with an emulated hand until a limit, in real time: frames that come late
// stop it.
#include <algorithm>
#include <fstream>

#include "palpate/control/motion_sequence.h"
#include "palpate/device/sdh2.h"

#include "commands/grasp_lines.h"
#include "commands/palpate_program.h"
#include "control/emulated_bench.h"

namespace palpate::grasp_command_slow_test {
namespace {
using namespace testing;

ProgramResult graspReactively(EmulatedBench& bench, const std::vector<std::string>& more) {
  std::vector<std::string> words{"grasp",
                                 "--sdh",
                                 bench.hand->sdhPort(),
                                 "--dsa",
                                 bench.hand->dsaPort(),
                                 "--preshape",
                                 "centrical",
                                 "--mode",
                                 "reactive"};
  words.insert(words.end(), more.begin(), more.end());
  return palpate(words);
}

TEST(GraspCommand, ReactiveGraspStopsAtTheBall) {
  EmulatedBench bench(handWith("ball"));
  const auto result = graspReactively(bench, {"--quick", "--velocity", "60", "--limit", "400"});
  ASSERT_EQ(result.exitCode, 0) << result.err << result.out;
  EXPECT_EQ(statesOf(result.out),
            (States{"connecting",
                    "ready",
                    "preshaping",
                    "closing",
                    "stopping",
                    "settling",
                    "limit_reached"}));
  EXPECT_EQ(handOf(result.out), (States{"moving", "holding"}));
  EXPECT_NE(result.out.find(" counts"), std::string::npos);
  EXPECT_NE(result.out.find(" after the stop"), std::string::npos) << "what was reached";
  EXPECT_FALSE(bench.log.named("stop").empty());
  EXPECT_FALSE(bench.handMoves());
}

TEST(GraspCommand, AReactiveGraspKeepsItsLimit) {
  EmulatedBench bench(handWith("ball"));
  const auto result =
      graspReactively(bench, {"--object-size", "70", "--velocity", "60", "--limit", "1000"});
  ASSERT_EQ(result.exitCode, 0) << result.err << result.out;
  // 1000 counts and a rise of as many at 1000 / 800 deg/s.
  EXPECT_NE(result.out.find("ready: expect up to 2000 counts, 2.0 times the limit; touches in "),
            std::string::npos)
      << result.out;
  const std::vector<std::string> states = statesOf(result.out);
  EXPECT_NE(std::find(states.begin(), states.end(), "easing"), states.end()) << result.out;
  EXPECT_EQ(states.back(), "limit_reached") << result.out;
  float largest = 0.0F;
  std::vector<std::uint16_t> counts(sdh2().layout->numCells());
  bench.hand->withModel([&](HandModel& model) { model.scan(counts); });
  for (const std::uint16_t each : counts) largest = std::max(largest, static_cast<float>(each));
  EXPECT_GE(largest, 800.0F);
  EXPECT_LE(largest, 1200.0F);
}

TEST(GraspCommand, ReactiveGraspOfNothingCloses) {
  EmulatedBench bench(stillHand(), {.rate = EmulationRate::kFixed, .hz = 60.0});
  const auto result = graspReactively(bench, {"--quick", "--close", "0.5", "--velocity", "100"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(statesOf(result.out),
            (States{"connecting", "ready", "preshaping", "closing", "finished"}));
  std::vector<double> angles;
  bench.hand->withModel([&](HandModel& model) { angles = model.joints().angles(); });
  EXPECT_NEAR(angles[1], -34.0, 0.01);
}

TEST(GraspCommand, AGraspStopsAtTheLimitOfAFinger) {
  EmulatedBench bench(handWith("ball"));
  const auto result =
      graspReactively(bench, {"--quick", "--velocity", "60", "--finger-limits", "3000,3000,50"});
  ASSERT_EQ(result.exitCode, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("limit_reached: limit reached: finger 2"), std::string::npos)
      << result.out;
}

TEST(GraspCommand, ASequenceOfAFileIsDoneStepByStep) {
  EmulatedBench bench(stillHand(), {.rate = EmulationRate::kFixed, .hz = 30.0});
  const TemporaryFolder folder;
  MotionSequence sequence;
  sequence.hand = movableHand().name;
  SequenceStep step;
  step.kind = SequenceStep::Kind::kOpen;
  step.request.closeRatio = 0.0;
  step.request.velocityDegPerS = 90.0;
  SequenceStep rest;
  rest.seconds = 0.1;
  sequence.steps = {step, rest};
  sequence.repetitions = 2;
  const std::string file = (folder / "s.json").string();
  std::ofstream(file) << sequenceText(sequence);
  const auto result = palpate({"grasp", "--sdh", bench.hand->sdhPort(), "--sequence", file});
  ASSERT_EQ(result.exitCode, 0) << result.err << result.out;
  EXPECT_EQ(
      statesOf(result.out),
      (States{"connecting", "ready", "sequence", "sequence", "sequence", "sequence", "finished"}));
  EXPECT_EQ(bench.log.named("m").size(), 2u);
  std::ofstream(file) << "{}";
  const auto bad = palpate({"grasp", "--sdh", bench.hand->sdhPort(), "--sequence", file});
  EXPECT_EQ(bad.exitCode, 1);
  EXPECT_NE(bad.err.find("no sequence"), std::string::npos) << bad.err;
  const auto both = palpate(
      {"grasp", "--sdh", bench.hand->sdhPort(), "--sequence", file, "--preshape", "parallel"});
  EXPECT_EQ(both.exitCode, 2);
}

}  // namespace
}  // namespace palpate::grasp_command_slow_test
