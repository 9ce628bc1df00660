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

#include <cmath>
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
// Whether a phase can be followed directly by another one, as in the diagram above.
bool mayFollow(GraspPhase phase, GraspPhase next);

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
  void relax() {
    if (active()) end(GraspOutcome::kRelaxed, std::string(kRelaxedText));
  }
  // What the last grasp left at its limit is not known any more: the motors were switched off, or a
  // port was gone.
  void forgetHeld() noexcept { heldDeg_.clear(); }
  // Call this when a call above threw an unexpected exception: stops a running motion; the grasp
  // ends as failed.
  void fault(std::string_view why, std::int64_t monoUs) { failWith(why, ": stopped", monoUs); }
  void onTime(std::int64_t monoUs);
  // Next time at which onTime() has something to do [monotonic us]; empty when it waits for another
  // input.
  std::optional<std::int64_t> nextUs() const;

  // Returns the command to be sent now, once: a MoveJoints or a StopMotion.
  std::optional<DeviceCommand> takeCommand() { return std::exchange(command_, std::nullopt); }
  // Steps of a slip-aware grasp since the last call.
  std::vector<GraspStep> takeNotes() { return std::exchange(notes_, {}); }
  // The report of a grasp that has ended, once; the caller sets endUs.
  std::optional<GraspReport> takeReport() { return std::exchange(ended_, std::nullopt); }

  GraspPhase phase() const noexcept;
  bool active() const noexcept { return state_ != State::kIdle; }
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
  std::optional<std::int64_t> unwatchedUs(std::int64_t monoUs) const {
    return interrupted_ ? stream_.silenceUs(monoUs) : std::nullopt;
  }
  const StreamMonitor& stream() const noexcept { return stream_; }
  const TaxelPeak& peak() const noexcept { return peak_; }  // of the newest frame
  // Joint angles as last read [deg]; empty: not known.
  const std::vector<double>& anglesDeg() const noexcept { return anglesDeg_; }

 private:
  // A phase may be several states: settling is the look at the rise after the stop of a reactive
  // grasp, or the rest of a slip-aware one; while it eases, a step is under way or the hand rests.
  enum class State {
    kIdle,
    kPreshaping,
    kClosing,
    kStopping,
    kOvershoot,
    kSettling,
    kEasing,
    kEasingStep,
    kHolding,
    kLoosening
  };
  struct FrameEvent {
    std::int64_t monoUs = 0;
    std::int64_t hostUs = 0;                     // [us since 1970]
    std::optional<std::int64_t> silenceUs = {};  // before this frame, where it was too long
  };
  using Self = GraspStateMachine;
  using Phase = GraspPhase;
  // What a state does, and what may follow (grasp_state_machine.cpp).
  struct StateRow;
  static const StateRow kStates[];  // in the order of State
  static constexpr bool eachRowHasItsState();
  const StateRow& row() const noexcept;
  friend std::string_view nameOf(GraspPhase phase);
  friend bool mayFollow(GraspPhase phase, GraspPhase next);

  static std::int64_t microsecondsOf(double seconds) { return std::llround(seconds * 1e6); }
  // An unanswered stop is sent again after this time.
  static constexpr std::int64_t kStopAgainUs = 250'000;

  bool updateLayout(const TactileFrame& frame);

  // What is checked before a grasp begins, and readings beside their limits (grasp_limits.cpp).
  void refuse(const std::string& why) const;
  void requireMeasurableLimit(const GraspRequest& request) const;
  std::optional<FingerForces> forcesFor(const GraspRequest& request, bool mayBeOver) const;
  // The last grasp left the hand at its limit and differs from this slip-aware one in its mode
  // alone; since then no joint has moved, a taxel was pressed all the time, and creep explains the
  // largest reading.
  bool holdsAlready(const GraspRequest& request) const;
  int fingerOf(std::size_t matrix) const noexcept;
  bool isOverLimit() const noexcept;
  // The taxel that is nearest to its limit, or farthest above it.
  const TaxelPeak& loadedTaxel(const GraspRequest& request) const noexcept;
  // The reading of a taxel, raised by as much as the limit of its finger is below limitCounts: it
  // is over its limit when this is over limit_.
  float commonCounts(const TaxelPeak& peak, const GraspRequest& request) const noexcept;
  float loadCounts() const noexcept {
    return commonCounts(loadedTaxel(report_.request), report_.request);
  }
  // A reading as a multiple of the limit of its finger.
  double timesLimitOf(const TaxelPeak& peak) const noexcept;
  // The largest reading or force as a multiple of its limit.
  double timesLimit() const noexcept;
  // The first finger above its limit in newtons, other than `except`.
  static std::optional<std::size_t> fingerOverForce(
      const GraspRequest& request,
      const std::optional<FingerForces>& forces,
      std::optional<std::size_t> except = {}) noexcept;
  void measurePeakAfterStop();
  // Of the rise of the reading, or of the force, after the stop more than half is left.
  bool isStillRisen() const;

  // Texts (grasp_texts.cpp).
  std::string placeOf(const TaxelPeak& peak) const;
  std::string forceText(std::size_t finger) const;
  std::string timesText() const;
  std::string riseText() const;
  std::string overForceText() const;
  std::string limitText() const;
  std::string restText() const;
  std::string heldText() const;
  void note(const char* action, const std::string& text, std::optional<std::size_t> matrix = {}) {
    notes_.push_back({action, text, matrix, limit_});
  }

  // Motions and closing (grasp_closing.cpp).
  void send(MoveJoints motion, State state, std::int64_t monoUs);
  // Longest time for which the motion sent last can continue without control [s]; 0 if none runs.
  double remainingMotionS(std::int64_t monoUs) const;
  bool isMoving() const noexcept;
  void onMovingFrame(const FrameEvent& frame);
  void onLimit(const FrameEvent& frame);
  void onMovingTime(std::int64_t monoUs);
  void onMotionEnd(const std::vector<int>& states, std::int64_t monoUs);
  void onOvershootTime(std::int64_t monoUs) {
    if (monoUs >= settledUs_) endOvershoot();
  }
  void endOvershoot() { end(report_.outcome, report_.text + riseText() + overForceText()); }
  std::optional<double> presentRatio() const { return closeRatioOf(report_.request, anglesDeg_); }
  void close(std::int64_t monoUs);
  void watchTouch(std::int64_t monoUs);
  void noteTouch(std::int64_t monoUs);
  void noteSlope(std::int64_t monoUs);

  // Stops, failures and ends (grasp_stopping.cpp).
  void stopWith(GraspOutcome outcome, const std::string& text, std::int64_t monoUs);
  void stopForSilence(std::int64_t silenceUs, std::int64_t monoUs);
  void stopAgain(std::int64_t monoUs);
  void pause(State next, const std::string& text, std::int64_t monoUs);
  void onStoppingFrame(const FrameEvent& frame);
  void onStoppingTime(std::int64_t monoUs);
  void failWith(std::string_view why, std::string_view stoppedText, std::int64_t monoUs);
  void end(GraspOutcome outcome, const std::string& text);

  // Easing of a grasp that keeps its limit (grasp_easing.cpp).
  void beginEasing(std::int64_t monoUs);
  void onEasingFrame(const FrameEvent& frame);
  void onEasingTime(std::int64_t monoUs);
  void onStepEnd(const std::vector<int>& states, std::int64_t monoUs);
  void moveBy(double openingDeg, std::int64_t monoUs);
  void endEasing(std::int64_t monoUs);

  // Holding of a slip-aware grasp (grasp_holding.cpp).
  bool isHolding() const noexcept {
    return state_ == State::kSettling || state_ == State::kHolding;
  }
  bool isSlipAware() const noexcept { return report_.request.mode == GraspMode::kSlip; }
  void settle(std::int64_t monoUs);
  void onSettlingFrame(const FrameEvent& frame);
  void onHoldingFrame(const FrameEvent& frame);
  void onHoldingTime(std::int64_t monoUs);
  std::int64_t holdingNextUs() const;
  void onHoldingSilence(std::int64_t silenceUs);
  void onFramesBack(std::int64_t silenceUs, std::int64_t monoUs);
  std::int64_t holdingDeadAtUs() const;
  void respondToSlip(const GripSlip& slip, std::int64_t monoUs);

  // Loosening, and the measurement of friction (grasp_loosening.cpp).
  void loosen(const char* action, const std::string& text, std::int64_t monoUs);
  void onLooseningFrame(const FrameEvent& frame);
  void reportFriction(const GripSlip& slip);

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

  State state_ = State::kIdle;
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
  State next_ = State::kIdle;  // after a confirmed stop; idle: the grasp ends
  int limit_ = 0;              // present limit [counts]
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
