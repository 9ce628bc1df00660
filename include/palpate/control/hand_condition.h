// The condition of a hand that can be moved, in one word and one sentence: the same in the window,
// in `palpate grasp`, in the log and for other programs.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <palpate/control/grasp_request.h>

namespace palpate {

struct GraspStatus;

enum class HandCondition {
  kReady,         // nothing is held as far as is known
  kRelaxed,       // the motors are off: the fingers can be moved by hand, and an object may fall
  kMoving,        // fingers move, or are being stopped
  kEasing,        // opens by small steps after the limit was reached
  kHolding,       // holds; nobody was promised that it is watched
  kWatched,       // holds, and closes again when the object slips
  kNotProtected,  // what watched the hand has failed, and nobody has acknowledged that
  kStopped,       // stopped, by the user or after a failure
  kGone           // the hand doesn't answer
};
inline constexpr std::array kAllHandConditions = {HandCondition::kReady,
                                                  HandCondition::kRelaxed,
                                                  HandCondition::kMoving,
                                                  HandCondition::kEasing,
                                                  HandCondition::kHolding,
                                                  HandCondition::kWatched,
                                                  HandCondition::kNotProtected,
                                                  HandCondition::kStopped,
                                                  HandCondition::kGone};
// Names: "ready", "relaxed", "moving", "easing", "holding", "holding and watched",
// "not protected", "stopped", "gone".
std::string_view nameOf(HandCondition condition);

struct ExplainedCondition {
  HandCondition condition = HandCondition::kReady;
  std::string sentence;  // one line: why, and what to do where something is to be done
  bool operator==(const ExplainedCondition&) const = default;
};
ExplainedCondition conditionOf(const GraspStatus& status);

// Whether a grasp ended, or is being stopped, otherwise than it was asked for while the taxels
// watched it: for another reason than its limit, a person, its hold time, or that nothing was held
// any more. Also true of any motion after which the state of the hand is not known.
bool protectionEnded(const GraspReport& report);

}  // namespace palpate
