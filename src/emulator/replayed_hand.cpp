#include "palpate/emulator/replayed_hand.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace palpate {
namespace {

constexpr int kProximalThreshold = 150;
constexpr int kDistalThreshold = 300;

// Angles of the recording, clamped to the range of the axes.
std::vector<double> withinRange(const std::vector<AxisDescription>& axes,
                                const std::vector<double>& deg) {
  std::vector<double> angles(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double wanted = i < deg.size() && std::isfinite(deg[i]) ? deg[i] : 0.0;
    angles[i] = std::clamp(wanted, axes[i].minimumDeg, axes[i].maximumDeg);
  }
  return angles;
}

std::vector<double> firstAngles(const Profile& profile) {
  return withinRange(profile.hand().axes,
                     profile.numAngles() > 0 ? profile.angles(0).values : std::vector<double>());
}

}  // namespace

ReplayedHand::ReplayedHand(Profile profile)
    : profile_(std::move(profile)), joints_(profile_.hand(), firstAngles(profile_)) {
  const HandDescription& description = profile_.hand();
  for (std::size_t m = 0; m < description.layout->numMatrices(); ++m) {
    MatrixSetting setting;
    setting.thresholdCounts = setting.factoryThresholdCounts =
        description.matrices.at(m).segment == "distal" ? kDistalThreshold : kProximalThreshold;
    setting.dynamicMask.assign(description.layout->matrix(m).numCells(), 1);
    settings_.push_back(std::move(setting));
  }
}

std::optional<std::uint32_t> ReplayedHand::serial() const {
  const std::string& text = profile_.info().serial;
  std::uint32_t number = 0;
  const char* end = text.data() + text.size();
  constexpr int kHexadecimal = 16;
  const auto [at, problem] = std::from_chars(text.data(), end, number, kHexadecimal);
  // A .dsa of a hand whose number is not known has zeros.
  if (problem != std::errc() || at != end || number == 0) return std::nullopt;
  return number;
}

void ReplayedHand::advanceTo(double timeS) {
  if (timeS <= timeS_) return;
  timeS_ = timeS;
  placeJoints();
}

// Time of the last frame plus the time since then, but not beyond the next frame.
std::int64_t ReplayedHand::recordingTimeUs() const {
  if (profile_.numFrames() == 0) return 0;
  if (nextFrame_ == 0) return profile_.frameTimeUs(0);
  const std::int64_t lastUs = profile_.frameTimeUs(nextFrame_ - 1);
  const auto passedUs = static_cast<std::int64_t>((timeS_ - scannedS_) * 1e6);
  return finished() ? lastUs : std::min(lastUs + passedUs, profile_.frameTimeUs(nextFrame_));
}

void ReplayedHand::placeJoints() {
  const auto sample = profile_.angleSampleAt(recordingTimeUs());
  if (!sample || sample == angleSample_) return;
  angleSample_ = sample;
  // A JointMotion can't be moved directly: creates a new one at the recorded angles with the
  // settings of the client.
  JointMotion moved(hand(), withinRange(hand().axes, profile_.angles(*sample).values));
  moved.setController(joints_.controller());
  moved.setProfile(joints_.profile());
  moved.setPower(joints_.power());
  moved.setAccelerations(joints_.accelerations());
  if (joints_.controller() == ControllerType::kPose) {
    moved.setTargets(joints_.targets());
    moved.setVelocities(joints_.targetVelocities());
  }
  joints_ = std::move(moved);
}

void ReplayedHand::scan(std::span<std::uint16_t> counts) {
  std::fill(counts.begin(), counts.end(), std::uint16_t{0});
  if (finished()) return;
  profile_.readFrame(nextFrame_, frame_);
  const SensorLayout& layout = profile_.layout();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const std::size_t first = layout.offset(m);
    const Mask& mask = settings_[m].dynamicMask;
    for (std::size_t i = 0; i < layout.matrix(m).numCells(); ++i) {
      if (first + i >= counts.size() || mask[i] == 0) continue;
      const float value = std::clamp(frame_.values[first + i], 0.0F, 4095.0F);
      counts[first + i] = static_cast<std::uint16_t>(std::lround(value));
    }
  }
  ++nextFrame_;
  scannedS_ = timeS_;
  placeJoints();
}

std::vector<double> ReplayedHand::temperatures() {
  std::vector<double> degC;
  if (const auto sample = profile_.temperatureSampleAt(recordingTimeUs()))
    degC = profile_.temperatures(*sample).values;
  degC.resize(hand().temperatureSensors.size());
  return degC;
}

std::optional<double> ReplayedHand::nextIntervalS() const {
  if (finished()) return std::nullopt;
  if (nextFrame_ == 0) return 0.0;
  const std::int64_t intervalUs =
      profile_.frameTimeUs(nextFrame_) - profile_.frameTimeUs(nextFrame_ - 1);
  return static_cast<double>(intervalUs) * 1e-6;
}

}  // namespace palpate
