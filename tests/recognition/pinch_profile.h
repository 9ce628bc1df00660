// Makes profiles of grasps between fingers 0 and 2 for tests, with numbers that can be checked by
// hand.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"

namespace palpate::testing {

// Joint angles for a gap between fingers 0 and 2, which face each other at phi0 = 90 deg. With the
// proximal joint at b and the distal one at -b the fingertips stay upright, and by trigonometry the
// distance of their flat parts is
//   66 - 2 * 86.5 sin b - 2 * 14.8 mm.
inline std::vector<double> anglesForGap(double gapMm) {
  const double b = std::asin((66.0 - 29.6 - gapMm) / 173.0) * 180.0 / std::numbers::pi;
  return {90, b, -b, -90, 0, b, -b};
}

struct PinchStep {
  double gapMm = 50.0;
  // Counts of taxel (2, 10) of matrix 1 and (3, 10) of matrix 5, which are opposite each other.
  float first = 0.0F, second = 0.0F;
  // More taxels of the first pad: column, row, counts; those of the second pad are opposite.
  std::vector<std::tuple<int, int, float>> more = {};
};

constexpr std::int64_t kPinchStartUs = 1'400'000'000'000'000;
constexpr std::int64_t kPinchPeriodUs = 32'000;

// Makes a profile with one frame and one sample of joint angles per step.
inline Profile pinchProfile(const std::vector<PinchStep>& steps, bool withAngles = true) {
  ProfileBuilder builder(sdh2().layout);
  std::int64_t nowUs = kPinchStartUs;
  for (const PinchStep& step : steps) {
    TactileFrame frame(sdh2().layout);
    for (const auto& [x, y, counts] : step.more)
      frame.matrix(1)(y, x) = frame.matrix(5)(y, 5 - x) = counts;
    frame.matrix(1)(10, 2) = step.first;
    frame.matrix(5)(10, 3) = step.second;
    builder.addFrame(nowUs, frame.values);
    if (withAngles) builder.addAngles(nowUs, anglesForGap(step.gapMm));
    nowUs += kPinchPeriodUs;
  }
  return builder.finish({});
}

// A profile of a sensor with a single pad whose taxels all touch.
inline Profile otherSensorProfile(int frames) {
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(8, 8, 2.0)});
  ProfileBuilder builder(layout);
  for (int i = 0; i < frames; ++i)
    builder.addFrame(kPinchStartUs + i * kPinchPeriodUs, std::vector<float>(64, 100.0F));
  return builder.finish({});
}

// A copy of a profile with one taxel value and one joint angle that are not numbers.
class DamagedStorage : public ProfileStorage {
 public:
  DamagedStorage(Profile whole, int badFrame, int badAngles)
      : whole_(std::move(whole)), badFrame_(badFrame), badAngles_(badAngles) {}
  std::size_t numFrames() const override { return whole_.numFrames(); }
  std::int64_t frameTimeUs(std::size_t frame) const override { return whole_.frameTimeUs(frame); }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    whole_.readFrame(frame, out);
    if (static_cast<int>(frame) == badFrame_)
      out.matrix(1)(9, 2) = std::numeric_limits<float>::quiet_NaN();
  }
  std::size_t numSamples(std::size_t series) const override {
    return series == kAngleSeries ? whole_.numAngles() : 0;
  }
  std::int64_t sampleTimeUs(std::size_t, std::size_t i) const override {
    return whole_.angleTimeUs(i);
  }
  Sample sample(std::size_t, std::size_t i) const override {
    Sample angles = whole_.angles(i);
    if (static_cast<int>(i) == badAngles_) angles.values[2] = std::nan("");
    return angles;
  }

 private:
  Profile whole_;
  int badFrame_, badAngles_;
};

// A badFrame or badAngles of -1 means none.
inline Profile damagedProfile(const Profile& whole, int badFrame, int badAngles) {
  return Profile(
      whole.info(), whole.hand(), std::make_shared<DamagedStorage>(whole, badFrame, badAngles));
}

}  // namespace palpate::testing
