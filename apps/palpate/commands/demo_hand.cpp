#include "commands/demo_hand.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "palpate/capture/replay.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/device/live_hand.h"
#include "palpate/emulator/joint_motion.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/preshape.h"

namespace palpate::commands {
namespace {

using Seconds = std::chrono::duration<double>;
using SteadyClock = std::chrono::steady_clock;

constexpr double kHoldS = 1.2;
constexpr double kOpeningDegPerS = 60.0;
constexpr std::chrono::milliseconds kLook{10};

std::unique_ptr<Device> deviceOn(const EmulatedHand& hand) {
  LiveHandOptions options;
  options.dsaPort = hand.dsaPort();
  options.sdhPort = hand.sdhPort();
  return std::make_unique<LiveHand>(std::move(options));
}

// Compares the replayed data with the recorded data while it arrives.
struct ReplayComparison : DeviceSink {
  explicit ReplayComparison(const Profile& recorded) : profile(recorded) {}

  void onFrame(TactileFrame&& frame) override {
    const std::size_t i = frames++;
    same = same && i < profile.numFrames() && profile.frame(i).values == frame.values &&
           profile.frameTimeUs(i) == frame.hostUs;
  }
  void onSample(Sample&& sample) override {
    const std::size_t i = (sample.series == kAngleSeries ? angles : temperatures)++;
    same = same && i < profile.numSamples(sample.series) &&
           profile.sample(sample.series, i).values == sample.values &&
           profile.sample(sample.series, i).hostUs == sample.hostUs;
  }
  void onEvent(Event&&) override {}

  const Profile& profile;
  std::size_t frames = 0, angles = 0, temperatures = 0;
  bool same = true;
};

}  // namespace

DemoHand::DemoHand(const Scene& scene, std::string object, DemoContinue goOn)
    : object_(std::move(object)),
      preshape_(scene.preshape),
      continue_(std::move(goOn)),
      hand_(std::make_unique<PhysicalHand>(scene),
            EmulatedHandOptions(),
            [this](const EmulatedFrame& frame) {
              const std::lock_guard lock(truthMutex_);
              truth_.push_back({frame.hostUs, frame.model.timeS(), frame.model.truth()});
            }),
      session_(deviceOn(hand_)) {}

void DemoHand::await(const std::string& what,
                     double limitS,
                     const std::function<bool()>& condition) {
  const auto end = SteadyClock::now() + Seconds(limitS);
  while (!condition()) {
    if (!continue_()) throw Cancelled();
    if (SteadyClock::now() > end)
      throw Error(object_ + ": " + what + " did not happen within " + numberText(limitS) + " s");
    std::this_thread::sleep_for(kLook);
  }
}

void DemoHand::pause(double seconds) {
  const auto end = SteadyClock::now() + Seconds(seconds);
  await("the end of a pause", seconds + 1.0, [end] { return SteadyClock::now() >= end; });
}

DeviceInfo DemoHand::record(const std::filesystem::path& file) {
  session_.start();
  await("the first frame", 10.0, [&] {
    const DeviceStatus status = session_.device().status();
    return status.tactile.items >= 5 && status.motion && status.motion->items >= 5;
  });
  RecordingOptions options;
  options.path = file;
  options.meta = {{"object", object_}, {"operator", "palpate demo"}};
  session_.startRecording(options);
  await("a frame on disk", 5.0, [&] { return session_.recorderStatus().framesOnDisk > 0; });
  return session_.device().info();
}

void DemoHand::moveTo(double closeRatio, double velocityDegPerS) {
  constexpr double kBeginS = 0.2;  // until the axes report that they move
  constexpr double kPatienceS = 5.0;
  MoveJoints move;
  move.targetDeg =
      findPreshape(session_.device().hand().file->preshapes, preshape_).anglesDeg(closeRatio);
  move.velocityDegPerS.assign(move.targetDeg.size(), velocityDegPerS);
  Device& device = session_.device();
  const double durationS = device.submit(std::move(move)).get().durationS;
  pause(kBeginS);
  await("the end of the motion", durationS + kPatienceS, [&] {
    const std::vector<int> states = device.axisStates();
    return !states.empty() &&
           !std::ranges::count(states, static_cast<int>(AxisState::kPositioning));
  });
}

Json DemoHand::grasp(double closingDegPerS) {
  moveTo(1.0, closingDegPerS);
  session_.mark("closed");
  pause(kHoldS);
  int fingers = 0, last = -1;
  double forceN = 0.0;
  hand_.withModel([&](HandModel& model) {
    const std::vector<MatrixTruth> truth = model.truth();
    for (std::size_t m = 0; m < truth.size(); ++m) {
      if (!truth[m].contact) continue;
      forceN += truth[m].forceN;
      fingers += std::exchange(last, model.hand().matrices[m].finger) != last ? 1 : 0;
    }
  });
  if (fingers < 2) throw Error("the fingers missed the " + object_);
  moveTo(0.0, kOpeningDegPerS);
  return Json::object().set("object", object_).set("fingers", fingers).set("force_n", forceN);
}

void DemoHand::playScript(double untilS) {
  await("the end of the script", untilS + 30.0, [&] { return hand_.counts().handTimeS >= untilS; });
}

RecordingReport DemoHand::finishRecording() {
  RecordingReport report = session_.stopRecording();
  session_.stop();
  if (!report.complete) throw Error(object_ + ": " + report.message);
  return report;
}

std::vector<DemoTruthFrame> DemoHand::truth() const {
  const std::lock_guard lock(truthMutex_);
  return truth_;
}

std::string replayAndCompare(const Profile& profile) {
  ReplayComparison replayed(profile);
  ReplayOptions options;
  options.pace = ReplayPace::kManual;
  Replay replay(profile, options);
  replay.start(replayed);
  constexpr std::int64_t kStepUs = 1'000'000;
  while (!replay.finished()) replay.advance(kStepUs);
  replay.stop();
  if (!replayed.same || replayed.frames != profile.numFrames() ||
      replayed.angles != profile.numAngles() || replayed.temperatures != profile.numTemperatures())
    throw Error("the replay differs from the recording");
  return std::to_string(replayed.frames) + " frames and " + std::to_string(replayed.angles) +
         " samples of the joint angles are identical in the replay";
}

}  // namespace palpate::commands
