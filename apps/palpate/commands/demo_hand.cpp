#include "commands/demo_hand.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "palpate/capture/replay.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/device/live_hand.h"
#include "palpate/emulator/joint_motion.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/preshape.h"

namespace palpate::commands {
namespace {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

constexpr double kHoldS = 1.2;
constexpr double kOpeningDegPerS = 60.0;
constexpr milliseconds kLook{10};

// Compares the replayed data with the recorded data while it arrives.
class ReplayComparison : public DeviceSink {
 public:
  explicit ReplayComparison(const Profile& profile) : profile_(profile) {}

  void onFrame(TactileFrame&& frame) override {
    if (frames_ < profile_.numFrames()) {
      profile_.readFrame(frames_, expected_);
      if (expected_.values != frame.values || expected_.hostUs != frame.hostUs) ++different_;
    }
    ++frames_;
  }
  void onAngles(JointAngles&& sample) override {
    if (angles_ < profile_.numAngles()) {
      const JointAngles expected = profile_.angles(angles_);
      if (expected.deg != sample.deg || expected.hostUs != sample.hostUs) ++different_;
    }
    ++angles_;
  }
  void onTemperatures(Temperatures&& sample) override {
    if (temperatures_ < profile_.numTemperatures() &&
        profile_.temperatures(temperatures_).degC != sample.degC)
      ++different_;
    ++temperatures_;
  }
  void onEvent(DeviceEvent&&) override {}

  std::string prediction() const {
    if (different_ > 0 || frames_ != profile_.numFrames() || angles_ != profile_.numAngles() ||
        temperatures_ != profile_.numTemperatures())
      throw Error("the replay differs from the recording in " + std::to_string(different_) +
                  " items");
    return std::to_string(frames_) + " frames and " + std::to_string(angles_) +
           " samples of the joint angles are identical in the replay";
  }

 private:
  const Profile& profile_;
  TactileFrame expected_;
  std::size_t frames_ = 0, angles_ = 0, temperatures_ = 0, different_ = 0;
};

bool isPositioning(int state) { return state == static_cast<int>(AxisState::kPositioning); }

}  // namespace

DemoHand::DemoHand(const Scene& scene, std::string object, DemoContinue goOn)
    : object_(std::move(object)),
      preshape_(scene.preshape),
      continue_(std::move(goOn)),
      truth_(std::make_shared<Truth>()),
      hand_(std::make_unique<EmulatedHand>(
          std::make_unique<PhysicalHand>(scene),
          EmulatedHandOptions(),
          [truth = truth_](const EmulatedFrame& frame) {
            const std::lock_guard lock(truth->mutex);
            truth->frames.push_back({frame.hostUs, frame.model.timeS(), frame.model.truth()});
          })) {}

DemoHand::~DemoHand() {
  if (session_) session_->stop();
}

void DemoHand::await(const std::string& what,
                     double limitS,
                     const std::function<bool()>& condition) {
  const auto end = SteadyClock::now() + milliseconds(static_cast<std::int64_t>(limitS * kMsPerS));
  while (!condition()) {
    if (!continue_()) throw Cancelled();
    if (SteadyClock::now() > end)
      throw Error(object_ + ": " + what + " did not happen within " + numberText(limitS) + " s");
    std::this_thread::sleep_for(kLook);
  }
}

void DemoHand::pause(double seconds) {
  const auto end = SteadyClock::now() + milliseconds(static_cast<std::int64_t>(seconds * kMsPerS));
  await("the end of a pause", seconds + 1.0, [end] { return SteadyClock::now() >= end; });
}

DeviceInfo DemoHand::connect() {
  LiveHandOptions options;
  options.dsaPort = hand_->dsaPort();
  options.sdhPort = hand_->sdhPort();
  session_ = std::make_unique<CaptureSession>(std::make_unique<LiveHand>(options));
  session_->start();
  const Device& device = session_->device();
  await("the first frame", 10.0, [&] {
    const DeviceStatus status = device.status();
    return status.tactile.items >= 5 && status.motion && status.motion->items >= 5;
  });
  return device.info();
}

void DemoHand::startRecording(const std::filesystem::path& file) {
  RecordingOptions options;
  options.path = file;
  options.meta = {{"object", object_}, {"operator", "palpate demo"}};
  session_->startRecording(options);
  await("a frame on disk", 5.0, [&] { return session_->recorderStatus().framesOnDisk > 0; });
}

void DemoHand::moveTo(double closeRatio, double velocityDegPerS) {
  constexpr double kBeginS = 0.2;  // until the axes report that they move
  constexpr double kPatienceS = 5.0;
  MoveJoints move;
  move.targetDeg =
      findPreshape(session_->device().hand().file->preshapes, preshape_).anglesDeg(closeRatio);
  move.velocityDegPerS.assign(move.targetDeg.size(), velocityDegPerS);
  Device& device = session_->device();
  const double durationS = device.submit(std::move(move)).get().durationS;
  pause(kBeginS);
  await("the end of the motion", durationS + kPatienceS, [&] {
    const std::vector<int> states = device.axisStates();
    return !states.empty() && std::none_of(states.begin(), states.end(), &isPositioning);
  });
}

DemoGrip DemoHand::grasp(double closingDegPerS) {
  moveTo(1.0, closingDegPerS);
  session_->mark("closed");
  pause(kHoldS);
  DemoGrip grip;
  hand_->withModel([&](HandModel& model) {
    int last = -1;
    const std::vector<MatrixTruth> truth = model.truth();
    for (std::size_t m = 0; m < truth.size(); ++m) {
      if (!truth[m].contact) continue;
      grip.forceN += truth[m].forceN;
      grip.fingers += std::exchange(last, model.hand().matrices[m].finger) != last ? 1 : 0;
    }
  });
  if (grip.fingers < 2) throw Error("the fingers missed the " + object_);
  moveTo(0.0, kOpeningDegPerS);
  return grip;
}

void DemoHand::playScript(double untilS) {
  constexpr double kPatienceS = 30.0;
  await("the end of the script", untilS + kPatienceS, [&] {
    return hand_->counts().handTimeS >= untilS;
  });
}

DemoRecorded DemoHand::finishRecording() {
  DemoRecorded recorded;
  recorded.report = session_->stopRecording();
  recorded.lostFrames = session_->health().lost;
  session_->stop();
  if (!recorded.report.complete) throw Error(object_ + ": " + recorded.report.message);
  return recorded;
}

std::vector<DemoTruthFrame> DemoHand::truth() const {
  const std::lock_guard lock(truth_->mutex);
  return truth_->frames;
}

std::string replayAndCompare(const Profile& profile) {
  ReplayComparison comparison(profile);
  ReplayOptions options;
  options.pace = ReplayPace::kManual;
  Replay replay(profile, options);
  replay.start(comparison);
  constexpr std::int64_t kStepUs = 1'000'000;
  while (!replay.finished()) replay.advance(kStepUs);
  replay.stop();
  return comparison.prediction();
}

}  // namespace palpate::commands
