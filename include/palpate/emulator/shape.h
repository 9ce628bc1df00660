// Solid shapes of the objects in a scene, described by their signed distance: negative inside, zero
// on the surface, positive outside.
#pragma once

#include <string_view>

#include <Eigen/Core>

namespace palpate {

enum class ShapeKind {
  kSphere,     // sizeMm: diameter in x
  kCylinder,   // diameter in x, length in z; axis z
  kBox,        // edges in x, y, z
  kEllipsoid,  // diameters in x, y, z
  // Diameter of the base in x, height in z; axis z, tip up, origin at half height.
  kCone,
};

// Parses "sphere", "cylinder", ..; throws std::invalid_argument listing all names.
ShapeKind shapeKind(std::string_view name);

struct Shape {
  ShapeKind kind = ShapeKind::kSphere;
  Eigen::Vector3d sizeMm = Eigen::Vector3d(60.0, 60.0, 60.0);

  // Distance of a point in the shape's own frame [mm]. Exact for sphere, cylinder, box and cone;
  // for the ellipsoid first order near its surface.
  double distanceMm(const Eigen::Vector3d& pointMm) const;
  // Unit vector pointing away from the shape: the gradient of the distance (central differences).
  Eigen::Vector3d gradient(const Eigen::Vector3d& pointMm) const;
};

}  // namespace palpate
