#include "commands/demo_grasps.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <variant>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/parallel.h"
#include "palpate/emulator/simulated_recording.h"

namespace palpate::commands {
namespace {

// A scene of data/scenes, and the common name of the object in it.
struct HeldThing {
  const char* scene;
  const char* object;
  const char* recording;
};
constexpr std::array<HeldThing, 6> kHeldThings = {{{"ball", "ball", "grasp"},
                                                   {"bottle", "bottle", "bottle"},
                                                   {"box", "box", "box"},
                                                   {"foam_ball", "foam ball", "foam_ball"},
                                                   {"pen", "pen", "pen"},
                                                   {"slipping_handle", "handle", "handle"}}};
constexpr const char* kSlipScene = "slipping_pen";
// Seed of the object placements; scripts/make_emulated_model uses other seeds.
constexpr std::uint64_t kFirstPlacement = 900;
constexpr double kOpenS = 1.2;

template <class Action>
const ScriptStep* stepOf(const Scene& scene) {
  const auto step = std::find_if(scene.script.begin(), scene.script.end(), [](const auto& each) {
    return std::holds_alternative<Action>(each.action);
  });
  return step == scene.script.end() ? nullptr : &*step;
}

// The closing velocity in the scene's own script [deg/s].
double closingOf(const Scene& scene) {
  const ScriptStep* step = stepOf<GraspAction>(scene);
  return step ? std::get<GraspAction>(step->action).velocityDegPerS : GraspAction().velocityDegPerS;
}

}  // namespace

PullTimes pullTimesOf(const Scene& scene) {
  const ScriptStep* pull = stepOf<LoadObject>(scene);
  const ScriptStep* release = stepOf<ReleaseAction>(scene);
  if (!pull || !release || release->atS <= pull->atS)
    throw Error("the scene " + scene.name + " does not pull at the held object and release it");
  return {pull->atS, release->atS, release->atS + kOpenS};
}

DemoGrasps::DemoGrasps(const std::filesystem::path& scenes,
                       const std::filesystem::path& folder,
                       DemoContinue goOn)
    : slipFile_(folder / "slip.palpate"), continue_(std::move(goOn)) {
  std::uint64_t placement = kFirstPlacement;
  for (const HeldThing& thing : kHeldThings) {
    Scene scene = variedScene(loadScene(thing.scene, scenes), {}, placement++);
    closingDegPerS_.push_back(closingOf(scene));
    // This hand is moved over its port instead.
    scene.script.clear();
    scenes_.push_back(std::move(scene));
    held_.push_back({folder / (std::string(thing.recording) + ".palpate"), thing.object});
  }
  grips_.resize(held_.size());
  scenes_.push_back(loadScene(kSlipScene, scenes));
  pullTimes_ = pullTimesOf(scenes_.back());
}

void DemoGrasps::onEachHand(const std::function<void(std::size_t index)>& work) const {
  forEachInParallel(scenes_.size(), work, {}, scenes_.size());
}

std::string DemoGrasps::emulate() {
  for (std::size_t i = 0; i < scenes_.size(); ++i)
    hands_.push_back(std::make_unique<DemoHand>(
        scenes_[i], i < held_.size() ? held_[i].object : "pen that slips", continue_));
  std::vector<DeviceInfo> facts(hands_.size());
  onEachHand([&](std::size_t i) {
    facts[i] = hands_[i]->connect();
    hands_[i]->startRecording(i < held_.size() ? held_[i].file : slipFile_);
  });
  return std::to_string(hands_.size()) + " hands answer on " + std::to_string(2 * hands_.size()) +
         " ports, tactile firmware " + facts.front().firmware + ", motion firmware " +
         facts.front().motionFirmware;
}

std::string DemoGrasps::grasp() {
  onEachHand([&](std::size_t i) {
    if (i < grips_.size())
      grips_[i] = hands_[i]->grasp(closingDegPerS_[i]);
    else
      hands_[i]->playScript(pullTimes_.endS);
  });
  std::string text = std::to_string(grips_.size()) + " objects held:";
  for (std::size_t i = 0; i < grips_.size(); ++i)
    text += (i == 0 ? " " : ", ") + held_[i].object + " " + fixedText(grips_[i].forceN, 0) + " N";
  return text + "; another pen was pulled at";
}

std::string DemoGrasps::finishRecordings() {
  std::vector<DemoRecorded> recorded(hands_.size());
  onEachHand([&](std::size_t i) { recorded[i] = hands_[i]->finishRecording(); });
  truth_ = hands_.back()->truth();
  std::int64_t frames = 0, angles = 0;
  std::uint64_t lost = 0;
  double leastHz = recorded.front().report.meanRateHz, mostHz = leastHz;
  for (const DemoRecorded& each : recorded) {
    frames += each.report.frames;
    angles += each.report.angles;
    lost += each.lostFrames;
    leastHz = std::min(leastHz, each.report.meanRateHz);
    mostHz = std::max(mostHz, each.report.meanRateHz);
  }
  const std::string least = fixedText(leastHz, 1), most = fixedText(mostHz, 1);
  return std::to_string(recorded.size()) + " recordings, " + std::to_string(frames) +
         " frames at " + (least == most ? least : least + " to " + most) + " Hz, " +
         std::to_string(angles) + " samples of the joint angles, " + std::to_string(lost) +
         " frames lost";
}

}  // namespace palpate::commands
