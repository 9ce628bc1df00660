// What a slip-aware grasp does once it has closed: rests, takes references, holds, and answers slips.
//
// It never opens by itself: only when the request says so (loosen, or a weight), slowly and with every frame watched; what slips then is
// closed upon at once. Whatever ends it (the user, a dead stream, a port) leaves the fingers where they are.
#include <algorithm>
#include <cmath>

#include "palpate/control/grasp_machine.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kLooseningDegPerS = 1.0;
// Opening for friction gives up when so little of the limit is left: better held than known.
constexpr double kLeastOfLimit = 0.25;
constexpr double kLongestLooseningS = 20.0;

std::int64_t microsecondsOf(double seconds) { return std::llround(seconds * 1e6); }

}  // namespace

void GraspMachine::note(const char* action,
                        const std::string& text,
                        std::optional<std::size_t> matrix) {
  notes_.push_back({action, text, matrix, limit_});
}

// Stops the motion, and goes on.
void GraspMachine::pause(Next next, const std::string& text, std::int64_t monoUs) {
  stops_ = 0;
  halt(GraspOutcome::kNone, text, monoUs);
  next_ = next;
}

void GraspMachine::settle(std::int64_t monoUs) {
  phase_ = GraspPhase::kSettling;
  command_.reset();
  const HoldingOptions& holding = report_.request.holding;
  settledUs_ = monoUs + microsecondsOf(held_ ? holding.restS : holding.settleS);
  if (endUs_ == 0 && holding.holdS > 0.0) endUs_ = settledUs_ + microsecondsOf(holding.holdS);
}

// "holding: limit 200 counts; rose to 3331 after the stop, above its highest limit of 2200: close more slowly"
std::string GraspMachine::holdingText() const {
  std::string text = "holding: limit " + std::to_string(limit_) + " counts";
  const int highest = report_.request.holding.mostLimitCounts;
  if (!report_.reached || report_.reached->counts <= static_cast<float>(highest))
    return text + riseText();
  return text + "; rose to " + numberText(report_.reached->counts) +
         " after the stop, above its highest limit of " + std::to_string(highest) +
         ": close more slowly";
}

void GraspMachine::onHoldingFrame(std::int64_t monoUs) {
  if (phase_ == GraspPhase::kSettling) {
    if (monoUs < settledUs_) return;
    grip_.setReference();
    phase_ = GraspPhase::kHolding;
    calmUs_ = monoUs;
    if (!held_) note("holding", holdingText());
    held_ = report_.held = true;
    return;
  }
  if (!grip_.touches()) return end(GraspOutcome::kFinished, "finished: nothing is held any more");
  if (const auto slip = grip_.slip()) answerSlip(*slip, monoUs);
}

void GraspMachine::answerSlip(const GripSlip& slip, std::int64_t monoUs) {
  const HoldingOptions& holding = report_.request.holding;
  ++report_.slips;
  calmUs_ = monoUs;
  // Over the limit by what it took to stop: a limit below what is felt would close nothing.
  const int felt = std::max(limit_, static_cast<int>(peak_.counts));
  const int raised = std::min(felt + holding.raiseCounts, holding.mostLimitCounts);
  if (raised <= static_cast<int>(peak_.counts)) {
    limit_ = std::max(limit_, std::min(felt, holding.mostLimitCounts));
    note("at_limit", "slips, and the limit can't rise: " + slip.why, slip.matrix);
    grip_.setReference();
    return;
  }
  limit_ = raised;
  report_.limitCounts = limit_;
  note("slip",
       "slips: " + slip.why + "; closing to " + std::to_string(limit_) + " counts",
       slip.matrix);
  // What is loosening must stop first.
  if (phase_ == GraspPhase::kLoosening) return pause(Next::kClose, "it slips", monoUs);
  move(report_.request.closeRatio, GraspPhase::kClosing, monoUs);
}

void GraspMachine::onHoldingTime(std::int64_t monoUs) {
  if (monoUs > stream_.deadAtUs())
    return end(GraspOutcome::kStreamDead,
               "no tactile frames come any more: the hand holds, nobody watches");
  if (phase_ != GraspPhase::kHolding) return;
  const HoldingOptions& holding = report_.request.holding;
  if (endUs_ != 0 && monoUs >= endUs_)
    return end(GraspOutcome::kFinished,
               "finished: held for " + numberText(holding.holdS) + " s, " +
                   std::to_string(report_.slips) + " slips, limit " + std::to_string(limit_) +
                   " counts; the hand goes on holding");
  if (monoUs < calmUs_ + microsecondsOf(holding.calmS)) return;
  calmUs_ = monoUs;
  if (holding.weightN > 0.0 && !tested_) {
    tested_ = testing_ = true;
    return loosen("friction", "opening slowly until it slips, for its friction", monoUs);
  }
  if (limit_ <= report_.request.limitCounts) return;
  limit_ = std::max(limit_ - holding.raiseCounts, report_.request.limitCounts);
  report_.limitCounts = limit_;
  note("lower", "nothing slips: limit " + std::to_string(limit_) + " counts");
  if (holding.loosen && peak_.counts > static_cast<float>(limit_))
    loosen("loosen", "opening slowly to the lower limit", monoUs);
}

void GraspMachine::loosen(const char* action, const std::string& text, std::int64_t monoUs) {
  note(action, text);
  grip_.setReference();
  MoveJoints open = motionTo(report_.request, 0.0, hand_);
  for (double& velocity : open.velocityDegPerS) velocity = std::min(velocity, kLooseningDegPerS);
  send(std::move(open), GraspPhase::kLoosening, monoUs);
  settledUs_ = monoUs + microsecondsOf(kLongestLooseningS);
}

void GraspMachine::onLooseningFrame(std::int64_t monoUs) {
  if (const auto slip = grip_.slip()) {
    if (testing_) foundFriction(*slip);
    testing_ = false;
    return answerSlip(*slip, monoUs);
  }
  const double enough = testing_ ? kLeastOfLimit * report_.request.limitCounts : limit_;
  if (static_cast<double>(peak_.counts) > enough && monoUs < settledUs_) return;
  if (!testing_) return pause(Next::kSettle, "loose enough", monoUs);
  testing_ = false;
  note("friction", "it doesn't slip at " + numberText(peak_.counts) + " counts: closing again");
  pause(Next::kClose, "loose enough", monoUs);
}

// What was felt when it began to slip carried the weight: weight = friction times normal force.
void GraspMachine::foundFriction(const GripSlip& slip) {
  const HoldingOptions& holding = report_.request.holding;
  report_.countsAtSlip = grip_.sumCounts();
  std::string text = "slips at " + numberText(grip_.sumCounts()) + " counts in sum";
  if (holding.newtonsPerCount > 0.0 && grip_.sumCounts() > 0.0) {
    report_.friction = holding.weightN / (holding.newtonsPerCount * grip_.sumCounts());
    text += ": friction " + fixedText(*report_.friction, 2);
  }
  note("friction", text, slip.matrix);
}

std::int64_t GraspMachine::holdingNextUs() const {
  std::int64_t nextUs = stream_.deadAtUs() + 1;
  if (phase_ != GraspPhase::kHolding) return nextUs;
  if (endUs_ != 0) nextUs = std::min(nextUs, endUs_);
  return std::min(nextUs, calmUs_ + microsecondsOf(report_.request.holding.calmS));
}

}  // namespace palpate
