#include "palpate/kinematics/preshape_opening.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace palpate {
namespace {

constexpr int kRatioSteps = 100;
// Surfaces whose normals form a larger angle than this cosine says face each other: those of three
// fingers round an object do, those of fingers side by side don't.
constexpr double kFacing = -0.3;

double openingMm(const HandPose& pose, const GeometryDescription& hand) {
  const SensorLayout& layout = hand.layout;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < layout.numMatrices(); ++a)
    for (std::size_t b = a + 1; b < layout.numMatrices(); ++b) {
      if (hand.surfaces[a].place.finger == hand.surfaces[b].place.finger) continue;
      for (std::size_t i = layout.offset(a); i < layout.offset(a) + layout.matrix(a).numCells();
           ++i)
        for (std::size_t j = layout.offset(b); j < layout.offset(b) + layout.matrix(b).numCells();
             ++j) {
          const Eigen::Vector3d between = pose.positionsMm()[j] - pose.positionsMm()[i];
          if (pose.normals()[i].dot(pose.normals()[j]) < kFacing &&
              between.dot(pose.normals()[i]) > 0.0)
            smallest = std::min(smallest, between.squaredNorm());
        }
    }
  return std::sqrt(smallest);
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
