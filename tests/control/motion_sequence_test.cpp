#include "palpate/control/motion_sequence.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"

#include "control/scripted_hand.h"
#include "control/sequence_steps.h"

namespace palpate::motion_sequence_test {
namespace {

using namespace testing;

using Kind = SequenceStep::Kind;

class SequenceRunTest : public ::testing::Test {
 protected:
  std::int64_t now() const { return bench_.clock.hostUs(); }
  std::size_t numMotions() const { return bench_.hand->count<MoveJoints>(); }
  // Advances by frames of 30 ms. The hand is still, so each motion ends after its announced second.
  void pass(double seconds, float counts = 0.0F) {
    bench_.feel(static_cast<int>(std::lround(seconds / 0.03)), counts);
  }
  bool reach(std::size_t step) {
    for (int i = 0; i < 1000 && run_.running() && run_.status().step != step; ++i) pass(0.03);
    return run_.running() && run_.status().step == step;
  }

  testing::GraspBench bench_;
  SequenceRun run_{*bench_.control};
};

TEST_F(SequenceRunTest, DoesTheStepsInOrderAndRepeatsThem) {
  MotionSequence sequence = everyKind();
  sequence.repetitions = 3;
  run_.begin(sequence, sdh2(), now());
  EXPECT_EQ(run_.status().text, "step 1 of 5, 1 of 3 times: opening: centrical, 100 deg/s");
  for (int repetition = 0; repetition < 3; ++repetition)
    for (std::size_t step = 0; step < 5; ++step) {
      ASSERT_TRUE(reach(step)) << run_.status().text;
      EXPECT_EQ(run_.status().repetition, repetition);
    }
  pass(1.2);
  EXPECT_FALSE(run_.running());
  EXPECT_FALSE(run_.status().failed);
  EXPECT_EQ(run_.status().text, "sequence finished: 5 steps, 3 times");
  ASSERT_EQ(numMotions(), 9u);
  std::vector<MoveJoints> moves;
  for (const DeviceCommand& command : bench_.hand->commands)
    if (const auto* move = std::get_if<MoveJoints>(&command)) moves.push_back(*move);
  EXPECT_EQ(moves[0].targetDeg, (std::vector<double>{60, -75, 75, -75, 75, -75, 75}));
  EXPECT_EQ(moves[4].targetDeg, (std::vector<double>{30, -40, 40, -40, 40, -40, 40}));
}

TEST_F(SequenceRunTest, HoldsForItsTime) {
  MotionSequence sequence = everyKind();
  sequence.steps = {resting(Kind::kHold, 2.0), opening()};
  run_.begin(sequence, sdh2(), now());
  pass(1.92);
  EXPECT_EQ(run_.status().step, 0u);
  EXPECT_EQ(numMotions(), 0u);
  pass(0.12);
  EXPECT_EQ(run_.status().step, 1u);
  EXPECT_EQ(numMotions(), 1u);
}

TEST_F(SequenceRunTest, AStopInEachStepEndsTheSequence) {
  for (const bool relaxed : {false, true})
    for (std::size_t step = 0; step < 5; ++step) {
      MotionSequence sequence = everyKind();
      sequence.repetitions = 2;
      run_.begin(sequence, sdh2(), now());
      ASSERT_TRUE(reach(step)) << step;
      relaxed ? bench_.control->relax() : bench_.control->stop();
      const std::size_t motions = numMotions();
      pass(6.0);
      EXPECT_FALSE(run_.running());
      EXPECT_TRUE(run_.status().failed);
      EXPECT_NE(run_.status().text.find("step " + std::to_string(step + 1) + " of 5"),
                std::string::npos)
          << run_.status().text;
      EXPECT_EQ(numMotions(), motions) << "no motion follows the stop in step " << step;
    }
}

// After the step's time is over, and before the control cycle begins the next motion.
TEST_F(SequenceRunTest, AStopAtTheEndOfAStepLetsNoMotionFollow) {
  MotionSequence sequence = everyKind();
  sequence.steps = {resting(Kind::kWait, 0.5), opening()};
  run_.begin(sequence, sdh2(), now());
  pass(0.48);
  bench_.clock.pass(100'000);
  bench_.control->stop();
  bench_.control->step();
  EXPECT_EQ(numMotions(), 0u);
  EXPECT_FALSE(run_.running());
}

TEST_F(SequenceRunTest, AMotionPortThatIsGoneInEachStepEndsTheSequence) {
  for (std::size_t step = 0; step < 5; ++step) {
    run_.begin(everyKind(), sdh2(), now());
    ASSERT_TRUE(reach(step)) << step;
    bench_.hand->state.motion->state = PortState::kLost;
    bench_.hand->state.motion->unplugged = true;
    pass(0.3);
    EXPECT_FALSE(run_.running()) << step;
    EXPECT_TRUE(run_.status().failed);
    bench_.hand->state.motion->state = PortState::kStreaming;
    const std::size_t motions = numMotions();
    pass(6.0);
    EXPECT_EQ(numMotions(), motions) << "it doesn't go on when the port is back";
  }
}

TEST_F(SequenceRunTest, SilenceOfTheTactileStreamEndsAHold) {
  MotionSequence sequence = everyKind();
  sequence.steps = {resting(Kind::kHold, 5.0), opening()};
  run_.begin(sequence, sdh2(), now());
  pass(1.0);
  bench_.wait(300'000);
  run_.step(now());
  EXPECT_FALSE(run_.running());
  EXPECT_NE(run_.status().text.find("no tactile frames come"), std::string::npos)
      << run_.status().text;
  EXPECT_EQ(numMotions(), 0u);
}

// A hold watches the tactile stream; a changed setting interrupts that for half a second.
TEST_F(SequenceRunTest, ASettingThatIsChangedInAHoldDelaysTheNextStepOnly) {
  MotionSequence sequence = everyKind();
  sequence.steps = {resting(Kind::kHold, 1.0), grasping(GraspMode::kReactive)};
  run_.begin(sequence, sdh2(), now());
  pass(0.9);
  bench_.hand->answers = false;
  const auto answer = bench_.control->change(SetSensitivity{1, 0.7});
  pass(0.6);
  EXPECT_TRUE(run_.running()) << run_.status().text;
  EXPECT_EQ(run_.status().step, 0u);
  EXPECT_EQ(numMotions(), 0u);
  bench_.hand->answers = true;
  bench_.hand->waiting.at(0).set_value({});
  pass(0.1);
  EXPECT_EQ(run_.status().step, 1u) << run_.status().text;
  EXPECT_EQ(numMotions(), 1u);
}

TEST_F(SequenceRunTest, AnAlarmEndsItAndStopsTheHand) {
  run_.begin(everyKind(), sdh2(), now());
  run_.end("motor 3 is too hot");
  EXPECT_EQ(bench_.hand->count<StopMotion>(), 1u);
  EXPECT_EQ(run_.status().text, "sequence ended in step 1 of 5: motor 3 is too hot");
  pass(6.0);
  EXPECT_EQ(numMotions(), 1u);
}

// A defect of what moves the hand in steps: a stop first, and it is said.
TEST_F(SequenceRunTest, ATaskThatThrowsStopsTheHandAndRaisesAnAlarm) {
  struct Broken : ControlTask {
    void step(std::int64_t) override { throw std::bad_alloc(); }
  } broken;
  run_.begin(everyKind(), sdh2(), now());
  bench_.control->advance(broken);
  bench_.feel(1);
  bench_.control->forget(broken);
  EXPECT_GE(bench_.hand->count<StopMotion>(), 1u);
  pass(6.0);
  EXPECT_FALSE(run_.running());
  EXPECT_EQ(numMotions(), 1u);
  const auto events = bench_.session->takeEvents();
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const Event& event) {
    return event.kind == "alarm" && event.text.find("the program failed") != std::string::npos;
  }));
}

// Nobody but the control cycle has to notice it.
TEST_F(SequenceRunTest, AHandThatIsTooHotEndsItAndBeginsNone) {
  const auto measure = [&](double degC) {
    Sample temperatures{0, {}, kTemperatureSeries};
    temperatures.hostUs = now();
    temperatures.values.assign(sdh2().temperatureSensors.size(), 40.0);
    temperatures.values[1] = degC;
    bench_.hand->sink->onSample(std::move(temperatures));
  };
  const std::string hot = sdh2().temperatureSensors[1].name + " 65.1 °C";
  run_.begin(everyKind(), sdh2(), now());
  measure(65.0);
  pass(0.03);
  EXPECT_TRUE(run_.running()) << "the limit itself is allowed";
  measure(65.1);
  pass(0.03);
  EXPECT_FALSE(run_.running());
  EXPECT_EQ(run_.status().text, "sequence ended in step 1 of 5: too hot: " + hot);
  EXPECT_EQ(bench_.hand->count<StopMotion>(), 1u);
  pass(6.0);
  EXPECT_EQ(numMotions(), 1u);
  try {
    run_.begin(everyKind(), sdh2(), now());
    FAIL() << "it began";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("too hot: " + hot), std::string::npos) << error.what();
  }
  measure(64.0);
  pass(0.03);
  EXPECT_NO_THROW(run_.begin(everyKind(), sdh2(), now()));
}

