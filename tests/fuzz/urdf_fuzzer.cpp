// Fuzzes the URDF of a hand with an axis that slides two fingers, one that turns a third link, and
// a matrix on each: it is refused in one line, or its geometry is finite in every posture.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/kinematics/hand_geometry.h"
#include "palpate/model/hand_file.h"

namespace {

using namespace palpate;

void requireOfUrdf(bool condition) {
  if (!condition) std::abort();
}

constexpr const char* kHandOfUrdf = R"({
  "format": "palpate-hand", "version": 1, "name": "two fingers", "full_scale": 100,
  "matrices": [
    {"name": "left", "rows": 2, "columns": 2, "pitch_mm": 3,
     "surface": {"link": "left_finger", "origin_mm": [0, 0, 5], "x_axis": [1, 0, 0], "y_axis": [0, 1, 0]}},
    {"name": "right", "rows": 2, "columns": 2, "pitch_mm": 3,
     "surface": {"link": "right_finger", "origin_mm": [0, 0, 5], "x_axis": [1, 0, 0], "y_axis": [0, 1, 0]}}],
  "axes": [{"name": "travel", "unit": "mm", "minimum": 0, "maximum": 55, "joints": ["left", "right"]}],
  "urdf": "hand.urdf"})";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string urdf(reinterpret_cast<const char*>(data), size);
  try {
    const HandDescription hand = parseHand(kHandOfUrdf, urdf, "hand.json");
    const HandGeometry geometry(describeGeometry(hand));
    for (const double travelMm : {0.0, 27.5, 55.0}) {
      const HandPose pose = geometry.pose({travelMm});
      requireOfUrdf(pose.positionsMm().size() == 8);
      for (const Eigen::Vector3d& at : pose.positionsMm()) requireOfUrdf(at.allFinite());
      for (const Eigen::Vector3d& normal : pose.normals())
        requireOfUrdf(std::abs(normal.norm() - 1.0) < 1e-6);
    }
  } catch (const Error& error) {
    requireOfUrdf(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
  return 0;
}
