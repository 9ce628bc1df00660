#include "palpate/kinematics/preshape_opening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/kinematics/object_size.h"

namespace palpate {
namespace {

constexpr int kRatioSteps = 100;
// Surfaces whose normals form a larger angle than this cosine says face each other: those of three
// fingers round an object do, those of fingers side by side don't.
constexpr double kFacing = -0.3;

// The diameter of the smallest sphere that touches the same rows of two pads in their middle.
double openingMm(const HandPose& pose, const GeometryDescription& hand) {
  const SensorLayout& layout = hand.layout;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < layout.numMatrices(); ++a)
    for (std::size_t b = a + 1; b < layout.numMatrices(); ++b) {
      const LinkPlace& one = hand.surfaces[a].place;
      const LinkPlace& other = hand.surfaces[b].place;
      if (one.finger == other.finger || one.link != other.link) continue;
      const int rows = std::min(layout.matrix(a).rows, layout.matrix(b).rows);
      for (int row = 0; row < rows; ++row) {
        const int i = layout.matrix(a).columns / 2, j = layout.matrix(b).columns / 2;
        const Eigen::Vector3d& from = pose.positionMm(a, row, i);
        const Eigen::Vector3d& normal = pose.normal(a, row, i);
        if (normal.dot(pose.normal(b, row, j)) > kFacing) continue;
        const auto chord =
            chordDistanceMm(from, normal, pose.positionMm(b, row, j), pose.normal(b, row, j));
        if (chord && *chord > 0.0) smallest = std::min(smallest, *chord);
      }
    }
  return smallest;
}

}  // namespace

std::optional<double> touchRatioOf(const HandGeometry& geometry,
                                   const Preshape& preshape,
                                   double sizeMm) {
  if (!(sizeMm >= 0.0 && std::isfinite(sizeMm)))
    throw std::invalid_argument("touchRatioOf: the size is negative or not finite");
  HandPose pose = geometry.pose(preshape.anglesDeg(0.0));
  for (int step = 0; step <= kRatioSteps; ++step) {
    const double ratio = static_cast<double>(step) / kRatioSteps;
    geometry.pose(preshape.anglesDeg(ratio), pose);
    if (openingMm(pose, geometry.description()) <= sizeMm) return ratio;
  }
  return std::nullopt;
}

}  // namespace palpate
