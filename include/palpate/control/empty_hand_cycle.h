// Closes the empty hand until its own pads touch, holds, and opens again: what is felt meanwhile
// tells how far apart the pads are where the joints say that they touch (docs/recognition.md, the
// zero of the empty hand).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <palpate/control/grasp_control.h>

namespace palpate {

// One thread calls step() about ten times a second. All commands go through GraspControl, which
// checks them; a stop from any source ends the run.
class EmptyHandCycle {
 public:
  struct Options {
    std::string preshape = "pinch-empty";
    double closingDegPerS = 8.0;
    double openingDegPerS = 20.0;
    int limitCounts = 600;  // of the largest taxel, which ends closing
    double holdS = 1.5;     // so long the pads press on each other
    // From the command to open until the pads must have let go of each other.
    double maxOpenS = 10.0;
  };
  enum class State { kIdle, kClosing, kHolding, kOpening };

  // The control must outlive the run.
  explicit EmptyHandCycle(GraspControl& control) : EmptyHandCycle(control, Options()) {}
  EmptyHandCycle(GraspControl& control, Options options);

  // `hostUs` [us since 1970], here and below: now, by the clock of the session. Throws as
  // GraspControl::grasp(), and nothing runs then. A run that goes on begins anew.
  void begin(std::int64_t hostUs);
  // Goes on as far as the hand is. Why the run has ended without a result, once; else nothing.
  std::optional<std::string> step(std::int64_t hostUs);
  // The pads no longer touch each other. Ends the run; why without a result, or nothing: everything
  // was as it should be, and what was felt counts.
  std::optional<std::string> onPadsReleased();
  // Nothing of the run moves the hand any more; what moves already goes on, unless somebody stops
  // it.
  void cancel() noexcept { state_ = State::kIdle; }

  State state() const noexcept { return state_; }
  bool active() const noexcept { return state_ != State::kIdle; }

 private:
  std::string ended(std::string why);

  GraspControl& control_;
  Options options_;
  State state_ = State::kIdle;
  std::int64_t sinceUs_ = 0;  // of the state
  std::uint64_t stopsBefore_ = 0;
};

}  // namespace palpate
