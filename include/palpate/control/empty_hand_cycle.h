// Closes the empty hand until its own pads touch, holds, and opens again. The recorded frames and
// angles give the distance of the pads at the joint angles where they should touch
// (docs/notes/recognition.md, the zero of the empty hand).
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include <palpate/control/grasp_control.h>

namespace palpate {

// Advanced by the control cycle. All commands go through GraspControl, which checks them; a stop
// from any source ends the cycle. Every function may be called from any thread.
class EmptyHandCycle final : public ControlTask {
 public:
  struct Options {
    std::string preshape = "pinch-empty";
    double closingDegPerS = 8.0;
    double openingDegPerS = 20.0;
    // Closing ends when the largest taxel exceeds this value.
    int limitCounts = 600;
    // Time for which the pads press on each other.
    double holdS = 1.5;
    // Time limit from the command to open until the pads are released.
    double maxOpenS = 10.0;
  };
  enum class State { kIdle, kClosing, kHolding, kOpening };

  // `control` must outlive the cycle.
  explicit EmptyHandCycle(GraspControl& control) : EmptyHandCycle(control, Options()) {}
  EmptyHandCycle(GraspControl& control, Options options);
  ~EmptyHandCycle() override { control_.forget(*this); }
  EmptyHandCycle(const EmptyHandCycle&) = delete;
  EmptyHandCycle& operator=(const EmptyHandCycle&) = delete;

  // Starts a cycle; one that is running starts again. `hostUs` [us since 1970]: the present time by
  // the session's clock. Throws as GraspControl::grasp(), and no cycle runs then.
  void begin(std::int64_t hostUs);
  void step(std::int64_t hostUs) override;
  // Why the cycle ended without a result, once; otherwise empty.
  std::optional<std::string> takeProblem();
  // Call this when the pads no longer touch each other. Ends the cycle. Returns why it has no
  // result, or empty when it was completed and its measurement is valid.
  std::optional<std::string> onPadsReleased();
  // Ends the cycle without a command: no further motion begins, but a motion that is running
  // continues unless it is stopped.
  void cancel();

  State state() const;
  bool active() const { return state() != State::kIdle; }

 private:
  // Requires mutex_.
  void end(std::string why);

  GraspControl& control_;
  mutable std::mutex mutex_;
  std::optional<std::string> problem_;
  Options options_;
  State state_ = State::kIdle;
  std::int64_t sinceUs_ = 0;  // begin of the state [us since 1970]
  std::uint64_t stopsBefore_ = 0;
};

}  // namespace palpate
