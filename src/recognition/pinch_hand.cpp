#include "palpate/recognition/pinch_hand.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {

bool sameSensor(const SensorLayout& a, const SensorLayout& b) {
  if (a.numMatrices() != b.numMatrices()) return false;
  for (std::size_t m = 0; m < a.numMatrices(); ++m)
    if (a.matrix(m).rows != b.matrix(m).rows || a.matrix(m).columns != b.matrix(m).columns ||
        std::abs(a.matrix(m).pitchMm - b.matrix(m).pitchMm) > 1e-3)
      return false;
  return true;
}

PinchHand makeSdh2() {
  PinchHand hand;
  hand.pads = {1, 5};
  hand.otherPads = {{1, 3}, {5, 3}};
  hand.secondPadGain = 2.7;
  hand.fullScaleCounts = 4096.0;
  hand.imageSize = 14;
  hand.largestCounts = {3554.0, 2493.0};
  hand.studyGeometry = std::make_shared<const HandGeometry>(sdh2Geometry());
  hand.effectiveGeometry =
      std::make_shared<const HandGeometry>(sdh2Geometry(kEffectiveFingertipRadiusMm));
  hand.gripAxes = {1, 2, 5, 6};
  return hand;
}

}  // namespace

std::string PinchHand::mismatch(const Profile& profile) const {
  const GeometryDescription& mine = effectiveGeometry->description();
  if (!sameSensor(profile.layout(), mine.layout))
    return "a recording of another sensor: its matrices are not those of the hand";
  if (profile.numAngles() > 0 && profile.angles(0).deg.size() != mine.numAxes)
    return "a recording of another hand: " + std::to_string(profile.angles(0).deg.size()) +
           " joint angles instead of " + std::to_string(mine.numAxes);
  return {};
}

void PinchHand::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("PinchHand: ") + what);
  };
  require(studyGeometry && effectiveGeometry, "a geometry is missing");
  const GeometryDescription& mine = effectiveGeometry->description();
  require(studyGeometry->description().layout.numMatrices() == mine.layout.numMatrices() &&
              studyGeometry->description().numAxes == mine.numAxes,
          "the two geometries are of different hands");
  require(pads[0] != pads[1], "pads must be two");
  for (const std::size_t pad : pads) {
    require(pad < mine.layout.numMatrices(), "there is no such pad");
    require(
        mine.layout.matrix(pad).rows <= imageSize && mine.layout.matrix(pad).columns <= imageSize,
        "imageSize is smaller than a pad");
  }
  for (const auto& [first, second] : otherPads)
    require(first != second && std::max(first, second) < mine.layout.numMatrices(),
            "otherPads must be pairs of pads");
  require(secondPadGain > 0.0 && std::isfinite(secondPadGain), "secondPadGain must be > 0");
  require(fullScaleCounts > 0.0 && std::isfinite(fullScaleCounts), "fullScaleCounts must be > 0");
  for (const double largest : largestCounts)
    require(largest > 0.0 && std::isfinite(largest), "largestCounts must be > 0");
  for (const std::size_t axis : gripAxes) require(axis < mine.numAxes, "there is no such axis");
}

const PinchHand& sdh2PinchHand() {
  static const PinchHand hand = makeSdh2();
  return hand;
}

}  // namespace palpate
