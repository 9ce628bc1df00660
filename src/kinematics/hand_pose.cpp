#include "palpate/kinematics/hand_pose.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

SurfaceRow rowAt(const GeometryDescription& hand, std::size_t matrix, double xMm, double yMm) {
  if (!std::isfinite(xMm) || !std::isfinite(yMm))
    throw std::invalid_argument("HandPose: a point that is not a number");
  const double pitchMm = hand.layout.matrix(matrix).pitchMm;
  return surfaceRow(hand.surfaces[matrix], pitchMm, yMm / pitchMm);
}

Vector3d inLink(const SurfaceRow& row, double acrossMm) { return {row.xMm, row.yMm, acrossMm}; }

}  // namespace

const GeometryDescription& HandPose::description() const {
  if (description_ == nullptr) throw std::out_of_range("HandPose: of no hand yet");
  return *description_;
}

const Isometry3d& HandPose::linkOf(std::size_t matrix) const {
  const SensorSurface& surface = description().surfaces.at(matrix);
  return links_[surface.finger][surface.link];
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
  const double acrossMm = description_->surfaces[matrix].column0Mm + xMm;
  return link * inLink(rowAt(*description_, matrix, xMm, yMm), acrossMm);
}

Vector3d HandPose::normalAt(std::size_t matrix, double xMm, double yMm) const {
  const Isometry3d& link = linkOf(matrix);
  const SurfaceRow row = rowAt(*description_, matrix, xMm, yMm);
  return link.linear() * Vector3d(row.normalX, row.normalY, 0.0);
}

Isometry3d HandPose::baseFromSurface(std::size_t matrix, double xMm, double yMm) const {
  const Isometry3d& link = linkOf(matrix);
  const SurfaceRow row = rowAt(*description_, matrix, xMm, yMm);
  Isometry3d linkFromSurface = Isometry3d::Identity();
  linkFromSurface.linear().col(0) = Vector3d::UnitZ();
  linkFromSurface.linear().col(1) = Vector3d(row.normalY, -row.normalX, 0.0);
  linkFromSurface.linear().col(2) = Vector3d(row.normalX, row.normalY, 0.0);
  linkFromSurface.translation() = inLink(row, description_->surfaces[matrix].column0Mm + xMm);
  return link * linkFromSurface;
}

Vector3d HandPose::cornerMm(std::size_t matrix, int y, int x) const {
  const MatrixLayout& of = description().layout.matrix(matrix);
  if (y < 0 || y > of.rows || x < 0 || x > of.columns)
    throw std::out_of_range("matrix " + std::to_string(matrix) + " has no corner (" +
                            std::to_string(x) + ", " + std::to_string(y) + ")");
  return pointMm(matrix, (x - 0.5) * of.pitchMm, (y - 0.5) * of.pitchMm);
}

void HandPose::cornersMm(std::size_t matrix, std::vector<Vector3d>& out) const {
  const Isometry3d& link = linkOf(matrix);
  const SensorSurface& surface = description_->surfaces[matrix];
  const MatrixLayout& of = description_->layout.matrix(matrix);
  const Vector3d step = link.linear().col(2) * of.pitchMm;
  out.clear();
  for (int y = 0; y <= of.rows; ++y) {
    const SurfaceRow row = surfaceRow(surface, of.pitchMm, y - 0.5);
    const Vector3d first = link * inLink(row, surface.column0Mm - 0.5 * of.pitchMm);
    for (int x = 0; x <= of.columns; ++x) out.push_back(first + step * x);
  }
}

const Isometry3d& HandPose::baseFromLink(std::size_t finger, std::size_t link) const {
  return links_.at(finger).at(link);
}

Isometry3d HandPose::baseFromFinger(std::size_t finger) const {
  const Finger& of = description().fingers.at(finger);
  Isometry3d baseFromFinger = Isometry3d::Identity();
  baseFromFinger.linear() = of.baseRotation;
  baseFromFinger.translation() = of.baseMm;
  return baseFromFinger;
}

}  // namespace palpate
