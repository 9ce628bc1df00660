// One sentence for each state of the hand. The states come before each other as they stand here.
#include "gui/hand/hand_sentence.h"

#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"

namespace palpate::gui::hand_sentence_test {
namespace {

using Hand = HandFacts::Hand;

constexpr std::int64_t kNowUs = 60'000'000;
constexpr std::int64_t kEndUs = 50'000'000;

GraspReport reportOf(GraspOutcome outcome, const char* text = "the reason") {
  GraspReport report;
  report.outcome = outcome;
  report.text = text;
  report.endUs = kEndUs;
  return report;
}

struct Row {
  const char* name;
  std::function<void(HandFacts& facts, GraspStatus& status)> given;
  const char* text;
  bool bad = false;
  const char* why = "";  // of a motion that ended in another way than asked for
};

const std::vector<Row> kRows{
    {"NoHand", [](auto& facts, auto&) { facts.hand = Hand::kNone; }, "No hand is connected."},
    {"Stream",
     [](auto& facts, auto&) { facts.hand = Hand::kStreamed; },
     "This hand is read, not moved: its stream takes no commands."},
    {"Replay",
     [](auto& facts, auto&) { facts.hand = Hand::kReplayed; },
     "A recording is replayed: there is nothing to move."},
    {"Ready", [](auto&, auto&) {}, "Ready."},
    {"SequenceThatRests",
     [](auto& facts, auto& status) {
       facts.sequence = "step 2 of 5: hold: 2 s";
       status.last = reportOf(GraspOutcome::kFailed);
     },
     "step 2 of 5: hold: 2 s"},
    {"SequenceThatMoves",
     [](auto& facts, auto& status) {
       facts.sequence = "step 1 of 5: open";
       status.phase = GraspPhase::kClosing;
       status.request = GraspRequest{};
     },
     "step 1 of 5: open\nclosing"},
    // L-M13
    {"Opening",
     [](auto&, auto& status) {
       status.phase = GraspPhase::kClosing;
       status.request = GraspRequest{};
       status.request->closeRatio = 0.0;
     },
     "opening · centrical, 10 deg/s"},
    {"ClosingTellsHowFar",
     [](auto&, auto& status) {
       status.phase = GraspPhase::kClosing;
       status.request = GraspRequest{};
       status.anglesDeg = sdh2Preshape("centrical").anglesDeg(0.42);
     },
     "closing, at 0.42 · plain grasp: centrical, to 0.5, 10 deg/s"},
    {"ClosesSlowly",
     [](auto& facts, auto& status) {
       status.phase = GraspPhase::kClosing;
       status.request = GraspRequest{};
       facts.touchUnknown = true;
     },
     "closing · plain grasp: centrical, to 0.5, 10 deg/s\n"
     "Slowly: where it touches isn't known. For the next grasp, give its size (More)."},
    {"HoldingComesFirst",
     [](auto&, auto& status) {
       status.phase = GraspPhase::kHolding;
       status.holding = "for 3 s";
       status.friction = 0.687;
       status.request = GraspRequest{};
       status.request->targetDeg = {10.0};
       status.request->title = "axis 1";
     },
     "friction about 0.69\nfor 3 s · motion: axis 1, 10 deg/s"},
    {"EndOfAMotion", [](auto&, auto& status) { status.phase = GraspPhase::kStopping; }, "stopping"},
    {"FramesCeaseWhileItHolds",
     [](auto&, auto& status) {
       status.phase = GraspPhase::kHolding;
       status.running = reportOf(GraspOutcome::kNone);
       status.unwatchedMs = 400.0;
     },
     "Not protected: no tactile frames for 400 ms: the hand holds, without slip detection; it is "
     "watched again when frames are back within 1 s",
     true},
    {"NoStopIsAnswered",
     [](auto& facts, auto& status) {
       status.phase = GraspPhase::kStopping;
       status.cannotMove = "no answer";
       facts.refusal = "refused";
     },
     "Stop commands are sent, but the hand does not answer. If the hand moves, use the emergency "
     "stop or switch its power off. no answer",
     true},
    {"NoStopWasAnswered",
     [](auto&, auto& status) {
       status.cannotMove = "no answer";
       status.last = reportOf(GraspOutcome::kFailed);
       status.last->stateUnknown = true;
     },
     "No stop was answered: the state of the hand is unknown. If the hand moves, use the emergency "
     "stop or switch its power off. no answer",
     true},
    {"CannotMove",
     [](auto& facts, auto& status) {
       status.cannotMove = "no answer";
       facts.refusal = "refused";
     },
     "The hand can't be moved: no answer",
     true},
    {"UnpluggedAtRest",
     [](auto&, auto& status) {
       status.cannotMove = "gone";
       status.portGone = reportOf(GraspOutcome::kPortGone);
     },
     "The hand does not move; the motors are on and hold. The motion port is disconnected: plug it "
     "in again.",
     true},
    {"UnpluggedInAMotion",
     [](auto&, auto& status) {
       status.cannotMove = "gone";
       status.portGone = reportOf(GraspOutcome::kPortGone);
       status.portGone->remainingMotionS = 12.5;
       status.last = reportOf(GraspOutcome::kRefused);
     },
     "The hand is still moving to its target (up to 3 s). The window can't stop it: use the "
     "emergency stop, or switch its power off. The motion port is disconnected: plug it in again.",
     true},
    {"UnpluggedLongAgo",
     [](auto&, auto& status) {
       status.cannotMove = "gone";
       status.portGone = reportOf(GraspOutcome::kPortGone);
       status.portGone->remainingMotionS = 9.5;
     },
     "Its motion has ended, and the motors hold. The motion port is disconnected: plug it in "
     "again.",
     true},
    {"NotProtected",
     [](auto& facts, auto& status) {
       status.unprotected = "the port is gone";
       status.lastMotion = reportOf(GraspOutcome::kStreamLost);
       facts.refusal = "refused";
     },
     "Not protected: the port is gone. Use Hand > Acknowledge when you have seen it.\nrefused",
     true,
     "the port is gone"},
    {"Refused",
     [](auto& facts, auto& status) {
       facts.refusal = "noise lines are missing";
       facts.ownMotion = "closing";
       status.motorsOff = true;
     },
     "noise lines are missing",
     true},
    {"ActsByItself",
     [](auto& facts, auto& status) {
       facts.ownMotion = "closing";
       status.motorsOff = true;
     },
     "The emulated hand follows the script of its scene: closing. Stop (Esc) or any command you "
     "send ends it."},
    {"SceneStopped",
     [](auto& facts, auto&) { facts.sceneStopped = true; },
     "Stopped. The hand no longer follows a script, and holds what it held; what its scene does to "
     "objects, such as a pull, continues."},
    {"MotorsOff",
     [](auto& facts, auto& status) {
       status.motorsOff = true;
       facts.foundMovingUs = kEndUs;
     },
     "The motors are off: the fingers can be moved by hand, and an object may fall. The next "
     "motion "
     "switches them on."},
    {"FoundMoving",
     [](auto& facts, auto& status) {
       status.last = reportOf(GraspOutcome::kFinished);
       facts.foundMovingUs = kEndUs + 1;
     },
     "The hand was moving unattended when it was connected: it was stopped. Ready.",
     true},
    {"FoundMovingBeforeTheLastMotion",
     [](auto& facts, auto& status) {
       status.last = reportOf(GraspOutcome::kFinished, "finished");
       facts.foundMovingUs = kEndUs - 1;
     },
     "finished"},
    {"UnpluggedDuringTheLastMotion",
     [](auto&, auto& status) { status.last = reportOf(GraspOutcome::kPortGone); },
     "Ready. The motion port was disconnected during a motion; when it came back, the hand was "
     "stopped."},
    {"UnpluggedSince",
     [](auto& facts, auto& status) {
       status.last = reportOf(GraspOutcome::kFinished);
       facts.goneUs = kEndUs + 1;
     },
     "Ready. The motion port was disconnected, and is back."},
    {"LimitCanBeMeasuredNow",
     [](auto& facts, auto& status) {
       status.last = reportOf(GraspOutcome::kRefused);
       facts.limitMeasurable = true;
     },
     "Ready. The last grasp was refused: its limit couldn't be measured; now it can."},
    {"FramesAreBack",
     [](auto&, auto& status) { status.last = reportOf(GraspOutcome::kStreamLost); },
     "Ready. The last grasp was stopped: no tactile frames arrived; they arrive again."},
    {"FramesAreNotBack",
     [](auto&, auto& status) {
       status.last = reportOf(GraspOutcome::kStreamLost);
       status.cannotReact = "no tactile frames arrive";
     },
     "the reason",
     true,
     "the reason"},
    {"Stopped",
     [](auto&, auto& status) {
       status.last = reportOf(GraspOutcome::kStopped);
       status.last->friction = 0.4;
     },
     "friction about 0.40\nthe reason"},
    {"FrictionIsSaidOnce",
     [](auto&, auto& status) {
       status.last = reportOf(GraspOutcome::kFinished, "friction about 0.40; it holds");
       status.last->friction = 0.4;
     },
     "friction about 0.40; it holds"},
    {"FrictionOfAnotherGrasp",
     [](auto&, auto& status) {
       status.phase = GraspPhase::kPreshaping;
       status.request = GraspRequest{};
       status.request->closeRatio = 0.0;
       status.last = reportOf(GraspOutcome::kFinished);
       status.last->friction = 0.4;
     },
     "preshaping · opening: centrical, 10 deg/s"},
    {"Failed",
     [](auto&, auto& status) { status.last = reportOf(GraspOutcome::kFailed); },
     "the reason",
     true,
     "the reason"}};

class HandSentenceTest : public ::testing::TestWithParam<Row> {};

TEST_P(HandSentenceTest, IsThatOfTheTable) {
  const Row& row = GetParam();
  HandFacts facts{.hand = Hand::kMovable, .nowUs = kNowUs};
  row.given(facts, facts.status);
  const HandSentence said = handSentence(facts);
  EXPECT_EQ(said.text.toStdString(), row.text);
  EXPECT_EQ(said.bad, row.bad);
  EXPECT_EQ(said.why.toStdString(), row.why);
  EXPECT_EQ(said.endUs, said.why.isEmpty() ? 0 : kEndUs);
}

INSTANTIATE_TEST_SUITE_P(States, HandSentenceTest, ::testing::ValuesIn(kRows), [](const auto& row) {
  return std::string(row.param.name);
});

}  // namespace
}  // namespace palpate::gui::hand_sentence_test
