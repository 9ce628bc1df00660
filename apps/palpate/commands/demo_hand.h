// The live half of `palpate demo`: an emulated hand on two ptys, a capture session on them, a grasp.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "palpate/capture/capture_session.h"
#include "palpate/emulator/emulated_hand.h"
#include "palpate/model/profile.h"

namespace palpate::commands {

// Each step returns its figure, and throws an Error when it fails.
class DemoHand {
 public:
  // Starts the emulated hand on a scene without its script.
  explicit DemoHand(const std::filesystem::path& scenesFolder);
  ~DemoHand();

  std::string connect();
  // Begins a recording; what came in the seconds before is in it.
  std::string startRecording(const std::filesystem::path& file);
  // Closes on the object, holds it, opens again.
  std::string grasp();
  std::string finishRecording();

 private:
  void moveTo(double closeRatio, double velocityDegPerS);
  void await(const std::string& what, double limitS, const std::function<bool()>& condition);

  std::unique_ptr<EmulatedHand> hand_;
  std::unique_ptr<CaptureSession> session_;
  std::string preshape_;
};

// Replays a profile as a device and compares every frame and sample; returns the figure.
std::string replayAndCompare(const Profile& profile);

}  // namespace palpate::commands
