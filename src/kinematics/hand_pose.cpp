#include "palpate/kinematics/hand_pose.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// A point of a surface in the frame of its link: position, the directions of rising columns and
// rows along the surface, and the outward normal (unit vectors).
struct LinkPoint {
  Vector3d atMm, right, down, normal;
};

void requireFinite(double xMm, double yMm) {
  if (!std::isfinite(xMm) || !std::isfinite(yMm))
    throw std::invalid_argument("HandPose: a point that is not a number");
}

// Bilinear between the four nearest taxels, and continued beyond the edge by the same formula.
LinkPoint pointBetweenTaxels(const SensorSurface& surface,
                             const MatrixLayout& layout,
                             double xMm,
                             double yMm) {
  const auto cell = [](double at, int count) {
    return std::clamp(static_cast<int>(std::floor(at)), 0, std::max(count - 2, 0));
  };
  const double column = xMm / layout.pitchMm.x, row = yMm / layout.pitchMm.y;
  const int x0 = cell(column, layout.columns), y0 = cell(row, layout.rows);
  const int x1 = std::min(x0 + 1, layout.columns - 1), y1 = std::min(y0 + 1, layout.rows - 1);
  const double u = column - x0, v = row - y0;
  const auto mix = [&](const std::vector<Vector3d>& of) {
    const auto at = [&](int y, int x) -> const Vector3d& {
      return of[static_cast<std::size_t>(y * layout.columns + x)];
    };
    struct Mixed {
      Vector3d value, alongX, alongY;
    };
    return Mixed{(1.0 - v) * ((1.0 - u) * at(y0, x0) + u * at(y0, x1)) +
                     v * ((1.0 - u) * at(y1, x0) + u * at(y1, x1)),
                 (1.0 - v) * (at(y0, x1) - at(y0, x0)) + v * (at(y1, x1) - at(y1, x0)),
                 (1.0 - u) * (at(y1, x0) - at(y0, x0)) + u * (at(y1, x1) - at(y0, x1))};
  };
  const auto position = mix(surface.positionsMm);
  Vector3d normal = mix(surface.normals).value;
  normal = normal.norm() > 1e-9 ? Vector3d(normal.normalized()) : surface.normals[0];
  // The directions are made perpendicular to the normal. A single row or column has no direction
  // across; it follows from the other one.
  Vector3d right = position.alongX - normal * normal.dot(position.alongX);
  Vector3d down = position.alongY - normal * normal.dot(position.alongY);
  if (right.norm() < 1e-9)
    right = down.norm() < 1e-9 ? normal.unitOrthogonal() : normal.cross(down);
  right.normalize();
  down = right.cross(normal);
  return {position.value, right, down, normal};
}

// `row` of a surface that is flat or bent.
LinkPoint pointInRow(const SensorSurface& surface,
                     const TaxelPitch& pitchMm,
                     double xMm,
                     double row) {
  const SurfaceRow at = surfaceRow(surface, pitchMm, row);
  const Isometry3d& frame = surface.linkFromSurface;
  const Vector3d normal = frame.linear() * Vector3d(0.0, at.normalY, at.normalZ);
  return {frame * Vector3d(xMm, at.yMm, at.zMm),
          frame.linear().col(0),
          frame.linear().col(0).cross(normal),
          normal};
}

LinkPoint surfacePoint(const GeometryDescription& hand,
                       std::size_t matrix,
                       double xMm,
                       double yMm) {
  const SensorSurface& surface = hand.surfaces[matrix];
  const MatrixLayout& layout = hand.layout.matrix(matrix);
  if (!surface.positionsMm.empty()) return pointBetweenTaxels(surface, layout, xMm, yMm);
  return pointInRow(surface, layout.pitchMm, xMm, yMm / layout.pitchMm.y);
}

}  // namespace

const GeometryDescription& HandPose::description() const {
  if (description_ == nullptr) throw std::out_of_range("HandPose: of no hand yet");
  return *description_;
}

const Isometry3d& HandPose::linkOf(std::size_t matrix) const {
  return baseFrom(description().surfaces.at(matrix).place);
}

const Isometry3d& HandPose::baseFrom(const LinkPlace& place) const {
  static const Isometry3d base = Isometry3d::Identity();
  if (!place.link) return base;
  return baseFromLink(place.finger, *place.link);
}

