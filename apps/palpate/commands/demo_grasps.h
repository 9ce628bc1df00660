// The live part of `palpate demo`: several emulated hands run at once. Each grasps a different
// object; one lets a pen slip.
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

// When the script of a scene pulls at the held object, in seconds since the hand was switched on.
struct PullTimes {
  // The pull begins to increase [s].
  double pullS = 0.0;
  // The fingers begin to open [s].
  double releaseS = 0.0;
  // The fingers are open [s].
  double endS = 0.0;
};
// Throws Error when the script does not pull and release.
PullTimes pullTimesOf(const Scene& scene);

// Six hands, moved over their ports, grasp the five objects that the model
// data/emulated_objects.json was trained with, and a handle that is not in its training data; a
// seventh hand runs the scene slipping_pen. The training grasps of the same objects were simulated
// without ports, each with a different placement; the placements here are not among them. The steps
// throw as those of DemoHand do; each returns a text with its result.
class DemoGrasps {
 public:
  // Throws FileError or FormatError when a scene is missing or invalid. The recordings are written
  // to `folder`.
  DemoGrasps(const std::filesystem::path& scenes,
             const std::filesystem::path& folder,
             DemoContinue goOn);

  std::string emulate();
  std::string grasp();
  std::string finishRecordings();

  // The held objects, which recognition has to name; and the grip on each, as the emulator knows
  // it.
  const std::vector<KnownGrasp>& held() const noexcept { return held_; }
  const std::vector<DemoGrip>& grips() const noexcept { return grips_; }
  // About the slipping pen: its recording, the times of its script, and the emulator's true values
  // up to finishRecordings().
  const std::filesystem::path& slipFile() const noexcept { return slipFile_; }
  const PullTimes& pullTimes() const noexcept { return pullTimes_; }
  const std::vector<DemoTruthFrame>& truth() const noexcept { return truth_; }

 private:
  void onEachHand(const std::function<void(std::size_t index)>& work) const;

  // One scene for each hand; the scene of the slipping pen is the last.
  std::vector<Scene> scenes_;
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