TEST_F(SequenceRunTest, ARefusedStepEndsItThere) {
  MotionSequence sequence = everyKind();
  sequence.steps = {opening(), grasping(GraspMode::kReactive)};
  run_.begin(sequence, sdh2(), now());
  pass(3.0, 900.0F);  // the reactive grasp is over its limit already
  EXPECT_FALSE(run_.running());
  EXPECT_NE(run_.status().text.find("step 2 of 2"), std::string::npos) << run_.status().text;
  EXPECT_NE(run_.status().text.find("over the limit"), std::string::npos) << run_.status().text;
  EXPECT_EQ(numMotions(), 1u);
}

TEST_F(SequenceRunTest, ABlockedOpeningEndsIt) {
  run_.begin(everyKind(), sdh2(), now());
  bench_.hand->states = {0, 4, 0, 0, 0, 0, 0};
  pass(2.0);
  EXPECT_FALSE(run_.running());
  EXPECT_NE(run_.status().text.find("held at the joints: finger 0 proximal"), std::string::npos)
      << run_.status().text;
  EXPECT_EQ(numMotions(), 1u);
  EXPECT_GE(bench_.hand->count<StopMotion>(), 1u) << "motors that push are stopped";
}

TEST_F(SequenceRunTest, AMotionOfSomebodyElseEndsIt) {
  MotionSequence sequence = everyKind();
  sequence.steps = {resting(Kind::kWait, 5.0), opening()};
  run_.begin(sequence, sdh2(), now());
  pass(0.3);
  bench_.control->preshape("parallel", 5.0);
  pass(0.3);
  EXPECT_FALSE(run_.running());
  pass(8.0);
  EXPECT_EQ(numMotions(), 1u);
}

