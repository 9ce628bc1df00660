// Forward kinematics: the pose that joint angles give a hand. Three small chains and one affine map
// per taxel; the position and normal of all 486 taxels of an SDH-2 take about a microsecond.
#pragma once

#include <cstddef>
#include <vector>

#include <palpate/kinematics/geometry_description.h>
#include <palpate/kinematics/hand_pose.h>

namespace palpate {

// Poses of one hand. The poses it gives refer to it: it must outlive them, and stays where it is.
class HandGeometry {
 public:
  // Throws std::invalid_argument naming what doesn't fit (axis or link that isn't there, ..).
  explicit HandGeometry(GeometryDescription description = sdh2Geometry());
  HandGeometry(const HandGeometry&) = delete;
  HandGeometry& operator=(const HandGeometry&) = delete;

  // Angles in degrees, one per axis; the joints' range of motion isn't checked. Throws
  // std::invalid_argument (wrong number, not finite).
  HandPose pose(const std::vector<double>& anglesDeg) const;
  // As pose(), reusing the memory of `out`.
  void pose(const std::vector<double>& anglesDeg, HandPose& out) const;
  const GeometryDescription& description() const noexcept { return description_; }

 private:
  // What of a link doesn't depend on the angles.
  struct Twist {
    double sine = 0.0, cosine = 1.0;  // of alpha
  };
  // What of a matrix doesn't.
  struct Pad {
    std::vector<SurfaceRow> rows;
    std::vector<double> columnsMm;  // Z of each column in the link's frame
  };

  void computeLinks(const std::vector<double>& anglesDeg, HandPose& out) const;
  void placeTaxels(std::size_t matrix,
                   const Eigen::Isometry3d& baseFromLink,
                   Eigen::Vector3d* positions,
                   Eigen::Vector3d* normals) const;

  GeometryDescription description_;
  std::vector<std::vector<Twist>> twists_;  // per finger and link
  std::vector<Pad> pads_;                   // per matrix
};

}  // namespace palpate
