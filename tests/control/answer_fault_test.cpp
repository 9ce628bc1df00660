// The motion controller's answers are damaged, invalid or missing while the hand moves or holds: a
// stop is on the wire in time, whatever the fault and the motion (docs/notes/safety.md).
#include <map>
#include <tuple>

#include "palpate/control/empty_hand_cycle.h"
#include "palpate/control/motion_sequence.h"

#include "control/answer_fault_bench.h"
#include "testing/testing.h"

namespace palpate::answer_fault_test {
namespace {

using testing::AnswerFault;
using Bench = testing::AnswerFaultBench;

enum class Motion {
  kPlain,
  kReactive,
  kSlipAware,
  kHolding,
  kEasing,
  kJoint,
  kPose,
  kSequence,
  kOpening,
  kEmptyHand
};

// docs/notes/safety.md: from the first bad answer to the stop.
double limitS(Motion motion) {
  const bool isTactile = motion == Motion::kReactive || motion == Motion::kSlipAware ||
                         motion == Motion::kHolding || motion == Motion::kEasing ||
                         motion == Motion::kEmptyHand;
  return isTactile ? 0.2 : 0.5;
}

GraspRequest closing(GraspMode mode) {
  GraspRequest request;
  request.mode = mode;
  request.closeRatio = 1.0;
  request.limitCounts = 200;
  return request;
}

// Brings the hand into the motion, and keeps what runs it.
struct Mover {
  Bench& bench;
  SequenceRun sequence{*bench.control};
  EmptyHandCycle cycle{*bench.control, {}};

  void begin(Motion motion) {
    switch (motion) {
      case Motion::kPlain:
        return grasp(closing(GraspMode::kPlain));
      case Motion::kReactive:
        return grasp(closing(GraspMode::kReactive));
      case Motion::kSlipAware:
        return grasp(closing(GraspMode::kSlip));
      case Motion::kHolding:
        grasp(closing(GraspMode::kSlip));
        bench.counts = 250.0F;
        ASSERT_TRUE(bench.awaitPhase(GraspPhase::kHolding));
        return;
      case Motion::kEasing: {
        GraspRequest kept = closing(GraspMode::kReactive);
        kept.keepsLimit = true;
        grasp(kept);
        bench.counts = 250.0F;
        ASSERT_TRUE(bench.awaitPhase(GraspPhase::kEasing));
        // The first step, which doesn't end.
        const int moves = bench.hand.moves;
        ASSERT_TRUE(bench.passUntil([&] { return bench.hand.moves > moves; }, 2.0));
        return bench.pass(0.1);
      }
      case Motion::kJoint: {
        GraspRequest joint;
        joint.targetDeg.resize(7);
        joint.targetDeg[2] = 50.0;
        return grasp(joint);
      }
      case Motion::kPose: {
        GraspRequest pose;
        pose.targetDeg = {10.0, -20.0, 30.0, -40.0, 50.0, -50.0, 60.0};
        return grasp(pose);
      }
      case Motion::kSequence: {
        MotionSequence steps;
        steps.hand = bench.session->device().hand().name;
        SequenceStep step;
        step.kind = SequenceStep::Kind::kGrasp;
        step.request = closing(GraspMode::kPlain);
        steps.steps = {step, step};
        sequence.begin(steps, bench.session->device().hand(), bench.session->nowUs());
        return bench.pass(0.3);
      }
      case Motion::kOpening:
        bench.control->preshape("centrical", 10.0);
        return bench.pass(0.3);
      case Motion::kEmptyHand:
        cycle.begin(bench.session->nowUs());
        return bench.pass(0.3);
    }
  }
  void grasp(const GraspRequest& request) {
    bench.control->grasp(request);
    bench.pass(0.3);
  }
};

class AnswerFaultTest : public ::testing::TestWithParam<std::tuple<AnswerFault, Motion>> {};

TEST_P(AnswerFaultTest, AStopIsOnTheWireInTimeAndTheHandIsKnownToBeStillInTheEnd) {
  const auto [fault, motion] = GetParam();
  Bench bench;
  Mover mover{bench};
  mover.begin(motion);
  if (::testing::Test::HasFatalFailure()) return;
  bench.clearStops();
  const int moves = bench.hand.moves;
  bench.fault = fault;
  const auto stopped = [&] { return bench.stops() > 0; };
  ASSERT_TRUE(bench.passUntil(stopped, 3.0));
  ASSERT_GT(bench.firstFaultUs, 0);
  EXPECT_LE(static_cast<double>(bench.firstStopUs - bench.firstFaultUs) / kUsPerS, limitS(motion));
  // It stays so for a while: stops go on, and nothing else moves the hand.
  bench.pass(2.0);
  EXPECT_GE(bench.stops(), 3);
  EXPECT_NE(bench.control->status().phase, GraspPhase::kIdle) << "it is not known to be still";
  bench.fault.reset();
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kIdle));
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kFailed);
  EXPECT_EQ(bench.control->status().last->text.find("state unknown"), std::string::npos);
  EXPECT_NE(bench.control->status().last->text.find("no stop was answered for"), std::string::npos)
      << "how long the hand was without control is said";
  bench.pass(1.0);
  EXPECT_FALSE(mover.sequence.running());
  EXPECT_TRUE(mover.cycle.takeProblem().has_value() || motion != Motion::kEmptyHand);
  EXPECT_EQ(bench.hand.moves, moves) << "nothing moves it again";
}

