// One hand of `palpate demo`: an emulated hand on two ptys, with a capture session that treats it
// as a real hand and records it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "palpate/capture/capture_session.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/scene.h"
#include "palpate/model/profile.h"

#include "commands/demo_truth.h"

namespace palpate::commands {

// Whether the demo continues; called from any thread that waits.
using DemoContinue = std::function<bool()>;

// How the fingers hold the object at one moment, as the emulator knows it.
struct DemoGrip {
  int fingers = 0;
  // [N] sum over all fingers
  double forceN = 0.0;
};

// The result of a finished recording.
struct DemoRecorded {
  RecordingReport report;
  // Frames that the controller sent and that did not arrive completely.
  std::uint64_t lostFrames = 0;
};

// Every step throws Error when it fails, and Cancelled when the demo does not continue.
class DemoHand {
 public:
  // Switches the emulated hand on. `object`: the common name of the object that it will hold.
  DemoHand(const Scene& scene, std::string object, DemoContinue goOn);
  ~DemoHand();

  const std::string& object() const noexcept { return object_; }
  // Returns when frames and joint angles arrive.
  DeviceInfo connect();
  // Starts a recording, which includes the seconds before the start.
  void startRecording(const std::filesystem::path& file);
  // Closes on the object, holds it, and opens again, by commands over the motion port. The scene
  // must not have a script.
  DemoGrip grasp(double closingDegPerS);
  // Returns when the script has reached that time [s since the hand was switched on].
  void playScript(double untilS);
  DemoRecorded finishRecording();
  // The true values of every frame scanned so far.
  std::vector<DemoTruthFrame> truth() const;

 private:
  void moveTo(double closeRatio, double velocityDegPerS);
  void pause(double seconds);
  void await(const std::string& what, double limitS, const std::function<bool()>& condition);

  struct Truth {
    std::mutex mutex;
    std::vector<DemoTruthFrame> frames;
  };

  const std::string object_;
  const std::string preshape_;
  const DemoContinue continue_;
  const std::shared_ptr<Truth> truth_;
  std::unique_ptr<EmulatedHand> hand_;
  std::unique_ptr<CaptureSession> session_;
};

// Replays a profile as a device and compares every frame and sample; returns a text with the
// result.
std::string replayAndCompare(const Profile& profile);

}  // namespace palpate::commands
