// State machine of a grasp. Its inputs are frames, axis states and times; its outputs are the
// commands to be sent. It uses no thread, no port and no clock; GraspControl runs it.
//
//   idle --begin--> preshaping --> closing --> idle        (preshaping only with a start ratio)
//                        `------------`--> stopping --> idle
// At the limit it stays in the state settling for 0.5 s and measures how far the reading rises
// after the stop. A grasp that keeps its limit closes in two motions, and eases after the stop:
//
//   closing (fast) --near, or touched--> closing (slow) --limit--> stopping --> easing --> idle
//
// While it eases it opens by small steps, or follows an object that gave way. A slip-aware grasp
// continues after its first stop (and can end in every state, as the others):
//
//   closing --limit--> stopping --> settling --> holding --slips--> closing (limit raised) ..
//                                      ^            `--told to open--> loosening --> stopping --'
//
// While it settles or holds, a silence of the tactile stream of up to a second interrupts the watch
// and moves nothing: with the first frame after it the references are taken anew.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <palpate/control/finger_forces.h>
#include <palpate/control/grasp_approach.h>
#include <palpate/control/grasp_request.h>
#include <palpate/control/grip_monitor.h>
#include <palpate/control/stream_monitor.h>
#include <palpate/device/device.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

inline constexpr std::string_view kNothingHeldText = "finished: nothing is held any more";

enum class GraspPhase {
  kIdle,
  kPreshaping,
  kClosing,
  kStopping,
  kSettling,
  kEasing,  // small steps after the limit was reached, until the reading at rest is the limit
  kHolding,
  kLoosening
};
// Names: "idle", "preshaping", "closing", "stopping", "settling", "easing", "holding", "loosening".
std::string_view nameOf(GraspPhase phase);

class GraspStateMachine {
 public:
  explicit GraspStateMachine(HandDescription hand) : hand_(std::move(hand)), grip_(hand_) {}

  // Settings of the matrices as last read back from the controller; empty when unknown.
  void setSettings(std::vector<MatrixSettings> settings);

  // The calibration by which forces are measured; nothing: no grasp with a limit in newtons begins.
  void setCalibration(std::optional<Calibration> calibration);
  // Temperatures as last read, for the forces.
  void onTemperatures(const std::vector<double>& degC) { degC_ = degC; }

  // Begins a grasp; takeCommand() then returns the first motion. Throws std::invalid_argument
  // (request) and DeviceError kRefused; nothing must be sent then. Reasons to refuse: another grasp
  // runs; and, under tactile control, the tactile stream is not alive, a taxel or a finger is
  // already over its limit, a matrix on a moving finger can't measure the limit, or no calibration
  // can measure a limit in newtons. hostUs is used in the report. `touch`: what is remembered of
  // the object, for a grasp that keeps its limit.
  // Above its limit a slip-aware grasp without a start ratio is not refused while the hand still
  // holds what the last grasp left, which differed in nothing but its mode: the reading creeps. It
  // moves nothing at first, and watches what is held.
  void begin(const GraspRequest& request,
             std::int64_t monoUs,
             std::int64_t hostUs,
             const std::optional<Touch>& touch = {});

