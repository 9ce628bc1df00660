// The smallest sphere that encloses points: a measure of the size of what the hand holds that
// depends little on where the fingers touch (the study, section 6.1.1; Gaertner 1999, Fischer 2005:
// CGAL's bounding volumes).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace palpate {

struct Sphere {
  Eigen::Vector3d centreMm = Eigen::Vector3d::Zero();  // in the frame of the points
  double radiusMm = 0.0;                               // [mm], >= 0
};

// The smallest sphere around points [mm]; around none there is nothing. No point lies outside by
// more than rounding, and the radius is proven (by the lower bound that the points on the sphere
// give) to exceed the least by no more than 1e-10 of itself; on regular grids, too, where CGAL
// alone is up to 80 % off. Throws std::invalid_argument: a coordinate that isn't finite.
std::optional<Sphere> smallestEnclosingSphere(const std::vector<Eigen::Vector3d>& pointsMm);

}  // namespace palpate
