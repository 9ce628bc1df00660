// A grasp as it is asked for, and what became of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/device/device.h>
#include <palpate/live/live_results.h>
#include <palpate/model/hand_description.h>

namespace palpate {

enum class GraspMode {
  kPlain,     // to the close ratio, whatever is felt
  kReactive,  // closes until the first taxel of any matrix is over the limit; needs a tactile stream
};
std::string_view nameOf(GraspMode mode);  // "plain", "reactive"

constexpr double kSlowestGraspDegPerS = 1.0;
constexpr double kFastestGraspDegPerS = 100.0;
constexpr int kLeastGraspLimitCounts = 3;
constexpr int kMostGraspLimitCounts = 3600;  // an SDH-2 saturates at about 3560

struct GraspRequest {
  GraspMode mode = GraspMode::kPlain;
  std::string preshape = "centrical";  // of sdh2Preshapes()
  // The hand goes there first, in a motion of its own, 0 (open) .. 1; nothing: from where it stands. In a
  // reactive grasp this motion is watched, too.
  std::optional<double> startRatio = {};
  double closeRatio = 0.5;        // 0 (open) .. 1 (closed); a reactive grasp goes to 1 at most
  double velocityDegPerS = 10.0;  // 1..100; axes that are slower go as fast as they can [deg/s]
  int limitCounts = 200;          // of a reactive grasp: stop above, 3..3600 [counts]

  // Throws std::invalid_argument naming field, value and range: no byte may be sent.
  void validate() const;
};
// What goes to the hand for one motion of a grasp. Throws as validate(), and when a target is beyond the range of
// an axis (a hand with less range than the SDH-2).
MoveJoints motionTo(const GraspRequest& request, double closeRatio, const HandDescription& hand);
// "reactive grasp: centrical, from 0 to 1, 30 deg/s, limit 200 counts"
std::string describe(const GraspRequest& request);

enum class GraspOutcome {
  kNone,          // it hasn't ended
  kFinished,      // the motion ended: at its target, or held by something
  kLimitReached,  // a taxel was over the limit: stopped
  kStopped,       // by the user
  kRelaxed,       // by the user: motors off
  kStreamDead,    // no frames any more in a reactive grasp: stopped
  kPortGone,      // the motion port is gone: see docs/safety.md for what the hand does
  kFailed,        // the hand refused, didn't answer, or didn't end: stopped
  kRefused,       // it never began: nothing was sent
};
// "finished", "limit_reached", "stopped", "relaxed", "stream_dead", "port_gone", "failed", "refused"
std::string_view nameOf(GraspOutcome outcome);

struct GraspReport {
  GraspRequest request;
  GraspOutcome outcome = GraspOutcome::kNone;
  std::string text;           // one line for a person
  std::int64_t beginUs = 0;   // host time [us since 1970]
  std::int64_t endUs = 0;     //
  TaxelPeak peak;             // of kLimitReached: the largest taxel of the frame that crossed it
  std::vector<int> heldAxes;  // of kFinished: axes that something holds short of their target
};
// As an event of kind "grasp" in a recording: parameters, and at the end the outcome, as JSON.
RecordingEvent beginEvent(const GraspReport& report);
RecordingEvent endEvent(const GraspReport& report);

}  // namespace palpate
