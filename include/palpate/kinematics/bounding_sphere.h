// The smallest sphere that encloses points. It measures the size of the held object and depends
// little on where the fingers touch; contact geometry and the features of a grasp use it (study,
// section 6.1.1; Gaertner 1999, Fischer 2005: CGAL's bounding volumes).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace palpate {

// A sphere by its centre and radius.
struct Sphere {
  // Centre in the frame of the points [mm].
  Eigen::Vector3d centreMm = Eigen::Vector3d::Zero();
  double radiusMm = 0.0;  // [mm], >= 0
};

// Returns the smallest sphere around points [mm]; empty without points. Points lie outside by no
// more than rounding. The radius exceeds the smallest possible one by no more than 1e-10 of itself;
// a lower bound from the points on the sphere proves this, also on regular grids, where CGAL alone
// is wrong by up to 80 %. Throws std::invalid_argument for a coordinate that is not finite.
std::optional<Sphere> smallestEnclosingSphere(const std::vector<Eigen::Vector3d>& pointsMm);

}  // namespace palpate
