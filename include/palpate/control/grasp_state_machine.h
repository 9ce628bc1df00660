// State machine of a grasp. Its inputs are frames, axis states and times; its outputs are the
// commands to be sent. It uses no thread, no port and no clock; GraspControl runs it.
//
//   idle --begin--> preshaping --> closing --> idle        (preshaping only with a start ratio)
//                        `------------`--> stopping --> idle
// At the limit it stays in the state settling for 0.5 s and measures how far the reading rises
// after the stop.
// A slip-aware grasp goes on from its first stop (and ends, from anywhere, as the others do):
//
//   closing --limit--> stopping --> settling --> holding --slips--> closing (limit raised) ..
//                                      ^            `--told to open--> loosening --> stopping --'
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <palpate/control/grasp_request.h>
#include <palpate/control/grip_monitor.h>
#include <palpate/control/stream_monitor.h>
#include <palpate/device/device.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

enum class GraspPhase { kIdle, kPreshaping, kClosing, kStopping, kSettling, kHolding, kLoosening };
// "idle", "preshaping", "closing", "stopping", "settling", "holding", "loosening"
std::string_view nameOf(GraspPhase phase);

class GraspStateMachine {
 public:
  explicit GraspStateMachine(HandDescription hand) : hand_(std::move(hand)), grip_(hand_) {}

  // What the controller says of its matrices, as last read back; empty: not known.
  void setSettings(std::vector<MatrixSettings> settings) { settings_ = std::move(settings); }

  // Begins a grasp; then takeCommand() has the first motion. Throws std::invalid_argument (request)
  // and DeviceError, kRefused (a grasp runs; one under tactile control without a living tactile
  // stream, with a taxel over the limit already, or with a matrix on a moving finger that can't
  // tell its limit): nothing is to be sent then. hostUs: for the report.
  void begin(const GraspRequest& request, std::int64_t monoUs, std::int64_t hostUs);

  // Frames are watched all the time, so that a grasp knows its stream when it begins.
  void onFrame(const TactileFrame& frame, std::int64_t monoUs);
  // The hand took the motion that was sent, and announced its duration [s] ..
  void onMoveAcknowledged(double durationS, std::int64_t monoUs);
  // .. or the stop; ..
  void onStopAcknowledged(std::int64_t monoUs);
  // .. or the command failed: `why` is one line. Not sent: the hand knows nothing of it.
  void onCommandFailed(const std::string& why, bool sent, std::int64_t monoUs);
  // Device::axisStates(): ends a motion when none moves.
  void onAxisStates(const std::vector<int>& states, std::int64_t monoUs);
  // Joint angles as last read: how far a motion still goes when its port goes away.
  void onAngles(const std::vector<double>& deg) { anglesDeg_ = deg; }
  void onMotionPortGone(const std::string& why, std::int64_t monoUs);
  void onTactilePortGone(const std::string& why, std::int64_t monoUs);
  // The user: stops what runs, does nothing when idle (but a stop is to be sent whatever this
  // says).
  void stop(std::int64_t monoUs);
  void relax();
  // The program failed in the middle of this: what moves is stopped, and the grasp ends as failed.
  void fault(std::string_view why, std::int64_t monoUs);
  void onTime(std::int64_t monoUs);
  // When onTime() has something to do [monotonic us]; nothing: not before something happens.
  std::optional<std::int64_t> nextUs() const;

  // What is to be sent now, once: a MoveJoints or a StopMotion.
  std::optional<DeviceCommand> takeCommand();
  // What a slip-aware grasp has to tell since the last call.
  std::vector<GraspStep> takeNotes() { return std::exchange(notes_, {}); }
  // The report of a grasp that has ended, once; endUs is the caller's to fill in.
  std::optional<GraspReport> takeReport();

  GraspPhase phase() const noexcept { return phase_; }
  bool active() const noexcept { return phase_ != GraspPhase::kIdle; }
  // Fingers move under tactile control: nobody may change what a count means.
  bool underTactileControl() const noexcept {
    return active() && report_.request.mode != GraspMode::kPlain;
  }
  const GraspReport& running() const noexcept { return report_; }
  const StreamMonitor& stream() const noexcept { return stream_; }
  const TaxelPeak& peak() const noexcept { return peak_; }  // of the newest frame

 private:
  void move(double closeRatio, GraspPhase phase, std::int64_t monoUs);
  void send(MoveJoints motion, GraspPhase phase, std::int64_t monoUs);
  double remainingMotionS(std::int64_t monoUs) const;
  void stopWith(GraspOutcome outcome, const std::string& text, std::int64_t monoUs);
  void end(GraspOutcome outcome, const std::string& text);
  void motionEnded(const std::vector<int>& states, std::int64_t monoUs);
  bool isMoving() const noexcept {
    return phase_ == GraspPhase::kPreshaping || phase_ == GraspPhase::kClosing ||
           phase_ == GraspPhase::kLoosening;
  }
  // Of a slip-aware grasp.
  enum class Next { kEnd, kSettle, kClose };  // when a stop was taken
  bool isHolding() const noexcept {
    return isSlipAware() && (phase_ == GraspPhase::kSettling || phase_ == GraspPhase::kHolding);
  }
  // A reactive grasp that has stopped at its limit, and looks what becomes of it.
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
  std::string holdingText() const;
  bool isOverLimit() const noexcept;
  bool updateLayout(const TactileFrame& frame);
  void requireMeasurableLimit(const GraspRequest& request) const;
  void onHoldingFrame(std::int64_t monoUs);
  void onLooseningFrame(std::int64_t monoUs);
  void onHoldingTime(std::int64_t monoUs);
  void respondToSlip(const GripSlip& slip, std::int64_t monoUs);
  void loosen(const char* action, const std::string& text, std::int64_t monoUs);
  void reportFriction(const GripSlip& slip);
  std::int64_t holdingNextUs() const;
  std::string placeOf(const TaxelPeak& peak) const;
  void refuse(const std::string& why) const;

  HandDescription hand_;  // its layout: that of the newest frame
  std::vector<MatrixSettings> settings_;
  StreamMonitor stream_;
  TaxelPeak peak_;

  GraspPhase phase_ = GraspPhase::kIdle;
  GraspReport report_;  // of the grasp that runs
  std::optional<DeviceCommand> command_;
  std::optional<MoveJoints> underWay_;  // sent, and neither ended nor stopped as far as is known
  std::vector<double> anglesDeg_;       // empty: not known
  std::optional<GraspReport> ended_;
  std::int64_t sentUs_ = 0;           // the motion, or the last stop
  bool acknowledged_ = false;         // the hand has answered the motion ..
  std::int64_t acknowledgedUs_ = 0;   // .. then
  std::int64_t announcedUs_ = 0;      // end of the motion by the hand's announcement
  std::int64_t motionTimeoutUs_ = 0;  // then it is given up
  int stops_ = 0;

  GripMonitor grip_;
  std::vector<GraspStep> notes_;
  Next next_ = Next::kEnd;
  int limit_ = 0;                     // now [counts]
  bool held_ = false;                 // it has held before: the rest is shorter
  bool frictionTestRunning_ = false;  // loosening looks for friction
  bool frictionTested_ = false;       // it was looked for
  std::int64_t settledUs_ = 0;        // end of the rest, or of loosening
  std::int64_t lastSlipUs_ = 0;       // the last slip, or change of the limit
  std::int64_t endUs_ = 0;            // of holding; 0: open
};

}  // namespace palpate
