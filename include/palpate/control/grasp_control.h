// Moves the hand of a capture session: preshape, plain and reactive grasps, relax, and a stop at
// any moment.
//
// Driven by the frames as they arrive, on a thread of its own: a frame over the limit puts the stop
// on the wire within milliseconds. Values are checked before a byte is sent. Connecting moves
// nothing. What happened is noted in the session as events "grasp" (and by the device as "motion"),
// so that a recording holds it. docs/safety.md says what is promised, and what the hand does when
// nobody is there any more.
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
#include <palpate/control/grasp_request.h>
#include <palpate/control/grasp_state_machine.h>
#include <palpate/core/time.h>

namespace palpate {

struct GraspStatus {
  GraspPhase phase = GraspPhase::kIdle;
  std::optional<GraspRequest> request;  // of the grasp that runs
  std::optional<GraspReport> last;      // of the one that ended last, a refused one too
  std::string cannotMove;               // why no motion can begin, one line; empty: it can
  // The grasp whose motion port went away, as long as it has not come back, whatever was refused
  // since.
  std::optional<GraspReport> portGone;
  // Number of calls of stop() and relax() so far, whether or not something was moving.
  std::uint64_t stopsAsked = 0;
  std::string cannotReact;  // why no reactive grasp can begin; empty: it can
  // why sensitivity, threshold and masks can't be changed; empty: they can
  std::string cannotChange;
  double periodMs = 0.0;        // median period of the frames [ms]; 0: not known
  double silenceLimitMs = 0.0;  // after so long without a frame the stream is dead [ms]
};

// A grasp went over into a phase, or ended (then it is idle and has a report).
struct GraspChange {
  std::int64_t hostUs = 0;  // [us since 1970]
  GraspPhase phase = GraspPhase::kIdle;
  std::string text;  // one line: "closing", "limit reached: finger 0 distal, x 2, y 3: 231 counts"
  std::optional<GraspReport> report;
};

// Every member may be called from any thread, and none waits for the hand.
class GraspControl {
 public:
  // Listens to the session, which must outlive this; moves nothing. The clock is the session's.
  explicit GraspControl(CaptureSession& session, const Clock& clock = systemClock());
  // A motion that runs is stopped (waits for that, 300 ms at most).
  ~GraspControl();
  GraspControl(const GraspControl&) = delete;
  GraspControl& operator=(const GraspControl&) = delete;

  // Runs the control cycle on a thread of its own; has no effect if it runs already. Without it the
  // caller runs the cycle by step(), after each frame and every 5 ms during a motion.
  void run();
  void step();

  // An exception in a cycle (a defect, no memory) does not end the process: a stop is sent, the
  // grasp ends as failed, an
  // event "alarm" says why, and the rounds go on.

  // Begins a grasp. Throws std::invalid_argument (a value out of range or not a number) and
  // DeviceError, kRefused (why, in a line); nothing was sent then, and the refusal is noted.
  void grasp(const GraspRequest& request);
  // To the open hand of a preshape: a plain grasp with close ratio 0.
  void preshape(const std::string& name, double velocityDegPerS);
  // A stop goes to the wire now, whether something moves or not; no motion follows it.
  void stop() noexcept;
  // Stops, then motors off: fingers can be moved by hand, and what is held may fall.
  void relax() noexcept;
  // Sensitivity, threshold, mask. Throws DeviceError, kRefused, while fingers move under tactile
  // control; std::invalid_argument for a command that is no setting.
  std::shared_future<CommandAnswer> change(const DeviceCommand& setting);

  GraspStatus status() const;
  // What changed since the last call, the last 1000 at most.
  std::vector<GraspChange> takeChanges();

 private:
  struct SentCommand {
    std::future<CommandAnswer> answer;
    bool isStop = false;
  };
  void loop(const std::stop_token& stop);
  // All of these under mutex_.
  void runCycle();
  void runGuardedCycle() noexcept;
  void fault(const char* what) noexcept;
  void note(RecordingEvent event, bool ends = false);
  void processFrames();  // frames
  void pollReplies();    // of the hand
  void checkLinks();
  void send();
  void report();
  void refused(const GraspRequest& request, const std::string& why);
  void reportPhase(GraspPhase phase,
                   const std::string& text,
                   std::optional<GraspReport> report = {});
  static std::string motionProblem(const DeviceStatus& status);
  bool settingsPending() const;

  // Hands over to the session what is owed to it; without mutex_: a consumer of the session may be
  // in no hurry.
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
  std::deque<GraspChange> changes_;
  std::optional<GraspReport> portGone_;  // see GraspStatus
  std::uint64_t stopsAsked_ = 0;
  std::string lastFault_;         // said, and not again for a while in this grasp
  std::int64_t lastFaultUs_ = 0;  // [monotonic us]
  struct PendingEvent {
    RecordingEvent event;
    bool ends = false;  // of a grasp
  };
  std::deque<PendingEvent> pendingEvents_;
  std::size_t pendingEndEvents_ = 0;  // ends that the session wasn't told yet
  std::condition_variable_any pendingEventsChanged_;
  std::jthread delivery_;
  std::jthread thread_;
};

}  // namespace palpate
