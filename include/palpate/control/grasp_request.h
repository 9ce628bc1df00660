// Request of a grasp and report of its result. GraspControl takes requests and returns reports.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/control/limit_feasibility.h>
#include <palpate/core/option_check.h>
#include <palpate/device/device.h>
#include <palpate/device/sdh2.h>
#include <palpate/model/event.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

enum class GraspMode {
  // Closes to the close ratio, whatever the taxels measure.
  kPlain,
  // Closes until the first taxel of any matrix is over the limit; needs a tactile stream.
  kReactive,
  // Closes as a reactive grasp, then holds the object: when it slips, closes again to a higher
  // limit.
  kSlip,
};
std::string_view nameOf(GraspMode mode);  // "plain", "reactive", "slip"
inline constexpr std::array kAllGraspModes{
    GraspMode::kPlain, GraspMode::kReactive, GraspMode::kSlip};

constexpr double kMinGraspDegPerS = 0.2;
constexpr double kMaxGraspDegPerS = 100.0;
constexpr int kMinGraspLimitCounts = 3;
constexpr int kMaxGraspLimitCounts = static_cast<int>(kSdh2SaturationCounts) - kLimitMarginCounts;
constexpr int kMaxSlipLimitCounts = 2200;

// Options of holding in a slip-aware grasp.
struct HoldingOptions {
  // The grasp ends by itself after this time, and the hand keeps holding [s]; 0: ends only on
  // request.
  static constexpr OptionRange kHoldS{0.0, 86'400.0, "s"};
  double holdS = 0.0;
  // Rest before the first references are taken [s], 0..60.
  double settleS = 0.5;
  // Rest after closing again [s], 0..60.
  double restS = 0.05;
  // Amount by which the limit rises at a slip, 1..3300 [counts].
  int raiseCounts = 300;
  // Highest limit that slips can cause, limitCounts..3300 [counts].
  int maxLimitCounts = kMaxSlipLimitCounts;
  // After this time without slip the limit falls again by raiseCounts, down to its first
  // value [s].
  static constexpr OptionRange kNoSlipS{0.01, 86'400.0, "s"};
  double noSlipS = 5.0;
  // Allows the hand then to open slowly, under tactile control, until no taxel is over the lower
  // limit. Off by default, because the hand holds a load.
  bool loosen = false;
  // Weight of the object [N]; 0: not known. If it is known, the hand opens slowly once until the
  // object slips, and catches it again; the measured forces then give the friction.
  static constexpr OptionRange kWeightN{0.0, 1000.0, "N"};
  static constexpr OptionRange kMassKg{0.0, 100.0, "kg"};  // of the object of this weight
  double weightN = 0.0;
  // Normal force per count of all taxels, from a calibration [N/count]; 0: not known, no friction.
  static constexpr OptionRange kNewtonsPerCount{0.0, 1.0, "N"};
  double newtonsPerCount = 0.0;

  // Throws std::invalid_argument naming field, value and range.
  void validate(int limitCounts) const;
};

// The hand whose motion is known: other hands are read, not moved.
const HandDescription& movableHand();

// Number of fingers with matrices of movableHand(); limits per finger are in the order of
// MatrixDescription::finger.
std::size_t numMovableFingers();

// Length of the name of an object [bytes].
constexpr std::size_t kMaxObjectBytes = 100;
constexpr double kMinForceLimitN = 0.05;
constexpr double kMaxForceLimitN = 500.0;

struct GraspRequest {
  GraspMode mode = GraspMode::kPlain;
  std::string preshape = "centrical";  // one of movableHand()
  // Target of each axis [deg] instead of a preshape and its close ratio; a target that is empty:
  // the axis stays at its present angle. Empty: the preshape counts. Not for a slip-aware grasp,
  // and without a start ratio. `title`, one line, names the motion in texts: "axis 1", the name of
  // a pose.
  std::vector<std::optional<double>> targetDeg = {};
  std::string title = {};
  // The hand moves to this ratio first, in a separate motion, 0 (open) .. 1; empty: it starts from
  // its present posture. In a reactive grasp this motion is under tactile control, too.
  std::optional<double> startRatio = {};
  // 0 (open) .. 1 (closed); for a reactive grasp the largest ratio.
  static constexpr OptionRange kCloseRatio{0.0, 1.0};
  double closeRatio = 0.5;
  // [deg/s]; slower axes move as fast as they can.
  static constexpr OptionRange kVelocityDegPerS{kMinGraspDegPerS, kMaxGraspDegPerS, "deg/s"};
  double velocityDegPerS = 10.0;
  // Limit of a reactive grasp, which stops above it [counts]; first limit of a slip-aware
  // one.
  static constexpr OptionRange kLimitCounts{kMinGraspLimitCounts, kMaxGraspLimitCounts, "counts"};
  int limitCounts = 200;
  // Lower limits of single fingers, one per finger, each 3..limitCounts [counts]; empty:
  // limitCounts holds for all. A slip-aware grasp raises them together with limitCounts.
  std::vector<int> fingerLimitCounts = {};
  // Largest normal force of a finger, 0.05..500 [N]: one per finger, or one for all; empty: none.
  // Needs a calibration (GraspControl::setCalibration). The grasp stops at this force or at the
  // limit in counts, whichever is exceeded first. A slip raises no force limit.
  std::vector<double> forceLimitsN = {};
  // A grasp under tactile control by a preshape keeps its limit: it touches slowly, and gives way
  // after its stop (grasp_approach.h). Without this it closes at velocityDegPerS and stays where it
  // stopped, above its limit.
  bool keepsLimit = false;
  // The object, as its user names it, one line of at most 100 bytes. Where grasps of it touched is
  // remembered for later ones that keep their limit; empty: nothing is.
  std::string object = {};
  // The close ratio at which the object is expected to touch first, by its size, 0..1; empty: not
  // known.
  std::optional<double> touchRatio = {};
  HoldingOptions holding = {};  // used by a slip-aware grasp

  // Throws std::invalid_argument naming field, value and range; nothing may be sent then.
  void validate() const;
};
// The command for one motion of a grasp, the only way to one: it validates the request, whoever has
// done so before to name an error earlier. `presentDeg`: the present joint angles, for axes without
// a target (empty: not known). Throws as validate(), when a target is beyond the range of an axis
// (of targetDeg, or of a hand with a smaller range than the SDH-2), and when an axis without a
// target has no known angle.
MoveJoints motionTo(const GraspRequest& request,
                    double closeRatio,
                    const HandDescription& hand,
                    const std::vector<double>& presentDeg = {});
// The limit of a finger at the begin [counts]; that of all for a finger of no number.
int limitOf(const GraspRequest& request, int finger);
// The force limit of a finger [N]; nothing without one.
std::optional<double> forceLimitOf(const GraspRequest& request, std::size_t finger);
// The highest limit that a grasp may use; meaningless for a plain grasp.
int maxLimitOf(const GraspRequest& request);
// Matrices on the moved fingers that can't measure the highest limit of the grasp; a grasp with
// such a matrix is refused. Always empty for a plain grasp. Settings as in limit_feasibility.h.
// Throws std::invalid_argument for an unknown preshape.
std::vector<UnmeasurableLimit> unmeasurableLimits(const HandDescription& hand,
                                                  const std::vector<MatrixSettings>& settings,
                                                  const GraspRequest& request);
// The highest limit that every matrix on the moved fingers can measure, in steps of 50 from 3300
// down [counts]; 0 when there is none. The limits of the request are ignored.
int highestMeasurableLimit(const HandDescription& hand,
                           const std::vector<MatrixSettings>& settings,
                           GraspRequest request);
// Whether the grasp keeps its limit; never true for a plain one or a motion to joint angles.
bool keepsLimit(const GraspRequest& request);
// True for a plain motion to the open hand, which users see as "opening" and not as a grasp.
bool isOpening(const GraspRequest& request);
// True for a motion to joint angles instead of a preshape.
bool isJointMotion(const GraspRequest& request);
// The kind of the request without its parameters: "reactive grasp", "opening", "motion", "reactive
// motion".
std::string kindOf(const GraspRequest& request);
// The request with its parameters: "reactive grasp: centrical, from 0 to 1, 30 deg/s, limit 200
// counts", "opening: centrical, 10 deg/s".
std::string describe(const GraspRequest& request);

enum class GraspOutcome {
  kNone,          // the grasp has not ended
  kFinished,      // the motion ended: at its target, or blocked by an object
  kLimitReached,  // a taxel was over the limit: stopped
  kStopped,       // stopped by the user
  kRelaxed,       // relaxed by the user: motors off
  kStreamLost,    // no frames any more in a reactive grasp: stopped
  kPortGone,      // the motion port is gone: see docs/notes/safety.md for what the hand does
  kFailed,        // the hand refused, didn't answer, or didn't end: stopped
  kRefused,       // the grasp never began: nothing was sent
};
// Names: "finished", "limit_reached", "stopped", "relaxed", "stream_dead", "port_gone", "failed",
// "refused".
std::string_view nameOf(GraspOutcome outcome);

// What a grasp that kept its limit has shown of its object.
struct Touch {
  double ratio = 0.0;  // close ratio at the first touch, 0..1
  // Rise of the reading after the stop, per velocity [counts per deg/s], and of the force of a
  // finger [N per deg/s]; empty: not measured.
  std::optional<double> riseCounts = {};
  std::optional<double> riseN = {};
  int grasps = 1;  // from which it was learnt
};

struct GraspReport {
  GraspRequest request;
  GraspOutcome outcome = GraspOutcome::kNone;
  std::string text;          // one line for the user
  std::int64_t beginUs = 0;  // host time [us since 1970]
  std::int64_t endUs = 0;    // host time [us since 1970]
  // For kLimitReached: host time of the frame in which the limit was exceeded [us since 1970].
  std::int64_t limitUs = 0;
  // For kLimitReached: largest taxel of the frame in which the limit was exceeded; with limits of
  // single fingers the one that is farthest above its limit.
  TaxelPeak peak;
  // For kLimitReached by a force: the finger and its force in that frame [N].
  std::optional<std::size_t> forceFinger = {};
  double forceN = 0.0;
  // The largest force of that finger in the 0.5 s after the stop [N].
  double forceAfterStopN = 0.0;
  // For kFinished: axes that were blocked before their target.
  std::vector<int> heldAxes;
  // Largest taxel in the 0.5 s after the stop of a grasp under tactile control: the rubber responds
  // with a delay, so the reading rises after the stop [counts]. Empty if it was not measured.
  std::optional<TaxelPeak> peakAfterStop = {};
  // For a grasp that keeps its limit: the largest taxel after the hand has given way [counts];
  // empty if it didn't come so far.
  std::optional<TaxelPeak> peakAtRest = {};
  std::optional<Touch> touch = {};  // for TouchMemory
  // kPortGone: longest time from endUs for which the running motion can continue without control
  // [s]; 0 if no motion was running and the hand holds its position.
  std::optional<double> remainingMotionS = {};
  // No stop was answered: whether the hand moves is not known.
  bool stateUnknown = false;
  // The following fields belong to a slip-aware grasp.
  bool held = false;  // true once the phase "holding" was reached
  // For kFinished: it was held for HoldingOptions::holdS; the hand keeps holding.
  bool holdTimeOver = false;
  int limitCounts = 0;  // the last limit
  // Number of slips, including those that could no longer be answered.
  int slips = 0;
  // Result of the opening until slip: sum of all taxels when slip began [counts], and friction =
  // weight / normal force.
  std::optional<double> countsAtSlip = {};
  std::optional<double> friction = {};
};
// What a report says of a hand that was relaxed.
inline constexpr std::string_view kRelaxedText = "relaxed by the user: the motors are off";
// The report as events of kind "grasp" in a recording: parameters at the begin, and the outcome at
// the end, as JSON.
Event beginEvent(const GraspReport& report);
Event endEvent(const GraspReport& report);
// A step of a slip-aware grasp while it runs; also recorded as an event "grasp".
struct GraspStep {
  std::string action;  // "holding", "slip", "regrasp", "lower", "loosen", "friction", "at_limit",
                       // "over_limit" (and no stop was answered), "touch" (before it was expected),
                       // "interrupted" (no frames: nothing watches), "watched" (again)
  std::string text;    // one line for the user
  std::optional<std::size_t> matrix = {};
  int limitCounts = 0;
};
Event noteEvent(const GraspReport& report, const GraspStep& note, std::int64_t hostUs);

}  // namespace palpate
