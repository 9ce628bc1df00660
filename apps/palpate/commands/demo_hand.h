// One hand of `palpate demo`: emulated, on two ptys of its own, with a capture session on them as
// on a real hand, and a recording of what it felt.
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

// Whether the tour shall go on; asked in any thread by whoever waits.
using DemoContinue = std::function<bool()>;

// What the emulator says that the fingers held, at one moment.
struct DemoGrip {
  int fingers = 0;
  double forceN = 0.0;  // of all fingers together
};

struct DemoRecorded {
  RecordingReport report;
  std::uint64_t lostFrames = 0;  // that the controller sent and that never came whole
};

// Each step throws an Error when it fails, Cancelled when the tour shall not go on.
class DemoHand {
 public:
  // Switches the emulated hand on. `object`: what a person calls the thing it is to hold.
  DemoHand(const Scene& scene, std::string object, DemoContinue goOn);
  ~DemoHand();

  const std::string& object() const noexcept { return object_; }
  // Returns when frames and joint angles come.
  DeviceInfo connect();
  // Begins a recording; what came in the seconds before is in it.
  void startRecording(const std::filesystem::path& file);
  // Over its motion port: closes on the object, holds it, opens again. The scene must have no
  // script.
  DemoGrip grasp(double closingDegPerS);
  // Returns when the script has come so far [s since the hand was switched on].
  void playScript(double untilS);
  DemoRecorded finishRecording();
  // Of every frame that was scanned so far.
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

// Replays a profile as a device and compares every frame and sample; returns the figure.
std::string replayAndCompare(const Profile& profile);

}  // namespace palpate::commands
