// Fuzzes descriptions of hands: hand.json, and behind a zero byte the URDF that it names. What is
// accepted is consistent, its geometry is finite or refused, and a small hand can be emulated with
// values in its range.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/device/stream_shape.h"
#include "palpate/emulator/default_scene.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"

namespace {

using namespace palpate;

void requireOfHand(bool condition) {
  if (!condition) std::abort();
}

void checkGeometry(const HandDescription& hand) {
  if (!hasGeometry(hand)) return;
  const HandGeometry geometry(describeGeometry(hand));
  requireOfHand(geometry.description().surfaces.size() == hand.layout->numMatrices());
  const HandPose pose = geometry.pose(std::vector<double>(hand.axes.size(), 0.0));
  requireOfHand(pose.positionsMm().size() == hand.layout->numCells());
  for (const Eigen::Vector3d& normal : pose.normals()) requireOfHand(normal.allFinite());
}

void emulate(const HandDescription& hand) {
  constexpr std::size_t kMaxPlaces = 200;
  if (hand.layout->numCells() > kMaxPlaces || hand.axes.size() > 16) return;
  PhysicalHandOptions options;
  options.hand = hand;
  PhysicalHand model(defaultScene(hand), options);
  std::vector<float> values(hand.layout->numReadings());
  for (const double timeS : {0.1, 1.2, 1.5}) {
    model.advanceTo(timeS);
    model.measure(values);
    for (const float value : values)
      requireOfHand(value >= (hand.layout->decidesTouch() ? -hand.maximumCounts : 0.0F) &&
                    value <= hand.maximumCounts);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = all.find('\0');
  const std::string json(all.substr(0, end));
  const std::string urdf(end == std::string_view::npos ? std::string_view() : all.substr(end + 1));
  try {
    const HandDescription hand = parseHand(json, urdf, "hand.json");
    requireOfHand(hand.layout != nullptr && hand.matrices.size() == hand.layout->numMatrices());
    requireOfHand(hand.saturationCounts <= hand.maximumCounts);
    const StreamShape shape(hand);
    requireOfHand(shape.numTaxels() > 0 && shape.numTaxels() <= shape.numPlaces());
    checkGeometry(hand);
    emulate(hand);
  } catch (const Error& error) {
    requireOfHand(std::string_view(error.what()).find('\n') == std::string_view::npos);
  } catch (const std::invalid_argument&) {
    // A pressure plane that falls, or a preshape outside of its axes.
  }
  return 0;
}