TEST_P(AnswerFaultTest, EndsWithoutAnAnswerAndSaysThatTheStateIsUnknown) {
  const auto [fault, motion] = GetParam();
  Bench bench;
  Mover mover{bench};
  mover.begin(motion);
  if (::testing::Test::HasFatalFailure()) return;
  bench.fault = fault;
  const std::int64_t fromUs = bench.session->nowUs();
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kIdle, 60.0));
  const GraspReport last = *bench.control->status().last;
  EXPECT_EQ(last.outcome, GraspOutcome::kFailed);
  EXPECT_NE(last.text.find("state unknown: use the power switch"), std::string::npos) << last.text;
  // After the rest of the announced 4.51 s, half a second and 10 s.
  EXPECT_LT(static_cast<double>(last.endUs - fromUs) / kUsPerS, 15.02);
}

std::string nameOf(AnswerFault fault) {
  static const std::map<AnswerFault, std::string> names{{AnswerFault::kChecksum, "BadChecksum"},
                                                        {AnswerFault::kNan, "Nan"},
                                                        {AnswerFault::kStateError, "StateError"},
                                                        {AnswerFault::kGarbage, "Garbage"},
                                                        {AnswerFault::kMute, "Mute"},
                                                        {AnswerFault::kShort, "Short"},
                                                        {AnswerFault::kEcho, "Echo"},
                                                        {AnswerFault::kBabble, "Babble"}};
  return names.at(fault);
}
std::string nameOf(Motion motion) {
  static const std::map<Motion, std::string> names{{Motion::kPlain, "Plain"},
                                                   {Motion::kReactive, "Reactive"},
                                                   {Motion::kSlipAware, "SlipAware"},
                                                   {Motion::kHolding, "Holding"},
                                                   {Motion::kEasing, "Easing"},
                                                   {Motion::kJoint, "Joint"},
                                                   {Motion::kPose, "Pose"},
                                                   {Motion::kSequence, "Sequence"},
                                                   {Motion::kOpening, "Opening"},
                                                   {Motion::kEmptyHand, "EmptyHand"}};
  return names.at(motion);
}

std::vector<std::tuple<AnswerFault, Motion>> table() {
  std::vector<std::tuple<AnswerFault, Motion>> rows;
  for (int fault = 0; fault <= static_cast<int>(AnswerFault::kBabble); ++fault)
    for (int motion = 0; motion <= static_cast<int>(Motion::kEmptyHand); ++motion)
      rows.emplace_back(static_cast<AnswerFault>(fault), static_cast<Motion>(motion));
  // A hand that holds is at rest, and its states are not asked for.
  std::erase(rows, std::tuple(AnswerFault::kStateError, Motion::kHolding));
  return rows;
}

INSTANTIATE_TEST_SUITE_P(
    Table, AnswerFaultTest, ::testing::ValuesIn(table()), [](const auto& instance) {
      return nameOf(std::get<0>(instance.param)) + nameOf(std::get<1>(instance.param));
    });