  // Processes every frame, also between grasps, so that the period of the stream is known when a
  // grasp begins.
  void onFrame(const TactileFrame& frame, std::int64_t monoUs);
  // The hand accepted the motion that was sent, and announced its duration [s].
  void onMoveAcknowledged(double durationS, std::int64_t monoUs);
  // The hand accepted the stop.
  void onStopAcknowledged(std::int64_t monoUs);
  // The command failed; `why` is one line. `sent` is false when the hand did not receive it.
  void onCommandFailed(const std::string& why, bool sent, std::int64_t monoUs);
  // Axis states as in Device::axisStates(); a motion ends when no axis moves.
  void onAxisStates(const std::vector<int>& states, std::int64_t monoUs);
  // Joint angles as last read; they give the rest of a motion when the motion port disappears, and
  // from where the hand gives way.
  void onAngles(const std::vector<double>& deg, std::int64_t monoUs) {
    anglesDeg_ = deg;
    anglesUs_ = monoUs;
  }
  // The motion controller's answers are missing or not valid, or the program failed at its port,
  // and the port's thread has sent stops: stops what runs until a stop is answered. A reading over
  // the limit meanwhile is reported, once.
  void onMotionFault(const std::string& why, std::int64_t monoUs);
  // The motion port was unplugged: the hand finishes its motion by itself.
  void onMotionPortGone(const std::string& why, std::int64_t monoUs);
  void onTactilePortGone(const std::string& why, std::int64_t monoUs);
  // Stop by the user: stops what runs, no effect when idle (the caller sends a stop in either
  // case).
  void stop(std::int64_t monoUs);
  void relax();
  // What the last grasp left at its limit is not known any more: the motors were switched off, or a
  // port was gone.
  void forgetHeld() noexcept { heldDeg_.clear(); }
  // Call this when a call above threw an unexpected exception: stops a running motion; the grasp
  // ends as failed.
  void fault(std::string_view why, std::int64_t monoUs);
  void onTime(std::int64_t monoUs);
  // Next time at which onTime() has something to do [monotonic us]; empty when it waits for another
  // input.
  std::optional<std::int64_t> nextUs() const;

  // Returns the command to be sent now, once: a MoveJoints or a StopMotion.
  std::optional<DeviceCommand> takeCommand();
  // Steps of a slip-aware grasp since the last call.
  std::vector<GraspStep> takeNotes() { return std::exchange(notes_, {}); }
  // The report of a grasp that has ended, once; the caller sets endUs.
  std::optional<GraspReport> takeReport();

  GraspPhase phase() const noexcept { return phase_; }
  bool active() const noexcept { return phase_ != GraspPhase::kIdle; }
  // True while stops are sent to a motion controller that doesn't answer.
  bool stopsBlindly() const noexcept { return stopsBlindly_; }
  // True while fingers move under tactile control, when no setting that changes the counts is
  // allowed.
  bool underTactileControl() const noexcept {
    return active() && report_.request.mode != GraspMode::kPlain;
  }
  const GraspReport& running() const noexcept { return report_; }
  // Text such as "holding for 12 s, 1 slip answered: limit 200 counts; rose to 3331 counts after
  // the stop, above its highest limit of 2200: close more slowly"; only of a slip-aware grasp. The
  // rise is told for as long as the reading stays that high.
  std::string holdingText(std::int64_t monoUs) const;
  // While a slip-aware grasp settles or holds and the tactile stream is silent: time without a
  // frame [us].
  std::optional<std::int64_t> unwatchedUs(std::int64_t monoUs) const;
  const StreamMonitor& stream() const noexcept { return stream_; }
  const TaxelPeak& peak() const noexcept { return peak_; }  // of the newest frame
  // Joint angles as last read [deg]; empty: not known.
  const std::vector<double>& anglesDeg() const noexcept { return anglesDeg_; }

