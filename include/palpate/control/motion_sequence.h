// A sequence of motions, as a table of steps that is repeated: moves, grasps, holding, opening,
// waiting. It is a JSON file:
// {"format": "palpate-sequence", "version": 1, "hand": NAME, "repetitions": 3, "steps": [
//   {"step": "open", "preshape": "centrical", "velocity_deg_per_s": 20},
//   {"step": "pose", "pose": {..as saved_pose.h..}, "velocity_deg_per_s": 20},
//   {"step": "grasp", "mode": "reactive", "preshape": "centrical", "close": 1, .., "limit_counts":
//   200},
//   {"step": "hold", "seconds": 2}, {"step": "wait", "seconds": 1}]}
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/control/grasp_control.h>
#include <palpate/control/saved_pose.h>

namespace palpate {

struct SequenceStep {
  enum class Kind {
    kOpen,   // to the open hand of a preshape
    kPose,   // to a saved pose
    kGrasp,  // plain, reactive or slip-aware
    kHold,   // stays; the tactile stream must stay alive
    kWait,   // stays
  };
  Kind kind = Kind::kWait;
  GraspRequest request = {};  // of kOpen and kGrasp; of kPose its velocity
  SavedPose pose = {};        // of kPose
  double seconds = 1.0;       // of kHold and kWait, 0..86400 [s]
};
std::string describe(const SequenceStep& step);  // one line: "hold: 2 s"

struct MotionSequence {
  static constexpr int kMaxRepetitions = 10'000;
  static constexpr std::size_t kMaxSteps = 1000;
  std::string hand;  // HandDescription::name
  std::vector<SequenceStep> steps;
  int repetitions = 1;  // 1..10000

  // Throws std::invalid_argument that names the step and what is wrong with it for this hand: a
  // value out of range, a pose of another hand, a slip-aware grasp that would hold for ever. All
  // steps are checked before the first one moves.
  void validate(const HandDescription& hand) const;
};

std::string sequenceText(const MotionSequence& sequence);
// Throws FormatError that names the place and what is wrong; nothing is read in part. Ranges are
// checked by validate().
MotionSequence parseSequence(std::string_view text, const std::filesystem::path& file);

// Runs a sequence, advanced by the control cycle. Every command goes through GraspControl, which
// checks it. A stop or relax from any source, a lost port, a hand that is too hot, a motion of
// somebody else, a step that fails, and end() end the sequence and not only its step; no motion
// follows. Every function may be called from any thread.
class SequenceRun final : public ControlTask {
 public:
  struct Status {
    bool running = false;
    std::size_t step = 0;  // 0 first
    int repetition = 0;    // 0 first
    std::string text;      // one line: "step 2 of 5, 1 of 3 times: hold: 2 s"; at last the result
    bool failed = false;   // ended before the last step was done
  };

  // `control` must outlive the run.
  explicit SequenceRun(GraspControl& control) : control_(control) { control_.advance(*this); }
  ~SequenceRun() override { control_.forget(*this); }
  SequenceRun(const SequenceRun&) = delete;
  SequenceRun& operator=(const SequenceRun&) = delete;

  // Begins with the first step. Throws std::invalid_argument (validate()), DeviceError kRefused (a
  // sequence runs, the hand is too hot, or the first motion is refused); nothing runs then.
  // `hostUs` [us since 1970]: the present time by the session's clock.
  void begin(MotionSequence sequence, const HandDescription& hand, std::int64_t hostUs);
  void step(std::int64_t hostUs) override;
  // Ends the sequence for a reason from outside (an alarm), and stops what moves.
  void end(const std::string& why);

  Status status() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }
  bool running() const {
    const std::lock_guard lock(mutex_);
    return status_.running;
  }

 private:
  // The following functions require mutex_.
  void beginStep(std::int64_t hostUs);
  void next(std::int64_t hostUs);
  void finish(const std::string& text, bool failed);
  std::string place() const;
  bool usesTactile() const;

  GraspControl& control_;
  mutable std::mutex mutex_;
  MotionSequence sequence_;
  Status status_;
  std::int64_t sinceUs_ = 0;  // begin of the step [us since 1970]
  std::uint64_t stopsBefore_ = 0;
};

}  // namespace palpate
