#include "palpate/recognition/pinch_hand.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "palpate/core/escaped_line.h"
#include "palpate/model/hand_file.h"

namespace palpate {
namespace {

bool sameSensor(const SensorLayout& a, const SensorLayout& b) {
  if (a.numMatrices() != b.numMatrices()) return false;
  for (std::size_t m = 0; m < a.numMatrices(); ++m)
    if (a.matrix(m).rows != b.matrix(m).rows || a.matrix(m).columns != b.matrix(m).columns ||
        std::abs(a.matrix(m).pitchMm.x - b.matrix(m).pitchMm.x) > 1e-3 ||
        std::abs(a.matrix(m).pitchMm.y - b.matrix(m).pitchMm.y) > 1e-3)
      return false;
  return true;
}

std::shared_ptr<const PinchHand> madePinchHand(const HandDescription& hand) {
  const PinchDescription& pinch = *hand.file->pinch;
  auto made = std::make_shared<PinchHand>();
  made->pads = pinch.pads;
  made->otherPads = pinch.otherPads;
  made->secondPadGain = pinch.secondPadGain;
  made->fullScaleCounts = pinch.fullScaleCounts;
  made->imageSize = pinch.imageSize;
  made->largestCounts = pinch.largestCounts;
  made->gripAxes = pinch.gripAxes;
  made->studyGeometry =
      std::make_shared<const HandGeometry>(describeGeometry(hand, BendRadius::kNominal));
  made->effectiveGeometry =
      std::make_shared<const HandGeometry>(describeGeometry(hand, BendRadius::kEffective));
  made->validate();
  return made;
}

bool samePitches(const SensorLayout& a, const SensorLayout& b) {
  for (std::size_t m = 0; m < a.numMatrices(); ++m)
    if (a.matrix(m).pitchMm != b.matrix(m).pitchMm) return false;
  return true;
}

// Hands that were made lately.
class PinchHands {
 public:
  std::shared_ptr<const PinchHand> of(const HandDescription& hand) {
    const std::lock_guard lock(mutex_);
    for (const Kept& each : kept_)
      if (isSame(each.of, hand)) return each.made;
    std::shared_ptr<const PinchHand> made = madePinchHand(hand);
    if (kept_.size() >= kMaxKept) kept_.erase(kept_.begin());
    kept_.push_back({hand, made});
    return made;
  }

 private:
  struct Kept {
    HandDescription of;
    std::shared_ptr<const PinchHand> made;
  };
  static constexpr std::size_t kMaxKept = 8;

  static bool isSame(const HandDescription& a, const HandDescription& b) {
    return (a.file == b.file || (a.file->json == b.file->json && a.file->urdf == b.file->urdf)) &&
           a.axes.size() == b.axes.size() &&
           (a.layout == b.layout ||
            (sameSizes(*a.layout, *b.layout) && samePitches(*a.layout, *b.layout)));
  }

  std::mutex mutex_;
  std::vector<Kept> kept_;
};

}  // namespace

std::string PinchHand::mismatch(const Profile& profile) const {
  const GeometryDescription& mine = effectiveGeometry->description();
  if (!sameSensor(profile.layout(), mine.layout))
    return "a recording of another sensor: its matrices are not those of the hand";
  if (profile.numAngles() > 0 && profile.angles(0).values.size() != mine.numAxes)
    return "a recording of another hand: " + std::to_string(profile.angles(0).values.size()) +
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
          "the two geometries belong to different hands");
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

std::shared_ptr<const PinchHand> pinchHandOf(const HandDescription& hand) {
  static PinchHands hands;
  if (!hand.file || !hand.file->pinch || !hasGeometry(hand)) return nullptr;
  return hands.of(hand);
}

std::string withoutPinchText(const HandDescription& hand) {
  return "the description of '" + shortened(hand.name) +
         "' names no two pads that pinch, which these features need (the set 'statistics' needs "
         "none)";
}

}  // namespace palpate