TEST_F(SequenceRunTest, NothingBeginsThatIsNotValid) {
  const auto refused = [&](const MotionSequence& sequence) {
    EXPECT_THROW(run_.begin(sequence, sdh2(), now()), std::invalid_argument);
    EXPECT_FALSE(run_.running());
    EXPECT_TRUE(bench_.hand->commands.empty());
  };
  MotionSequence sequence = everyKind();
  sequence.steps.clear();
  refused(sequence);
  sequence = everyKind();
  sequence.hand = "another";
  refused(sequence);
  for (const int repetitions : {0, -1, 10'001}) {
    sequence = everyKind();
    sequence.repetitions = repetitions;
    refused(sequence);
  }
  sequence = everyKind();
  sequence.steps[3].seconds = std::nan("");
  refused(sequence);
  sequence = everyKind();
  sequence.steps[1].pose.anglesDeg[2] = 120.0;  // of the second step: the first doesn't move
  refused(sequence);
  sequence = everyKind();
  sequence.steps[2].request.limitCounts = 4000;
  refused(sequence);
  sequence = everyKind();
  sequence.steps[2] = grasping(GraspMode::kSlip);  // would hold for ever
  refused(sequence);
  sequence.steps[2].request.holding.holdS = 2.0;
  EXPECT_NO_THROW(sequence.validate(sdh2()));
  sequence = everyKind();
  run_.begin(sequence, sdh2(), now());
  EXPECT_THROW(run_.begin(sequence, sdh2(), now()), DeviceError) << "one at a time";
}

TEST(MotionSequence, IsReadAsItWasWritten) {
  MotionSequence sequence = everyKind();
  sequence.repetitions = 12;
  SequenceStep slip = grasping(GraspMode::kSlip, 0.9, 15.0);
  slip.request.startRatio = 0.25;
  slip.request.limitCounts = 400;
  slip.request.fingerLimitCounts = {400, 300, 200};
  slip.request.forceLimitsN = {2.5};
  slip.request.holding.holdS = 3.0;
  slip.request.holding.loosen = true;
  slip.request.holding.weightN = 1.5;
  slip.request.keepsLimit = true;
  slip.request.object = "tin \"A\"";
  slip.request.touchRatio = 0.75;
  sequence.steps.push_back(slip);
  sequence.steps.push_back(grasping(GraspMode::kPlain, 0.3));
  const std::string text = sequenceText(sequence);
  const MotionSequence read = parseSequence(text, "s.json");
  EXPECT_EQ(sequenceText(read), text);
  EXPECT_EQ(read.repetitions, 12);
  ASSERT_EQ(read.steps.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_EQ(describe(read.steps[i]), describe(sequence.steps[i]));
  EXPECT_EQ(read.steps[5].request.fingerLimitCounts, (std::vector<int>{400, 300, 200}));
  EXPECT_TRUE(read.steps[5].request.holding.loosen);
  EXPECT_TRUE(read.steps[5].request.keepsLimit);
  EXPECT_EQ(read.steps[5].request.object, "tin \"A\"");
  EXPECT_EQ(read.steps[5].request.touchRatio, 0.75);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_FALSE(read.steps[i].request.keepsLimit) << i;
    EXPECT_EQ(read.steps[i].request.object, "") << i;
    EXPECT_EQ(read.steps[i].request.touchRatio, std::nullopt) << i;
  }
  EXPECT_NO_THROW(read.validate(sdh2()));
}

// As they were recorded: grasps of such tables stayed above their limit.
TEST(MotionSequence, TablesOfEarlierVersionsKeepNoLimit) {
  const MotionSequence read = parseSequence(
      R"({"format": "palpate-sequence", "version": 1, "hand": "SCHUNK SDH-2", "steps": [
           {"step": "grasp", "mode": "reactive", "preshape": "parallel", "close": 1,
            "velocity_deg_per_s": 10, "limit_counts": 200}]})",
      "s.json");
  ASSERT_EQ(read.steps.size(), 1u);
  EXPECT_EQ(read.steps[0].request.limitCounts, 200);
  EXPECT_FALSE(read.steps[0].request.keepsLimit);
  EXPECT_EQ(read.steps[0].request.object, "");
}

