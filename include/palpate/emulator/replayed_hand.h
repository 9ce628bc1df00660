// Replays a recording through the emulated ports: each frame once, in order, at the recorded
// intervals, with the joint angles and temperatures of the same time. Masks set by a client are
// applied. Thresholds and sensitivities are only stored, because the recorded frames already
// contain their effect. Time stops while no client streams (it continues between two frames of a
// stream) and after the last frame.
#pragma once

#include <optional>
#include <vector>

#include <palpate/emulator/hand_model.h>
#include <palpate/model/profile.h>

namespace palpate {

class ReplayedHand final : public HandModel {
 public:
  // Values that are no counts are rounded and clamped to 0..4095.
  explicit ReplayedHand(Profile profile);

  const HandDescription& hand() const override { return profile_.hand(); }
  void advanceTo(double timeS) override;
  double timeS() const override { return timeS_; }
  // The joints have the recorded angles, within the range of the axes; commanded motions have no
  // effect on them.
  JointMotion& joints() override { return joints_; }
  std::vector<MatrixSetting>& settings() override { return settings_; }
  void scan(std::span<std::uint16_t> counts) override;
  std::vector<double> temperatures() override;
  std::vector<MatrixTruth> truth() const override { return {}; }
  std::optional<std::uint32_t> serial() const override;
  bool finished() const override { return nextFrame_ >= profile_.numFrames(); }
  std::optional<double> nextIntervalS() const override;

  std::size_t nextFrame() const noexcept { return nextFrame_; }

 private:
  std::int64_t recordingTimeUs() const;
  void placeJoints();

  Profile profile_;
  JointMotion joints_;
  std::vector<MatrixSetting> settings_;
  TactileFrame frame_;
  double timeS_ = 0.0;
  double scannedS_ = 0.0;  // time of the last scan
  std::size_t nextFrame_ = 0;
  std::optional<std::size_t> angleSample_;
};

}  // namespace palpate
