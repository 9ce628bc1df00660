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
  for (const Finger& finger : description_.fingers) {
    twists_.emplace_back();
    for (const DhLink& link : finger.links) {
      const Turn turn = turnBy(link.alphaDeg);
      twists_.back().push_back({turn.sine, turn.cosine});
    }
  }
  for (std::size_t m = 0; m < description_.surfaces.size(); ++m) {
    const SensorSurface& surface = description_.surfaces[m];
    const MatrixLayout& layout = description_.layout.matrix(m);
    Pad pad;
    for (int y = 0; y < layout.rows; ++y)
      pad.rows.push_back(surfaceRow(surface, layout.pitchMm, y));
    for (int x = 0; x < layout.columns; ++x)
      pad.columnsMm.push_back(surface.column0Mm + layout.pitchMm * x);
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
      const DhLink& link = finger.links[l];
      if (link.axis)
        out.jointLines_.push_back({*link.axis, f, l, originMm, link.sign * rotation.col(2)});
      const Turn theta =
          turnBy((link.axis ? link.sign * anglesDeg[*link.axis] : 0.0) + link.offsetDeg);
      // Rz(theta) Tz(d) Tx(r) Rx(alpha), column by column.
      const Vector3d x = rotation.col(0) * theta.cosine + rotation.col(1) * theta.sine;
      const Vector3d y = rotation.col(1) * theta.cosine - rotation.col(0) * theta.sine;
      const Vector3d z = rotation.col(2);
      const Twist& alpha = twists_[f][l];
      originMm += z * link.dMm + x * link.rMm;
      rotation.col(0) = x;
      rotation.col(1) = y * alpha.cosine + z * alpha.sine;
      rotation.col(2) = z * alpha.cosine - y * alpha.sine;
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
  const Pad& pad = pads_[matrix];
  const Vector3d along = baseFromLink.linear().col(0), out = baseFromLink.linear().col(1);
  const Vector3d across = baseFromLink.linear().col(2), originMm = baseFromLink.translation();
  for (const SurfaceRow& row : pad.rows) {
    const Vector3d normal = along * row.normalX + out * row.normalY;
    const Vector3d middle = originMm + along * row.xMm + out * row.yMm;
    for (const double columnMm : pad.columnsMm) {
      *positions++ = middle + across * columnMm;
      *normals++ = normal;
    }
  }
}

}  // namespace palpate
