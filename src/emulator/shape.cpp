#include "palpate/emulator/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cylinder(const Vector3d& p, double radius, double half) {
  const Vector2d d(std::hypot(p.x(), p.y()) - radius, std::abs(p.z()) - half);
  return std::min(std::max(d.x(), d.y()), 0.0) + d.cwiseMax(0.0).norm();
}

double box(const Vector3d& p, const Vector3d& half) {
  const Vector3d d = p.cwiseAbs() - half;
  return std::min(d.maxCoeff(), 0.0) + d.cwiseMax(0.0).norm();
}

double ellipsoid(const Vector3d& p, const Vector3d& radii) {
  const double k0 = p.cwiseQuotient(radii).norm();
  const double k1 = p.cwiseQuotient(radii.cwiseAbs2()).norm();
  if (k1 < 1e-12) return -radii.minCoeff();
  return k0 * (k0 - 1.0) / k1;
}

// In the half plane (distance from the axis, height): distance from a triangle with its base on the
// axis.
double cone(const Vector3d& p, double radius, double half) {
  const Vector2d q(std::hypot(p.x(), p.y()), p.z());
  const Vector2d tip(0.0, half), rim(radius, -half);
  const auto toSegment = [&](const Vector2d& a, const Vector2d& b) {
    const Vector2d edge = b - a;
    const double t = std::clamp((q - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    return (q - a - t * edge).norm();
  };
  const double distance = std::min(toSegment(tip, rim), toSegment(Vector2d(0.0, -half), rim));
  const Vector2d slope = rim - tip;
  const bool inside =
      q.y() > -half && slope.x() * (q.y() - tip.y()) - slope.y() * (q.x() - tip.x()) < 0.0;
  return inside ? -distance : distance;
}

}  // namespace

ShapeKind shapeKind(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, ShapeKind>, 5> kNames = {
      {{"sphere", ShapeKind::kSphere},
       {"cylinder", ShapeKind::kCylinder},
       {"box", ShapeKind::kBox},
       {"ellipsoid", ShapeKind::kEllipsoid},
       {"cone", ShapeKind::kCone}}};
  for (const auto& [known, kind] : kNames)
    if (known == name) return kind;
  throw std::invalid_argument("'" + shortened(name) +
                              "' isn't a shape; there are sphere, cylinder, box, ellipsoid, cone");
}

double Shape::distanceMm(const Vector3d& p) const {
  switch (kind) {
    case ShapeKind::kSphere:
      return p.norm() - sizeMm.x() / 2.0;
    case ShapeKind::kCylinder:
      return cylinder(p, sizeMm.x() / 2.0, sizeMm.z() / 2.0);
    case ShapeKind::kBox:
      return box(p, sizeMm / 2.0);
    case ShapeKind::kEllipsoid:
      return ellipsoid(p, sizeMm / 2.0);
    case ShapeKind::kCone:
      return cone(p, sizeMm.x() / 2.0, sizeMm.z() / 2.0);
  }
  return 0.0;
}

Vector3d Shape::gradient(const Vector3d& p) const {
  constexpr double kStepMm = 1e-4;
  Vector3d slope;
  for (int i = 0; i < 3; ++i) {
    Vector3d step = Vector3d::Zero();
    step[i] = kStepMm;
    slope[i] = distanceMm(p + step) - distanceMm(p - step);
  }
  const double norm = slope.norm();
  return norm > 0.0 ? Vector3d(slope / norm) : Vector3d::UnitZ();
}

}  // namespace palpate
