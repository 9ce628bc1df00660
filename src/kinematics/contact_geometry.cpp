#include "palpate/kinematics/contact_geometry.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {
namespace {

using Eigen::Vector3d;

// Sums over the active taxels of a matrix; coordinates in taxels from (0, 0).
struct Moments {
  std::size_t count = 0;
  double sum = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  Vector3d position = Vector3d::Zero(), normal = Vector3d::Zero();
};

void requireSameSizes(const TactileFrame& frame, const SensorLayout& layout) {
  bool same = frame.layout && frame.layout->numMatrices() == layout.numMatrices() &&
              frame.values.size() == layout.numCells();
  for (std::size_t m = 0; same && m < layout.numMatrices(); ++m)
    same = frame.layout->matrix(m).rows == layout.matrix(m).rows &&
           frame.layout->matrix(m).columns == layout.matrix(m).columns;
  if (!same) throw std::invalid_argument("contactOf: frame and pose belong to different sensors");
}

// Uses the masks of the frame, since a recording knows its sensor best.
Moments gather(const TactileFrame& frame,
               const HandPose& pose,
               std::size_t matrix,
               double threshold,
               HandContact& out) {
  const MatrixLayout& layout = frame.layout->matrix(matrix);
  const std::size_t first = frame.layout->offset(matrix);
  Moments moments;
  std::size_t at = 0;
  for (int y = 0; y < layout.rows; ++y) {
    for (int x = 0; x < layout.columns; ++x, ++at) {
      const auto value = static_cast<double>(frame.values[first + at]);
      if (layout.staticMask[at] == 0) continue;
      if (!std::isfinite(value)) ++out.numNotFinite;
      if (!std::isfinite(value) || value <= threshold) continue;
      const Vector3d& position = pose.positionsMm()[first + at];
      ++moments.count;
      moments.sum += value;
      moments.x += value * x;
      moments.y += value * y;
      moments.xx += value * x * x;
      moments.xy += value * x * y;
      moments.yy += value * y * y;
      moments.position += value * position;
      moments.normal += value * pose.normals()[first + at];
      out.activeMm.push_back(position);
    }
  }
  return moments;
}

// Computes the eigenvectors of the covariance [[xx, xy], [xy, yy]] in closed form.
void setAxes(MatrixContact& contact,
             const Eigen::Isometry3d& baseFromSurface,
             double xx,
             double xy,
             double yy) {
  const double middle = (xx + yy) / 2.0;
  const double spread = std::hypot((xx - yy) / 2.0, xy);
  contact.majorSdMm = std::sqrt(std::max(0.0, middle + spread));
  contact.minorSdMm = std::sqrt(std::max(0.0, middle - spread));
  const double angle = spread > 1e-12 * middle ? 0.5 * std::atan2(2.0 * xy, xx - yy) : 0.0;
  // The surface's Y axis points to the tip, the coordinate y to the palm.
  const Vector3d across = baseFromSurface.linear().col(0);
  const Vector3d towardsTip = baseFromSurface.linear().col(1);
  contact.majorAxis = std::cos(angle) * across - std::sin(angle) * towardsTip;
  contact.minorAxis = std::sin(angle) * across + std::cos(angle) * towardsTip;
}

MatrixContact contactFrom(const Moments& moments, const HandPose& pose, std::size_t matrix) {
  MatrixContact contact;
  if (moments.count == 0) return contact;
  const MatrixLayout& layout = pose.description().layout.matrix(matrix);
  const double x = moments.x / moments.sum, y = moments.y / moments.sum;
  const double area = layout.taxelAreaMm2();
  contact.numActive = moments.count;
  contact.sum = moments.sum;
  contact.areaMm2 = static_cast<double>(moments.count) * area;
  contact.xMm = x * layout.pitchMm.x;
  contact.yMm = y * layout.pitchMm.y;
  const Eigen::Isometry3d baseFromSurface = pose.baseFromSurface(matrix, contact.xMm, contact.yMm);
  contact.centroidMm = baseFromSurface.translation();
  const double length = moments.normal.norm();
  contact.meanNormal = length > 1e-9 * moments.sum ? Vector3d(moments.normal / length)
                                                   : Vector3d(baseFromSurface.linear().col(2));
  setAxes(contact,
          baseFromSurface,
          (moments.xx / moments.sum - x * x) * (layout.pitchMm.x * layout.pitchMm.x),
          (moments.xy / moments.sum - x * y) * area,
          (moments.yy / moments.sum - y * y) * (layout.pitchMm.y * layout.pitchMm.y));
  return contact;
}

}  // namespace

void ContactOptions::validate() const {
  OptionCheck{"ContactOptions"}(kThreshold, "threshold", threshold);
}

HandContact contactOf(const TactileFrame& frame,
                      const HandPose& pose,
                      const ContactOptions& options) {
  HandContact out;
  contactOf(frame, pose, options, out);
  return out;
}

void contactOf(const TactileFrame& frame,
               const HandPose& pose,
               const ContactOptions& options,
               HandContact& out) {
  options.validate();
  if (pose.empty()) throw std::invalid_argument("contactOf: the pose belongs to no hand");
  requireSameSizes(frame, pose.description().layout);
  out.matrices.clear();
  out.activeMm.clear();
  out.numActive = out.numNotFinite = 0;
  out.sum = out.areaMm2 = 0.0;
  out.centroidMm.reset();
  out.taxelSphere.reset();
  out.centroidSphere.reset();
  Vector3d position = Vector3d::Zero();
  std::vector<Vector3d> centroids;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const Moments moments = gather(frame, pose, m, options.threshold, out);
    out.matrices.push_back(contactFrom(moments, pose, m));
    const MatrixContact& contact = out.matrices.back();
    if (contact.numActive == 0) continue;
    out.numActive += contact.numActive;
    out.sum += contact.sum;
    out.areaMm2 += contact.areaMm2;
    position += moments.position;
    centroids.push_back(contact.centroidMm);
  }
  if (out.numActive == 0) return;
  out.centroidMm = position / out.sum;
  if (!options.spheres) return;
  out.taxelSphere = smallestEnclosingSphere(out.activeMm);
  out.centroidSphere = smallestEnclosingSphere(centroids);
}

}  // namespace palpate