 private:
  void send(MoveJoints motion, GraspPhase phase, std::int64_t monoUs);
  double remainingMotionS(std::int64_t monoUs) const;
  void stopWith(GraspOutcome outcome, const std::string& text, std::int64_t monoUs);
  void stopAgain(std::int64_t monoUs);
  void onOverLimitUnanswered(std::int64_t monoUs);
  void failWith(std::string_view why, std::string_view stoppedText, std::int64_t monoUs);
  void end(GraspOutcome outcome, const std::string& text);
  void motionEnded(const std::vector<int>& states, std::int64_t monoUs);
  bool isMoving() const noexcept {
    return phase_ == GraspPhase::kPreshaping || phase_ == GraspPhase::kClosing ||
           phase_ == GraspPhase::kLoosening || (phase_ == GraspPhase::kEasing && underWay_);
  }
  enum class Next { kEnd, kEase, kSettle, kClose };  // after a confirmed stop
  // The following functions belong to a grasp that keeps its limit.
  std::optional<double> presentRatio() const;
  bool isTouching() const noexcept;
  void close(std::int64_t monoUs);
  void watchTouch(std::int64_t monoUs);
  void noteTouch(std::int64_t monoUs);
  void noteSlope(std::int64_t monoUs);
  void beginEasing(std::int64_t monoUs);
  void onEasingFrame(std::int64_t monoUs);
  void moveBy(double openingDeg, std::int64_t monoUs);
  void endEasing(std::int64_t monoUs);
  // The largest reading or force as a multiple of its limit.
  double timesLimit() const noexcept;
  // "1.9 times the limit".
  std::string timesText() const;
  std::string restText() const;
  // The following functions belong to a slip-aware grasp.
  bool isHolding() const noexcept {
    return isSlipAware() && (phase_ == GraspPhase::kSettling || phase_ == GraspPhase::kHolding);
  }
  // True for a reactive grasp that has stopped at its limit and measures how far the reading rises.
  bool observesOvershoot() const noexcept {
    return !isSlipAware() && phase_ == GraspPhase::kSettling;
  }
  bool isSlipAware() const noexcept { return report_.request.mode == GraspMode::kSlip; }
  void note(const char* action, const std::string& text, std::optional<std::size_t> matrix = {});
  void pause(Next next, const std::string& text, std::int64_t monoUs);
  void settle(std::int64_t monoUs);
  void observeOvershoot(std::int64_t monoUs);
  void endOvershoot();
  void measurePeakAfterStop();
  std::string riseText() const;
  std::string overForceText() const;
  // Of the rise of the reading, or of the force, after the stop more than half is left.
  bool isStillRisen() const;
  std::string limitText() const;
  bool isOverLimit() const noexcept;
  // The taxel that is nearest to its limit, or farthest above it.
  const TaxelPeak& loadedTaxel(const GraspRequest& request) const noexcept;
  // The reading of a taxel, raised by as much as the limit of its finger is below limitCounts: it
  // is over its limit when this is over limit_.
  float commonCounts(const TaxelPeak& peak, const GraspRequest& request) const noexcept;
  float loadCounts() const noexcept {
    return commonCounts(loadedTaxel(report_.request), report_.request);
  }
  // The first finger above its limit in newtons, other than `except`.
  static std::optional<std::size_t> fingerOverForce(
      const GraspRequest& request,
      const std::optional<FingerForces>& forces,
      std::optional<std::size_t> except = {}) noexcept;
  std::string forceText(std::size_t finger) const;
  // The last grasp left the hand at its limit and differs from this slip-aware one in its mode
  // alone; since then no joint has moved, a taxel was pressed all the time, and creep explains the
  // largest reading.
  bool holdsAlready(const GraspRequest& request) const;
  std::optional<FingerForces> forcesFor(const GraspRequest& request, bool mayBeOver) const;
  bool updateLayout(const TactileFrame& frame);
  void requireMeasurableLimit(const GraspRequest& request) const;
  void onHoldingFrame(std::int64_t monoUs);
  void onLooseningFrame(std::int64_t monoUs);
  void onHoldingTime(std::int64_t monoUs);
  void onHoldingSilence(std::int64_t silenceUs);
  void onFramesBack(std::int64_t silenceUs, std::int64_t monoUs);
  std::int64_t holdingDeadAtUs() const;
  void respondToSlip(const GripSlip& slip, std::int64_t monoUs);
  void loosen(const char* action, const std::string& text, std::int64_t monoUs);
  void reportFriction(const GripSlip& slip);
  std::int64_t holdingNextUs() const;
  int fingerOf(std::size_t matrix) const noexcept;
  std::string placeOf(const TaxelPeak& peak) const;
  void refuse(const std::string& why) const;

  HandDescription hand_;  // with the layout of the newest frame
  std::vector<MatrixSettings> settings_;
  StreamMonitor stream_;
  TaxelPeak peak_;
  std::vector<TaxelPeak> matrixPeaks_;  // of the newest frame, one per matrix
  std::optional<Calibration> calibration_;
  TactileFrame newest_;  // kept only with a calibration
  std::vector<double> degC_;
  // Of the running grasp, when it has force limits.
  std::optional<FingerForces> forces_;

