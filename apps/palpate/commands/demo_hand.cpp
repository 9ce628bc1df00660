#include "commands/demo_hand.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "palpate/capture/replay.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/device/live_hand.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/model/preshape.h"

namespace palpate::commands {
namespace {

using std::chrono::milliseconds;
using SteadyClock = std::chrono::steady_clock;

constexpr int kPositioning = 1;  // axis state of the SDH-2
constexpr double kClosingDegPerS = 60.0;

// Compares what comes with what was recorded, as it comes.
class Comparison : public DeviceSink {
 public:
  explicit Comparison(const Profile& profile) : profile_(profile) {}

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

  std::string verdict() const {
    if (different_ > 0 || frames_ != profile_.numFrames() || angles_ != profile_.numAngles() ||
        temperatures_ != profile_.numTemperatures())
      throw Error("the replay differs from the recording in " + std::to_string(different_) +
                  " items");
    return std::to_string(frames_) + " frames and " + std::to_string(angles_) +
           " samples of the joint angles came again, bit by bit";
  }

 private:
  const Profile& profile_;
  TactileFrame expected_;
  std::size_t frames_ = 0, angles_ = 0, temperatures_ = 0, different_ = 0;
};

}  // namespace

DemoHand::DemoHand(const std::filesystem::path& scenesFolder) {
  Scene scene = loadScene("ball", scenesFolder);
  scene.script.clear();  // here the hand is moved over its port
  preshape_ = scene.preshape;
  hand_ = std::make_unique<EmulatedHand>(std::make_unique<PhysicalHand>(scene));
}

DemoHand::~DemoHand() {
  if (session_) session_->stop();
}

void DemoHand::await(const std::string& what,
                     double limitS,
                     const std::function<bool()>& condition) {
  const auto end = SteadyClock::now() + milliseconds(static_cast<std::int64_t>(limitS * 1000.0));
  while (!condition()) {
    if (SteadyClock::now() > end)
      throw Error(what + " did not happen within " + numberText(limitS) + " s");
    std::this_thread::sleep_for(milliseconds(10));
  }
}

std::string DemoHand::connect() {
  LiveHandOptions options;
  options.dsaPort = hand_->dsaPort();
  options.sdhPort = hand_->sdhPort();
  session_ = std::make_unique<CaptureSession>(std::make_unique<LiveHand>(options));
  session_->start();
  const Device& device = session_->device();
  await("the first frames", 10.0, [&] {
    const DeviceStatus status = device.status();
    return status.tactile.items >= 5 && status.motion && status.motion->items >= 5;
  });
  const DeviceFacts facts = device.facts();
  return "tactile controller " + facts.serial + " firmware " + facts.firmware +
         ", motion firmware " + facts.motionFirmware;
}

std::string DemoHand::startRecording(const std::filesystem::path& file) {
  RecordingOptions options;
  options.path = file;
  options.meta = {{"object", "ball"}, {"operator", "palpate demo"}};
  session_->startRecording(options);
  await("a frame on disk", 5.0, [&] { return session_->recorderStatus().framesOnDisk > 0; });
  return file.filename().string();
}

void DemoHand::moveTo(double closeRatio, double velocityDegPerS) {
  MoveJoints move;
  move.targetDeg = sdh2Preshape(preshape_).anglesDeg(closeRatio);
  move.velocityDegPerS.assign(move.targetDeg.size(), velocityDegPerS);
  Device& device = session_->device();
  const double durationS = device.submit(std::move(move)).get().durationS;
  std::this_thread::sleep_for(milliseconds(200));
  await("the end of the motion", durationS + 5.0, [&] {
    const std::vector<int> states = device.axisStates();
    return !states.empty() &&
           std::none_of(states.begin(), states.end(), [](int s) { return s == kPositioning; });
  });
}

std::string DemoHand::grasp() {
  moveTo(1.0, kClosingDegPerS);
  session_->mark("closed");
  std::this_thread::sleep_for(milliseconds(1000));
  double forceN = 0.0;
  int fingers = 0;
  hand_->withModel([&](HandModel& model) {
    int last = -1;
    const std::vector<MatrixTruth> truth = model.truth();
    for (std::size_t m = 0; m < truth.size(); ++m) {
      if (!truth[m].contact) continue;
      forceN += truth[m].forceN;
      fingers += std::exchange(last, model.hand().matrices[m].finger) != last ? 1 : 0;
    }
  });
  if (fingers < 2) throw Error("the fingers missed the ball");
  moveTo(0.0, kClosingDegPerS);
  return std::to_string(fingers) + " fingers pressed the ball with " + fixedText(forceN, 1) +
         " N altogether";
}

std::string DemoHand::finishRecording() {
  const RecordingReport report = session_->stopRecording();
  const LinkHealth health = session_->health();
  session_->stop();
  if (!report.complete) throw Error(report.message);
  return std::to_string(report.frames) + " frames at " + fixedText(report.meanRateHz, 1) + " Hz, " +
         std::to_string(report.angles) + " samples of the joint angles, " +
         std::to_string(health.lost) + " lost";
}

std::string replayAndCompare(const Profile& profile) {
  Comparison comparison(profile);
  ReplayOptions options;
  options.pace = ReplayPace::kByHand;
  Replay replay(profile, options);
  replay.start(comparison);
  constexpr std::int64_t kStepUs = 1'000'000;
  while (!replay.finished()) replay.advance(kStepUs);
  replay.stop();
  return comparison.verdict();
}

}  // namespace palpate::commands
