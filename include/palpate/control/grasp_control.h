// Moves the hand of a capture session: preshape, plain and reactive grasps, relax, and a stop at
// any moment.
//
// A thread of its own processes the frames as they arrive: a frame over the limit causes a stop
// command within milliseconds. Values are checked before a byte is sent. Connecting causes no
// motion. The steps of a grasp are noted in the session as events "grasp" (and by the device as
// "motion"), so that a recording contains them. docs/notes/safety.md describes what is guaranteed,
// and what the hand does when the program no longer controls it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_approach.h>
#include <palpate/control/grasp_request.h>
#include <palpate/control/grasp_state_machine.h>
#include <palpate/control/hand_condition.h>
#include <palpate/core/time.h>

namespace palpate {

struct GraspStatus {
  GraspPhase phase = GraspPhase::kIdle;
  std::optional<GraspRequest> request;  // the running grasp
  std::optional<GraspReport> running;   // what is known of it until now
  // While a slip-aware grasp holds: for how long, how many slips were answered, its limit, and how
  // far the reading is above it. One line.
  std::string holding;
  // The friction that the running grasp has measured; empty: none yet.
  std::optional<double> friction;
  // While a slip-aware grasp holds and the tactile stream is silent: time without a frame [ms].
  std::optional<double> unwatchedMs;
  std::optional<GraspReport> last;  // the grasp that ended last, including a refused one
  // The grasp that ended last and was not refused.
  std::optional<GraspReport> lastMotion;
  // How the grasp ended whose protection ended with it (protectionEnded()), one line; empty once
  // that was acknowledged, and without one.
  std::string unprotected;
  // Reason why no motion can begin, one line; empty when one can begin.
  std::string cannotMove;
  // Report of the grasp during which the motion port disappeared. Kept until the port is back, even
  // if other grasps are refused meanwhile.
  std::optional<GraspReport> portGone;
  // Whether relax() switched the motors off, and no motion has begun since.
  bool motorsOff = false;
  // Whether the motion port was away since `lastMotion` ended: what the hand holds is not known.
  bool wasAway = false;
  // The temperature sensors above their limit (HealthOptions::maxTemperatureDegC) at the last
  // reading, "motor 3 71.5 °C"; empty: none.
  std::string tooHot;
  // Number of calls of stop() and relax() so far, whether or not something was moving.
  std::uint64_t stopsAsked = 0;
  // Joint angles as last read [deg]; empty: not known.
  std::vector<double> anglesDeg;
  // Number of grasps so far from which touches() learnt.
  std::uint64_t touchesLearnt = 0;
  // Whether a calibration is set, so that a grasp may have a limit in newtons.
  bool calibrated = false;
  // Reason why no reactive grasp can begin; empty when one can begin.
  std::string cannotReact;
  // Whether the answer to a changed tactile setting is awaited: the only reason in `cannotReact`
  // that passes by itself.
  bool changesSetting = false;
  // Reason why sensitivity, thresholds and masks can't be changed; empty when they can.
  std::string cannotChange;
  double periodMs = 0.0;  // median period of the frames [ms]; 0: not known
  // Time without a frame after which the stream counts as dead [ms].
  double silenceLimitMs = 0.0;
};

// A grasp entered a phase, or ended (then the phase is idle and there is a report).
struct GraspChange {
  std::int64_t hostUs = 0;  // [us since 1970]
  GraspPhase phase = GraspPhase::kIdle;
  // One line: "closing", "limit reached: finger 0 distal, x 2, y 3: 231 counts".
  std::string text;
  std::optional<GraspReport> report;
  ExplainedCondition condition = {};  // of the hand, since this change
};

// Moves the hand in several steps, which the control cycle advances (GraspControl::advance()).
class ControlTask {
 public:
  virtual ~ControlTask() = default;
  // Called after each control cycle, at least every 100 ms. `hostUs`: the present time by the
  // session's clock [us since 1970]. An exception stops the hand and is an event "alarm".
  virtual void step(std::int64_t hostUs) = 0;
};

// Every function may be called from any thread, and none waits for the hand.
class GraspControl {
 public:
  // Subscribes to the session, which must outlive this object; causes no motion. `clock` is that of
  // the session.
  explicit GraspControl(CaptureSession& session, const Clock& clock = systemClock());
  // Stops a running motion and waits for the answer, at most 300 ms.
  ~GraspControl();
  GraspControl(const GraspControl&) = delete;
  GraspControl& operator=(const GraspControl&) = delete;

  // Runs the control cycle on a thread of its own; has no effect if it runs already. Without it the
  // caller runs the cycle by step(), after each frame and every 5 ms during a motion.
  void run();
  void step();
  // Advances the task from now on, whatever else the program does, until forget() has returned.
  void advance(ControlTask& task);
  // Not to be called by a task. Waits for a step that runs.
  void forget(ControlTask& task) noexcept;

  // An exception in a cycle (a defect, no memory) does not end the process: a stop is sent, the
  // grasp ends as failed, an event "alarm" contains the reason, and the control cycle continues.

