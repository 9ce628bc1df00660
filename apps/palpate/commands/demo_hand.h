// One hand of `palpate demo`: an emulated hand on two ptys, with a capture session that treats it
// as a real hand and records it.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "palpate/capture/capture_session.h"
#include "palpate/core/json.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/scene.h"
#include "palpate/model/profile.h"

#include "commands/demo_truth.h"

namespace palpate::commands {

// Whether the tour continues; called from any thread that waits.
using DemoContinue = std::function<bool()>;

// Every step throws Error when it fails, and Cancelled when the tour does not continue.
class DemoHand {
 public:
  // Switches the emulated hand on. `object`: the common name of the object that it will hold.
  DemoHand(const Scene& scene, std::string object, DemoContinue goOn);

  // Connects and starts a recording; returns when frames are on disk.
  DeviceInfo record(const std::filesystem::path& file);
  // Closes on the object, holds it, and opens again, by commands over the motion port. The scene
  // must not have a script. Returns object, fingers and force_n [N, sum over the fingers] of the
  // grip, as the emulator knows it.
  Json grasp(double closingDegPerS);
  // Returns when the script has reached that time [s since the hand was switched on].
  void playScript(double untilS);
  RecordingReport finishRecording();
  // The true values of every frame scanned so far.
  std::vector<DemoTruthFrame> truth() const;

 private:
  void moveTo(double closeRatio, double velocityDegPerS);
  void pause(double seconds);
  void await(const std::string& what, double limitS, const std::function<bool()>& condition);

  const std::string object_;
  const std::string preshape_;
  const DemoContinue continue_;
  mutable std::mutex truthMutex_;
  std::vector<DemoTruthFrame> truth_;
  // In this order: its thread writes the truth, and the session uses its ports.
  EmulatedHand hand_;
  CaptureSession session_;
};

// Replays a profile as a device and compares every frame and sample; returns a text with the
// result. Throws Error when something differs.
std::string replayAndCompare(const Profile& profile);

}  // namespace palpate::commands
