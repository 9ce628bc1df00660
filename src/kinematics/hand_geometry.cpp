#include "palpate/kinematics/hand_geometry.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Turn {
  double sine, cosine;
};

// Returns sine and cosine; exact at multiples of a right angle, so that a straight finger is
// straight.
Turn turnBy(double deg) {
  const double quarters = std::nearbyint(deg / 90.0);
  const double rest = (deg - 90.0 * quarters) * (std::numbers::pi / 180.0);
  const double sine = std::sin(rest), cosine = std::cos(rest);
  switch (static_cast<int>(quarters - 4.0 * std::floor(quarters / 4.0))) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace

HandGeometry::HandGeometry(GeometryDescription description) : description_(std::move(description)) {
  description_.validate();
  for (std::size_t m = 0; m < description_.surfaces.size(); ++m) {
    const SensorSurface& surface = description_.surfaces[m];
    const MatrixLayout& layout = description_.layout.matrix(m);
    Pad pad;
    if (surface.positionsMm.empty()) {
      const Isometry3d& frame = surface.linkFromSurface;
      for (int y = 0; y < layout.rows; ++y) {
        const SurfaceRow row = surfaceRow(surface, layout.pitchMm, y);
        pad.rowsMm.push_back(frame * Vector3d(0.0, row.yMm, row.zMm));
        pad.rowNormals.push_back(frame.linear() * Vector3d(0.0, row.normalY, row.normalZ));
      }
    }
    pads_.push_back(std::move(pad));
  }
}

HandPose HandGeometry::pose(const std::vector<double>& anglesDeg) const {
  HandPose out;
  pose(anglesDeg, out);
  return out;
}

void HandGeometry::pose(const std::vector<double>& anglesDeg, HandPose& out) const {
  if (anglesDeg.size() != description_.numAxes)
    throw std::invalid_argument("HandGeometry: " + std::to_string(anglesDeg.size()) +
                                " angles for " + std::to_string(description_.numAxes) + " axes");
  for (std::size_t i = 0; i < anglesDeg.size(); ++i)
    if (!std::isfinite(anglesDeg[i]))
      throw std::invalid_argument("HandGeometry: angle " + std::to_string(i) + " is not a number");

  out.description_ = &description_;
  computeLinks(anglesDeg, out);
  out.positionsMm_.resize(description_.layout.numCells());
  out.normals_.resize(description_.layout.numCells());
  for (std::size_t m = 0; m < pads_.size(); ++m) {
    const std::size_t first = description_.layout.offset(m);
    placeTaxels(m, out.linkOf(m), out.positionsMm_.data() + first, out.normals_.data() + first);
  }
}

void HandGeometry::computeLinks(const std::vector<double>& anglesDeg, HandPose& out) const {
  out.links_.resize(description_.fingers.size());
  out.jointLines_.clear();
  for (std::size_t f = 0; f < description_.fingers.size(); ++f) {
    const Finger& finger = description_.fingers[f];
    out.links_[f].resize(finger.links.size());
    Matrix3d rotation = finger.baseRotation;
    Vector3d originMm = finger.baseMm;
    for (std::size_t l = 0; l < finger.links.size(); ++l) {
      const ChainLink& link = finger.links[l];
      if (link.axis)
        out.jointLines_.push_back(
            {link.type, *link.axis, f, l, originMm, link.factor * rotation.col(2)});
      const double value = (link.axis ? link.factor * anglesDeg[*link.axis] : 0.0) + link.offset;
      if (link.type == JointType::kPrismatic) {
        originMm += value * rotation.col(2);
      } else {
        const Turn turn = turnBy(value);
        const Vector3d x = rotation.col(0) * turn.cosine + rotation.col(1) * turn.sine;
        rotation.col(1) = rotation.col(1) * turn.cosine - rotation.col(0) * turn.sine;
        rotation.col(0) = x;
      }
      originMm += rotation * link.jointFromEnd.translation();
      rotation = (rotation * link.jointFromEnd.linear()).eval();
      Isometry3d& baseFromLink = out.links_[f][l];
      baseFromLink.linear() = rotation;
      baseFromLink.translation() = originMm;
      baseFromLink.makeAffine();
    }
  }
}

void HandGeometry::placeTaxels(std::size_t matrix,
                               const Isometry3d& baseFromLink,
                               Vector3d* positions,
                               Vector3d* normals) const {
  const SensorSurface& surface = description_.surfaces[matrix];
  const Matrix3d rotation = baseFromLink.linear();
  if (!surface.positionsMm.empty()) {
    for (std::size_t i = 0; i < surface.positionsMm.size(); ++i) {
      *positions++ = baseFromLink * surface.positionsMm[i];
      *normals++ = rotation * surface.normals[i];
    }
    return;
  }
  const Pad& pad = pads_[matrix];
  const Vector3d across = rotation * surface.linkFromSurface.linear().col(0);
  const double pitchMm = description_.layout.matrix(matrix).pitchMm.x;
  for (std::size_t y = 0; y < pad.rowsMm.size(); ++y) {
    const Vector3d normal = rotation * pad.rowNormals[y];
    const Vector3d middle = baseFromLink * pad.rowsMm[y];
    for (int x = 0; x < description_.layout.matrix(matrix).columns; ++x) {
      *positions++ = middle + across * (pitchMm * x);
      *normals++ = normal;
    }
  }
}

}  // namespace palpate
