// A recording as the hand behind the ports: each frame of it once, in order, at its own intervals;
// joint angles and temperatures of the same moments. Masks that a client sets are applied,
// thresholds and sensitivities only remembered: what was recorded has been through them. Time
// stands still while nobody streams (between two frames of a stream it goes on), and after the last
// frame.
#pragma once

#include <optional>
#include <vector>

#include <palpate/emulator/hand_model.h>
#include <palpate/model/profile.h>

namespace palpate {

class ReplayedHand final : public HandModel {
 public:
  // Values that are no counts are rounded, and held within 0..4095.
  explicit ReplayedHand(Profile profile);

  const HandDescription& hand() const override { return profile_.hand(); }
  void advanceTo(double timeS) override;
  double timeS() const override { return timeS_; }
  // Standing where the recording has them, within the range of the axes; motions have no effect on
  // it.
  JointMotion& joints() override { return joints_; }
  std::vector<MatrixSetting>& settings() override { return settings_; }
  void scan(std::span<std::uint16_t> counts) override;
  std::vector<double> temperatures() override;
  std::vector<MatrixTruth> truth() const override { return {}; }
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
  double scannedS_ = 0.0;  // when the last frame was scanned
  std::size_t nextFrame_ = 0;
  std::optional<std::size_t> angleSample_;
};

}  // namespace palpate