class OneInAHundredTest : public ::testing::TestWithParam<Motion> {};

TEST_P(OneInAHundredTest, DamagedAnswersStopNothingInTenMinutes) {
  Bench bench;
  // The state machine's own time limit of a motion is 3 times the announced one, and 5 s.
  bench.hand.announcedS = 3000.0;
  Mover mover{bench};
  mover.begin(GetParam());
  if (::testing::Test::HasFatalFailure()) return;
  const GraspPhase phase = bench.control->status().phase;
  bench.clearStops();
  bench.damagedShare = 0.01;
  bench.pass(600.0);
  EXPECT_EQ(bench.stops(), 0);
  EXPECT_EQ(bench.control->status().phase, phase);
  EXPECT_GT(bench.numBad, 200u);
}

INSTANTIATE_TEST_SUITE_P(Motions,
                         OneInAHundredTest,
                         ::testing::Values(Motion::kPlain,
                                           Motion::kReactive,
                                           Motion::kSlipAware,
                                           Motion::kHolding,
                                           Motion::kOpening),
                         [](const auto& instance) { return nameOf(instance.param); });

TEST(AnswerFault, AReadingOverTheLimitSendsTheStopAgainAndIsReportedOnce) {
  Bench bench;
  Mover{bench}.grasp(closing(GraspMode::kReactive));
  bench.fault = AnswerFault::kMute;
  ASSERT_TRUE(bench.passUntil([&] { return bench.stops() > 0; }, 1.0));
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kStopping));
  bench.counts = 900.0F;
  bench.pass(1.0);
  bench.fault.reset();
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kIdle));
  EXPECT_EQ(bench.numReported("over the limit"), 1u);
}

// STOP says that the hand has read the line, not that its axes have stopped.
TEST(AnswerFault, AxesThatMoveOnAfterAnAnsweredStopGetAnother) {
  Bench bench;
  Mover{bench}.grasp(closing(GraspMode::kPlain));
  bench.hand.ignoredStops = 1;
  bench.control->stop();
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kIdle));
  bench.pass(1.5);
  EXPECT_GE(bench.stops(), 2);
  EXPECT_EQ(bench.hand.values["state"], std::vector<double>(7, 0.0));
}

// Then one lost answer is no reason to open the port again.
TEST(AnswerFault, AtRestAHandWithoutAnObjectMayBeSilentForASecond) {
  Bench bench;
  Mover{bench}.grasp(closing(GraspMode::kReactive));
  bench.control->stop();
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kIdle));
  bench.pass(0.5);
  bench.clearStops();
  bench.fault = AnswerFault::kMute;
  bench.pass(0.9);
  bench.fault.reset();
  bench.pass(3.0);
  EXPECT_EQ(bench.stops(), 0);
  EXPECT_TRUE(bench.control->status().cannotMove.empty());
}

TEST(AnswerFault, WhoRelaxesAHandThatDoesNotAnswerHasItsMotorsOffOnceItDoes) {
  Bench bench;
  Mover{bench}.grasp(closing(GraspMode::kPlain));
  bench.fault = AnswerFault::kMute;
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kStopping));
  bench.pass(0.5);
  bench.control->relax();
  bench.pass(1.0);
  EXPECT_EQ(bench.control->status().phase, GraspPhase::kStopping) << "the stops go on";
  EXPECT_FALSE(bench.control->status().motorsOff);
  bench.fault.reset();
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kIdle));
  bench.pass(0.5);
  EXPECT_TRUE(bench.control->status().motorsOff);
  EXPECT_EQ(bench.hand.values["power"], std::vector<double>(7, 0.0));
}

// A port that is pulled takes no byte; what the hand does then is told as before.
TEST(AnswerFault, AnUnpluggedPortEndsTheGraspAtOnce) {
  Bench bench;
  Mover{bench}.grasp(closing(GraspMode::kReactive));
  bench.unplug();
  ASSERT_TRUE(bench.awaitPhase(GraspPhase::kIdle, 0.5));
  EXPECT_EQ(bench.control->status().last->outcome, GraspOutcome::kPortGone);
}

}  // namespace
}  // namespace palpate::answer_fault_test
