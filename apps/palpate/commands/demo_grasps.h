// The live half of `palpate demo`: several emulated hands at once. Each grasps another thing, one
// lets a pen slip.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/emulator/scene.h"

#include "commands/demo_hand.h"
#include "commands/demo_recognition.h"

namespace palpate::commands {

// When the script of a scene pulls at what is held, since the hand was switched on [s].
struct PullTimes {
  double pullS = 0.0;     // the pull begins to grow
  double releaseS = 0.0;  // the fingers open
  double endS = 0.0;      // they are open
};
// Throws Error: the script doesn't pull and release.
PullTimes pullTimesOf(const Scene& scene);

// Grasps of the five things that data/emulated_objects.json was taught, and of a handle that it
// wasn't, by the fingers of six hands that are moved over their ports; a seventh plays the scene
// slipping_pen. The model was taught on grasps of the same things that were simulated without
// ports, each time differently placed; here each is placed as in none of them. Steps throw as
// DemoHand's; each returns its figure.
class DemoGrasps {
 public:
  // Throws FileError, FormatError: a scene that isn't there or is wrong. `folder`: where the
  // recordings go.
  DemoGrasps(const std::filesystem::path& scenes,
             const std::filesystem::path& folder,
             DemoContinue goOn);

  std::string emulate();
  std::string grasp();
  std::string finishRecordings();

  // What was held, and is to be named; and by how many fingers, as the emulator knows it.
  const std::vector<KnownGrasp>& held() const noexcept { return held_; }
  const std::vector<DemoGrip>& grips() const noexcept { return grips_; }
  // Of the pen that slips: its recording, its script, and what the emulator knew until the
  // recordings were finished.
  const std::filesystem::path& slipFile() const noexcept { return slipFile_; }
  const PullTimes& pullTimes() const noexcept { return pullTimes_; }
  const std::vector<DemoTruthFrame>& truth() const noexcept { return truth_; }

 private:
  void onEachHand(const std::function<void(std::size_t index)>& work) const;

  std::vector<Scene> scenes_;  // one per hand, that of the pen that slips last
  std::vector<double> closingDegPerS_;
  std::vector<KnownGrasp> held_;
  std::filesystem::path slipFile_;
  PullTimes pullTimes_;
  DemoContinue continue_;
  std::vector<std::unique_ptr<DemoHand>> hands_;
  std::vector<DemoGrip> grips_;
  std::vector<DemoTruthFrame> truth_;
};

}  // namespace palpate::commands