TEST(MotionSequence, AStepThatKeepsItsLimitIsChecked) {
  MotionSequence sequence = everyKind();
  SequenceStep kept = grasping(GraspMode::kReactive, 0.9);
  kept.request.keepsLimit = true;
  sequence.steps = {kept};
  EXPECT_NO_THROW(sequence.validate(sdh2()));
  sequence.steps[0].request.object = std::string(101, 'x');
  EXPECT_THROW(sequence.validate(sdh2()), std::invalid_argument);
  sequence.steps[0].request.object = "";
  sequence.steps[0].request.touchRatio = 1.5;
  EXPECT_THROW(sequence.validate(sdh2()), std::invalid_argument);
}

TEST(MotionSequence, BadFilesAreRefusedWithTheirPlace) {
  const auto errorOf = [](const std::string& text) {
    try {
      parseSequence(text, "s.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(errorOf("no").find("s.json"), std::string::npos);
  EXPECT_NE(errorOf("[]").find("not a sequence"), std::string::npos);
  const std::string head =
      R"({"format": "palpate-sequence", "version": 1, "hand": "h", "steps": [)";
  EXPECT_NE(errorOf(head + R"({"step": "jump"}]})").find("steps[0].step"), std::string::npos);
  EXPECT_NE(errorOf(head + R"({"step": "hold", "seconds": -1}]})").find("seconds"),
            std::string::npos);
  EXPECT_NE(errorOf(head + R"({"step": "open", "velocity_deg_per_s": 500}]})").find("velocity"),
            std::string::npos);
  EXPECT_NE(errorOf(R"({"format": "palpate-sequence", "version": 9})").find("version"),
            std::string::npos);
}

}  // namespace
}  // namespace palpate::motion_sequence_test