  GraspPhase phase_ = GraspPhase::kIdle;
  GraspReport report_;  // the running grasp
  std::optional<DeviceCommand> command_;
  // Motion that was sent and, as far as known, has neither ended nor been stopped.
  std::optional<MoveJoints> underWay_;
  std::vector<double> anglesDeg_;  // empty: not known
  std::int64_t anglesUs_ = 0;      // when they were read [monotonic us]
  // Angles at which the last grasp held an object at its limit; empty: it didn't, or the hand may
  // have let go since.
  std::vector<double> heldDeg_;
  bool closedToLimit_ = false;  // the limit of the running grasp was reached while it closed
  std::optional<GraspReport> ended_;
  // Time of the motion command or of the last stop.
  std::int64_t sentUs_ = 0;
  // Whether, and when, the hand confirmed the motion.
  bool acknowledged_ = false;
  std::int64_t acknowledgedUs_ = 0;  // [monotonic us]
  // End of the motion according to the hand's announcement.
  std::int64_t announcedUs_ = 0;
  // Time limit of the motion; after it the grasp fails.
  std::int64_t motionTimeoutUs_ = 0;
  std::int64_t stoppingSinceUs_ = 0;  // when the first stop was sent [monotonic us]
  // The grasp ends at this time if no stop was answered until then [monotonic us].
  std::int64_t stoppingUntilUs_ = 0;
  // Stops are sent to a controller that does not answer, and a reading over the limit was reported.
  bool stopsBlindly_ = false;
  bool reportedOverLimit_ = false;

  // Of a grasp that keeps its limit.
  std::optional<GraspApproach> approach_;
  bool approaching_ = false;     // in the fast part of the approach
  bool isNear_ = false;          // the fast part is over
  float restCounts_ = 0.0F;      // largest reading when the grasp began
  double closingDegPerS_ = 0.0;  // velocity of the last closing motion
  std::int64_t touchedUs_ = 0;   // when it was felt first [monotonic us]
  double touchedTimes_ = 0.0;    // the reading then, as a multiple of the limit
  double timesPerDeg_ = 0.0;     // slope of that multiple over the angle [1/deg]; 0: not known
  // Smallest and largest multiple since the reading hardly changes, and for how many frames.
  std::pair<double, double> restTimes_;
  int restFrames_ = 0;
  int stillFrames_ = 0;             // since the joints are at rest
  bool follows_ = false;            // a step under way closes
  double steepest_ = 0.0;           // largest timesPerDeg_
  double easedTimes_ = 0.0;         // the multiple before the last step
  double easedDeg_ = 0.0;           // the last step [deg]; 0: none yet
  std::int64_t easingUntilUs_ = 0;  // [monotonic us]
  std::int64_t stillSinceUs_ = 0;   // since when the joints are at rest [monotonic us]

  GripMonitor grip_;
  std::vector<GraspStep> notes_;
  Next next_ = Next::kEnd;
  int limit_ = 0;  // present limit [counts]
  // True once the object was held; the following rests are shorter.
  bool held_ = false;
  std::int64_t heldFromUs_ = 0;  // when it was held first
  int answeredSlips_ = 0;        // slips after which the hand closed
  // It slipped where it can't be held harder: it isn't opened any further until it closes again.
  bool slippedAtLimit_ = false;
  // The stream fell silent while it was held, and no frame has come since.
  bool interrupted_ = false;
  // As the grasp began; silences while it holds must not make a longer one usual [us].
  std::int64_t silenceLimitUs_ = 0;
  bool frictionTestRunning_ = false;  // loosening measures friction
  bool frictionTested_ = false;       // friction was measured, or tried
  std::int64_t settledUs_ = 0;        // end of the rest or of loosening
  std::int64_t lastSlipUs_ = 0;       // the last slip, or change of the limit
  std::int64_t endUs_ = 0;            // end of holding; 0: on request
};

}  // namespace palpate