  // Begins a grasp. Throws std::invalid_argument (a value out of range or not a number) and
  // DeviceError kRefused (with the reason in one line); nothing was sent then, and the refusal is
  // noted. With `stopsBefore` it is refused, too, when a stop or relax was requested since the
  // status in which GraspStatus::stopsAsked had this value: a motion that follows another one by
  // itself must not begin after a stop.
  void grasp(const GraspRequest& request, std::optional<std::uint64_t> stopsBefore = {});
  // Moves to the open hand of a preshape: a plain grasp with close ratio 0.
  void preshape(const std::string& name, double velocityDegPerS);
  // Sends a stop at once, whether or not the hand moves; no motion follows it.
  void stop() noexcept;
  // Stops, then switches the motors off: fingers can be moved by hand, and a held object may fall.
  // While stops are sent to a controller that doesn't answer, the motors are switched off once one
  // is answered; otherwise an event "alarm" says that they were not.
  void relax() noexcept;
  // The user has seen that a protection ended (GraspStatus::unprotected). The next motion and
  // relax() acknowledge it, too; a stop doesn't.
  void acknowledge();
  // Sets the calibration by which limits in newtons are measured; nothing: such a grasp is refused.
  // Holds from the next grasp on.
  void setCalibration(std::optional<Calibration> calibration);
  // What is remembered of named objects, for grasps that keep their limit; such grasps add to it.
  void setTouches(TouchMemory touches);
  TouchMemory touches() const;
  // Of a grasp under tactile control, from the present angles. Throws std::invalid_argument for an
  // unknown preshape.
  GraspForecast forecast(const GraspRequest& request) const;
  // Changes sensitivity, threshold or mask. Throws DeviceError kRefused while fingers move under
  // tactile control; throws std::invalid_argument for a command that is no setting.
  std::shared_future<CommandAnswer> change(const DeviceCommand& setting);

  GraspStatus status() const;
  ExplainedCondition condition() const { return conditionOf(status()); }
  // Changes since the last call, at most the last 1000.
  std::vector<GraspChange> takeChanges();

 private:
  struct SentCommand {
    std::future<CommandAnswer> answer;
    bool isStop = false;
  };
  void loop(const std::stop_token& stop);
  void runTasks() noexcept;
  // The following functions require mutex_.
  void runCycle();
  void guarded(auto&& work) noexcept;  // an exception becomes a fault()
  void runGuardedCycle() noexcept;
  void fault(const char* what) noexcept;
  void note(Event event, bool ends = false);
  void processFrames();  // of the tactile stream
  void onTemperatures(const std::vector<double>& degC);
  void pollReplies();  // answers of the hand
  void checkLinks();
  void checkReturn(const DeviceStatus& status);
  void send();
  void report();
  void onEnded(const GraspReport& ended);
  GraspStatus presentStatus() const;
  void switchMotorsOff(bool isNote);
  void refused(const GraspRequest& request, const std::string& why);
  void reportPhase(GraspPhase phase,
                   const std::string& text,
                   std::optional<GraspReport> report = {});
  static bool isTactilePortGone(const DeviceStatus& status);
  static std::string motionProblem(const DeviceStatus& status);
  bool settingsPending() const;

  // Delivers the pending events to the session. Called without mutex_, because a consumer of the
  // session may be slow.
  void deliverEvents();
  void deliverLoop(const std::stop_token& stop);
  void deliverHere();

  CaptureSession& session_;
  const Clock& clock_;
  std::shared_ptr<CaptureQueue> queue_;

  mutable std::mutex mutex_;
  GraspStateMachine machine_;
  std::vector<CaptureItem> items_;
  std::optional<SentCommand> sentCommand_;               // the newest command of the grasp
  std::vector<std::future<CommandAnswer>> stopResults_;  // of stops and relaxes outside of a grasp
  std::vector<std::shared_future<CommandAnswer>> settings_;
  GraspPhase reportedPhase_ = GraspPhase::kIdle;
  std::optional<GraspReport> last_;
  std::optional<GraspReport> lastMotion_;
  std::string unprotected_;  // see GraspStatus
  bool wasAway_ = false;     // see GraspStatus
  // PortStatus::reconnects as last seen.
  std::optional<std::uint64_t> motionReturns_, tactileReturns_;
  std::deque<GraspChange> changes_;
  std::optional<GraspReport> portGone_;  // see GraspStatus
  std::string tooHot_;                   // see GraspStatus
  bool motorsOff_ = false;
  bool relaxWhenStopped_ = false;
  std::uint64_t stopsAsked_ = 0;
  bool calibrated_ = false;
  TouchMemory touches_;
  std::uint64_t touchesLearnt_ = 0;
  // Last reported fault; the same fault is not reported again for a while in this grasp.
  std::string lastFault_;
  std::int64_t lastFaultUs_ = 0;  // [monotonic us]
  struct PendingEvent {
    Event event;
    bool ends = false;  // true for the end of a grasp
  };
  std::deque<PendingEvent> pendingEvents_;
  // Number of grasp ends that are not yet delivered to the session.
  std::size_t pendingEndEvents_ = 0;
  std::condition_variable_any pendingEventsChanged_;
  // Never taken while mutex_ is held.
  std::mutex tasksMutex_;
  std::vector<ControlTask*> tasks_;
  std::jthread delivery_;
  std::jthread thread_;
};

}  // namespace palpate