std::size_t HandPose::placeOf(std::size_t matrix, int y, int x) const {
  const SensorLayout& layout = description().layout;
  const MatrixLayout& of = layout.matrix(matrix);
  if (y < 0 || y >= of.rows || x < 0 || x >= of.columns)
    throw std::out_of_range("matrix " + std::to_string(matrix) + " has no place (" +
                            std::to_string(x) + ", " + std::to_string(y) + ")");
  return layout.offset(matrix) + static_cast<std::size_t>(y * of.columns + x);
}

const Vector3d& HandPose::positionMm(std::size_t matrix, int y, int x) const {
  return positionsMm_[placeOf(matrix, y, x)];
}

const Vector3d& HandPose::normal(std::size_t matrix, int y, int x) const {
  return normals_[placeOf(matrix, y, x)];
}

Vector3d HandPose::pointMm(std::size_t matrix, double xMm, double yMm) const {
  const Isometry3d& link = linkOf(matrix);
  requireFinite(xMm, yMm);
  return link * surfacePoint(*description_, matrix, xMm, yMm).atMm;
}

Vector3d HandPose::normalAt(std::size_t matrix, double xMm, double yMm) const {
  const Isometry3d& link = linkOf(matrix);
  requireFinite(xMm, yMm);
  return link.linear() * surfacePoint(*description_, matrix, xMm, yMm).normal;
}

Isometry3d HandPose::baseFromSurface(std::size_t matrix, double xMm, double yMm) const {
  const Isometry3d& link = linkOf(matrix);
  requireFinite(xMm, yMm);
  const LinkPoint point = surfacePoint(*description_, matrix, xMm, yMm);
  Isometry3d linkFromSurface = Isometry3d::Identity();
  linkFromSurface.linear().col(0) = point.right;
  linkFromSurface.linear().col(1) = -point.down;
  linkFromSurface.linear().col(2) = point.normal;
  linkFromSurface.translation() = point.atMm;
  return link * linkFromSurface;
}

Isometry3d HandPose::baseFromMatrix(std::size_t matrix) const {
  const Isometry3d& link = linkOf(matrix);
  const SensorSurface& surface = description_->surfaces[matrix];
  if (surface.positionsMm.empty()) return link * surface.linkFromSurface;
  const MatrixLayout& layout = description_->layout.matrix(matrix);
  const LinkPoint middle = surfacePoint(*description_,
                                        matrix,
                                        layout.pitchMm.x * (layout.columns - 1) / 2.0,
                                        layout.pitchMm.y * (layout.rows - 1) / 2.0);
  Isometry3d frame = Isometry3d::Identity();
  frame.linear().col(0) = middle.right;
  frame.linear().col(1) = middle.down;
  frame.linear().col(2) = -middle.normal;
  frame.translation() = middle.atMm;
  return link * frame;
}

Vector3d HandPose::cornerMm(std::size_t matrix, int y, int x) const {
  const MatrixLayout& of = description().layout.matrix(matrix);
  if (y < 0 || y > of.rows || x < 0 || x > of.columns)
    throw std::out_of_range("matrix " + std::to_string(matrix) + " has no corner (" +
                            std::to_string(x) + ", " + std::to_string(y) + ")");
  return pointMm(matrix, (x - 0.5) * of.pitchMm.x, (y - 0.5) * of.pitchMm.y);
}

void HandPose::cornersMm(std::size_t matrix, std::vector<Vector3d>& out) const {
  const Isometry3d& link = linkOf(matrix);
  const SensorSurface& surface = description_->surfaces[matrix];
  const MatrixLayout& of = description_->layout.matrix(matrix);
  out.clear();
  for (int y = 0; y <= of.rows; ++y) {
    if (!surface.positionsMm.empty()) {
      for (int x = 0; x <= of.columns; ++x) out.push_back(cornerMm(matrix, y, x));
      continue;
    }
    const LinkPoint first = pointInRow(surface, of.pitchMm, -0.5 * of.pitchMm.x, y - 0.5);
    const Vector3d start = link * first.atMm, step = link.linear() * (first.right * of.pitchMm.x);
    for (int x = 0; x <= of.columns; ++x) out.push_back(start + step * x);
  }
}

const Isometry3d& HandPose::baseFromLink(std::size_t finger, std::size_t link) const {
  return links_.at(finger).at(link);
}

}  // namespace palpate
