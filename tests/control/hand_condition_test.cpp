// One word for each phase and each end of a grasp.
#include "palpate/control/hand_condition.h"

#include "palpate/control/grasp_control.h"

#include "testing/testing.h"

namespace palpate::hand_condition_test {
namespace {

using C = HandCondition;

constexpr GraspMode kModes[] = {GraspMode::kPlain, GraspMode::kReactive, GraspMode::kSlip};
constexpr GraspOutcome kOutcomes[] = {GraspOutcome::kNone,
                                      GraspOutcome::kFinished,
                                      GraspOutcome::kLimitReached,
                                      GraspOutcome::kStopped,
                                      GraspOutcome::kRelaxed,
                                      GraspOutcome::kStreamLost,
                                      GraspOutcome::kPortGone,
                                      GraspOutcome::kFailed,
                                      GraspOutcome::kRefused};

GraspReport reportOf(GraspMode mode, GraspOutcome outcome) {
  GraspReport report;
  report.request.mode = mode;
  report.outcome = outcome;
  report.text = "the reason";
  return report;
}

// As GraspControl fills it at the end of a grasp.
GraspStatus ended(const GraspReport& report) {
  GraspStatus status;
  status.last = status.lastMotion = report;
  if (protectionEnded(report)) status.unprotected = report.text;
  status.motorsOff = report.outcome == GraspOutcome::kRelaxed;
  return status;
}

GraspStatus running(GraspPhase phase, const GraspReport& report) {
  GraspStatus status;
  status.phase = phase;
  status.running = report;
  status.request = report.request;
  status.holding = "holding for 3 s";
  return status;
}

C acknowledged(GraspStatus status) {
  status.unprotected.clear();
  return conditionOf(status).condition;
}

TEST(HandCondition, HasNineNames) {
  std::vector<std::string> names;
  for (const C each : kAllHandConditions) names.emplace_back(nameOf(each));
  EXPECT_EQ(names,
            (std::vector<std::string>{"ready",
                                      "relaxed",
                                      "moving",
                                      "easing",
                                      "holding",
                                      "holding and watched",
                                      "not protected",
                                      "stopped",
                                      "gone"}));
}

TEST(HandCondition, FollowsTheEndOfAGrasp) {
  // Columns: plain, reactive, slip-aware (before it held anything).
  const std::pair<GraspOutcome, std::array<C, 3>> table[] = {
      {GraspOutcome::kNone, {C::kReady, C::kReady, C::kReady}},
      {GraspOutcome::kFinished, {C::kReady, C::kReady, C::kReady}},
      {GraspOutcome::kLimitReached, {C::kHolding, C::kHolding, C::kNotProtected}},
      {GraspOutcome::kStopped, {C::kStopped, C::kStopped, C::kStopped}},
      {GraspOutcome::kRelaxed, {C::kRelaxed, C::kRelaxed, C::kRelaxed}},
      {GraspOutcome::kStreamLost, {C::kStopped, C::kNotProtected, C::kNotProtected}},
      {GraspOutcome::kPortGone, {C::kStopped, C::kNotProtected, C::kNotProtected}},
      {GraspOutcome::kFailed, {C::kStopped, C::kNotProtected, C::kNotProtected}},
      {GraspOutcome::kRefused, {C::kReady, C::kReady, C::kReady}},
  };
  for (const auto& [outcome, words] : table)
    for (std::size_t mode = 0; mode < 3; ++mode)
      EXPECT_EQ(nameOf(conditionOf(ended(reportOf(kModes[mode], outcome))).condition),
                nameOf(words[mode]))
          << nameOf(outcome) << ", " << nameOf(kModes[mode]);
}

TEST(HandCondition, OfAnObjectThatWasHeldTellsWhetherAnybodyWatches) {
  GraspReport held = reportOf(GraspMode::kSlip, GraspOutcome::kFinished);
  held.held = true;
  EXPECT_EQ(conditionOf(ended(held)).condition, C::kReady) << "nothing is held any more";
  held.heldAxes = {1};
  EXPECT_EQ(conditionOf(ended(held)).condition, C::kNotProtected);
  held.holdTimeOver = true;
  EXPECT_EQ(conditionOf(ended(held)).condition, C::kHolding) << "the hold time, as it was asked";
  held.holdTimeOver = false;
  for (const GraspOutcome outcome : {GraspOutcome::kStreamLost, GraspOutcome::kFailed}) {
    held.outcome = outcome;
    const GraspStatus status = ended(held);
    EXPECT_EQ(conditionOf(status).condition, C::kNotProtected);
    EXPECT_EQ(conditionOf(status).sentence, "the reason");
    EXPECT_EQ(acknowledged(status), C::kHolding);
  }
  held.outcome = GraspOutcome::kStopped;
  EXPECT_EQ(conditionOf(ended(held)).condition, C::kStopped);
  // Blocked fingers of a plain grasp press on.
  GraspReport plain = reportOf(GraspMode::kPlain, GraspOutcome::kFinished);
  plain.heldAxes = {1};
  EXPECT_EQ(conditionOf(ended(plain)).condition, C::kHolding);
}

TEST(HandCondition, StaysNotProtectedUntilItIsAcknowledged) {
  GraspStatus status = ended(reportOf(GraspMode::kReactive, GraspOutcome::kStreamLost));
  EXPECT_EQ(acknowledged(status), C::kStopped);
  // A refused grasp moves nothing and hides nothing.
  status.last = reportOf(GraspMode::kSlip, GraspOutcome::kRefused);
  EXPECT_EQ(conditionOf(status).condition, C::kNotProtected);
  // Another motion has begun and ended.
  EXPECT_EQ(conditionOf(ended(reportOf(GraspMode::kPlain, GraspOutcome::kFinished))).condition,
            C::kReady);
}

TEST(HandCondition, FollowsThePhaseOfAGrasp) {
  // Columns: plain, reactive, slip-aware.
  const std::pair<GraspPhase, std::array<C, 3>> table[] = {
      {GraspPhase::kPreshaping, {C::kMoving, C::kMoving, C::kMoving}},
      {GraspPhase::kClosing, {C::kMoving, C::kMoving, C::kMoving}},
      {GraspPhase::kStopping, {C::kMoving, C::kMoving, C::kMoving}},
      {GraspPhase::kSettling, {C::kHolding, C::kHolding, C::kHolding}},
      {GraspPhase::kEasing, {C::kEasing, C::kEasing, C::kEasing}},
      {GraspPhase::kHolding, {C::kWatched, C::kWatched, C::kWatched}},
      {GraspPhase::kLoosening, {C::kMoving, C::kMoving, C::kMoving}},
  };
  for (const auto& [phase, words] : table)
    for (std::size_t mode = 0; mode < 3; ++mode) {
      const ExplainedCondition now =
          conditionOf(running(phase, reportOf(kModes[mode], GraspOutcome::kNone)));
      EXPECT_EQ(nameOf(now.condition), nameOf(words[mode]))
          << nameOf(phase) << ", " << nameOf(kModes[mode]);
      EXPECT_FALSE(now.sentence.empty()) << nameOf(phase);
    }
}

TEST(HandCondition, OfAHandThatIsBeingStoppedTellsWhy) {
  for (const GraspMode mode : kModes)
    for (const GraspOutcome outcome : kOutcomes) {
      GraspReport report = reportOf(mode, outcome);
      const C word = conditionOf(running(GraspPhase::kStopping, report)).condition;
      EXPECT_EQ(word, protectionEnded(report) ? C::kNotProtected : C::kMoving)
          << nameOf(mode) << ", " << nameOf(outcome);
    }
  GraspReport held = reportOf(GraspMode::kSlip, GraspOutcome::kStopped);
  held.held = true;
  EXPECT_EQ(conditionOf(running(GraspPhase::kStopping, held)).condition, C::kStopped);
  // The end of a grasp is being told.
  GraspStatus told = ended(reportOf(GraspMode::kPlain, GraspOutcome::kFinished));
  told.phase = GraspPhase::kStopping;
  EXPECT_EQ(conditionOf(told).condition, C::kReady);
}

TEST(HandCondition, OfASilentStreamSaysForHowLongNobodyWatches) {
  for (const GraspPhase phase : {GraspPhase::kSettling, GraspPhase::kHolding}) {
    GraspStatus silent = running(phase, reportOf(GraspMode::kSlip, GraspOutcome::kNone));
    silent.unwatchedMs = 105.0;
    EXPECT_EQ(conditionOf(silent).condition, C::kNotProtected);
    EXPECT_TRUE(conditionOf(silent).sentence.starts_with("no tactile frames for 105 ms"));
  }
}

TEST(HandCondition, OfAHandThatDoesNotAnswerSaysWhatToDo) {
  for (const GraspMode mode : kModes) {
    for (const GraspOutcome outcome : kOutcomes) {
      GraspStatus status = ended(reportOf(mode, outcome));
      status.cannotMove = "no motion controller answers";
      EXPECT_EQ(conditionOf(status).condition, C::kGone);
      EXPECT_TRUE(conditionOf(status).sentence.ends_with("no motion controller answers"));
    }
    for (int phase = 1; phase <= static_cast<int>(GraspPhase::kLoosening); ++phase) {
      GraspStatus status =
          running(static_cast<GraspPhase>(phase), reportOf(mode, GraspOutcome::kNone));
      status.cannotMove = "no motion controller answers";
      EXPECT_EQ(conditionOf(status).condition, C::kGone);
      EXPECT_NE(conditionOf(status).sentence.find("emergency stop"), std::string::npos);
    }
    GraspReport unknown = reportOf(mode, GraspOutcome::kFailed);
    unknown.stateUnknown = true;
    GraspStatus status = ended(unknown);
    status.cannotMove = "silent";
    EXPECT_EQ(conditionOf(status).condition, C::kGone);
    EXPECT_NE(conditionOf(status).sentence.find("emergency stop"), std::string::npos);
    // It answers again, and nobody has looked at it yet.
    status.cannotMove.clear();
    EXPECT_EQ(conditionOf(status).condition, C::kNotProtected);
  }
  GraspReport gone = reportOf(GraspMode::kPlain, GraspOutcome::kPortGone);
  GraspStatus status = ended(gone);
  status.cannotMove = "unplugged";
  status.portGone = gone;
  EXPECT_EQ(conditionOf(status).sentence, "the reason; plug it in again");
  status.portGone->remainingMotionS = 2.0;
  EXPECT_NE(conditionOf(status).sentence.find("emergency stop"), std::string::npos);
}

}  // namespace
}  // namespace palpate::hand_condition_test
