// A grasp as it is asked for, and what became of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/control/limit_feasibility.h>
#include <palpate/device/device.h>
#include <palpate/live/live_results.h>
#include <palpate/model/hand_description.h>

namespace palpate {

enum class GraspMode {
  // to the close ratio, whatever is felt
  kPlain,
  // closes until the first taxel of any matrix is over the limit; needs a tactile stream
  kReactive,
  // closes as a reactive grasp, then holds: closes again to a higher limit when what is held slips
  kSlip,
};
std::string_view nameOf(GraspMode mode);  // "plain", "reactive", "slip"

constexpr double kMinGraspDegPerS = 1.0;
constexpr double kMaxGraspDegPerS = 100.0;
constexpr int kMinGraspLimitCounts = 3;
constexpr int kMaxGraspLimitCounts = static_cast<int>(kSdh2SaturationCounts) - kLimitMarginCounts;
constexpr int kMaxSlipLimitCounts = 2200;

// How a slip-aware grasp holds on.
struct HoldingOptions {
  double holdS = 0.0;  // ends by itself after so long, the hand goes on holding [s], 0: when told;
                       // at most a day
  double settleS = 0.5;                      // rest before the first references [s], 0..60
  double restS = 0.05;                       // and after closing again [s], 0..60
  int raiseCounts = 300;                     // the limit rises by so much at a slip, 1..3300 ..
  int maxLimitCounts = kMaxSlipLimitCounts;  // .. up to this, limitCounts..3300
  // After so long without slip the limit falls again by as much as it rose, down to where it began
  // [s], > 0.
  double noSlipS = 5.0;
  // The hand may then open, slowly and watched, until no taxel is over the lower limit. Not unless
  // told: it is loaded.
  bool loosen = false;
  // Of the object; with it the hand is told to open slowly once, until the object slips, and to
  // catch it: what it felt then tells friction [N], 0: not known.
  double weightN = 0.0;
  // normal force per count of all taxels, of a calibration; 0: not known, no friction
  double newtonsPerCount = 0.0;

  void validate(
      int limitCounts) const;  // throws std::invalid_argument naming field, value and range
};

struct GraspRequest {
  GraspMode mode = GraspMode::kPlain;
  std::string preshape = "centrical";  // of sdh2Preshapes()
  // The hand goes there first, in a motion of its own, 0 (open) .. 1; nothing: from where it
  // stands. In a reactive grasp this motion is watched, too.
  std::optional<double> startRatio = {};
  double closeRatio = 0.5;        // 0 (open) .. 1 (closed); a reactive grasp goes to 1 at most
  double velocityDegPerS = 10.0;  // 1..100; axes that are slower go as fast as they can [deg/s]
  // Of a reactive grasp: stop above, 3..3300 [counts]; of a slip-aware one the first limit.
  int limitCounts = 200;
  HoldingOptions holding = {};  // of a slip-aware grasp

  // Throws std::invalid_argument naming field, value and range: no byte may be sent.
  void validate() const;
};
// What goes to the hand for one motion of a grasp. Throws as validate(), and when a target is
// beyond the range of an axis (a hand with less range than the SDH-2).
MoveJoints motionTo(const GraspRequest& request, double closeRatio, const HandDescription& hand);
// The highest limit that a grasp may go to; of a plain one its limit means nothing.
int maxLimitOf(const GraspRequest& request);
// Matrices on fingers that it moves, which can't tell that limit: with one of them it is refused.
// None for a plain grasp. Settings as in limit_feasibility.h. Throws std::invalid_argument for a
// preshape that there isn't.
std::vector<UnmeasurableLimit> unmeasurableLimits(const HandDescription& hand,
                                                  const std::vector<MatrixSettings>& settings,
                                                  const GraspRequest& request);
// A plain motion to the open hand: it grasps nothing, and is called so nowhere.
bool isOpening(const GraspRequest& request);
// What is done, without how: "reactive grasp", "opening".
std::string kindOf(const GraspRequest& request);
// "reactive grasp: centrical, from 0 to 1, 30 deg/s, limit 200 counts", "opening: centrical, 10
// deg/s"
std::string describe(const GraspRequest& request);

enum class GraspOutcome {
  kNone,          // it hasn't ended
  kFinished,      // the motion ended: at its target, or held by something
  kLimitReached,  // a taxel was over the limit: stopped
  kStopped,       // by the user
  kRelaxed,       // by the user: motors off
  kStreamLost,    // no frames any more in a reactive grasp: stopped
  kPortGone,      // the motion port is gone: see docs/safety.md for what the hand does
  kFailed,        // the hand refused, didn't answer, or didn't end: stopped
  kRefused,       // it never began: nothing was sent
};
// "finished", "limit_reached", "stopped", "relaxed", "stream_dead", "port_gone", "failed",
// "refused"
std::string_view nameOf(GraspOutcome outcome);

struct GraspReport {
  GraspRequest request;
  GraspOutcome outcome = GraspOutcome::kNone;
  std::string text;           // one line for a person
  std::int64_t beginUs = 0;   // host time [us since 1970]
  std::int64_t endUs = 0;     //
  TaxelPeak peak;             // of kLimitReached: the largest taxel of the frame that crossed it
  std::vector<int> heldAxes;  // of kFinished: axes that something holds short of their target
  // Largest taxel in the 0.5 s after the stop of a grasp under tactile control: the rubber responds
  // with a delay, so the reading rises after the stop [counts]. Empty if it was not measured.
  std::optional<TaxelPeak> peakAfterStop = {};
  // kPortGone: longest time from endUs for which the running motion can continue without control
  // [s]; 0 if no motion was running and the hand holds its position.
  std::optional<double> remainingMotionS = {};
  // Of a slip-aware grasp:
  bool held = false;    // it came to hold
  int limitCounts = 0;  // the last limit
  int slips = 0;        // that were answered, or couldn't be any more
  // Of the opening until it slipped: all taxels together in that moment [counts], and friction =
  // weight / normal force.
  std::optional<double> countsAtSlip = {};
  std::optional<double> friction = {};
};
// As an event of kind "grasp" in a recording: parameters, and at the end the outcome, as JSON.
RecordingEvent beginEvent(const GraspReport& report);
RecordingEvent endEvent(const GraspReport& report);
// What a slip-aware grasp did meanwhile, also as events "grasp".
struct GraspStep {
  std::string action;  // "holding", "slip", "regrasp", "lower", "loosen", "friction", "at_limit"
  std::string text;    // one line for a person
  std::optional<std::size_t> matrix = {};
  int limitCounts = 0;
};
RecordingEvent noteEvent(const GraspReport& report, const GraspStep& note, std::int64_t hostUs);

}  // namespace palpate
