// Forward kinematics: computes the pose of a hand from its joint angles. The position and normal of
// all 486 taxels of an SDH-2 take about a microsecond.
#pragma once

#include <cstddef>
#include <vector>

#include <palpate/kinematics/geometry_description.h>
#include <palpate/kinematics/hand_pose.h>

namespace palpate {

// Computes poses of one hand. The poses refer to this object, which must outlive them; it cannot be
// copied or moved.
class HandGeometry {
 public:
  // Throws std::invalid_argument that names the inconsistency (an axis or link that does not exist,
  // and so on).
  explicit HandGeometry(GeometryDescription description);
  HandGeometry(const HandGeometry&) = delete;
  HandGeometry& operator=(const HandGeometry&) = delete;

  // Returns the pose for angles in degrees, one per axis. The range of motion is not checked.
  // Throws std::invalid_argument for a wrong number of angles, and for angles that are not finite.
  HandPose pose(const std::vector<double>& anglesDeg) const;
  // Does the same as pose() and reuses the memory of `out`.
  void pose(const std::vector<double>& anglesDeg, HandPose& out) const;
  const GeometryDescription& description() const noexcept { return description_; }

 private:
  // The rows of a matrix that is flat or bent, in the frame of its link: where each begins
  // (column 0), and the normal there.
  struct Pad {
    std::vector<Eigen::Vector3d> rowsMm, rowNormals;
  };

  void computeLinks(const std::vector<double>& anglesDeg, HandPose& out) const;
  void placeTaxels(std::size_t matrix,
                   const Eigen::Isometry3d& baseFromLink,
                   Eigen::Vector3d* positions,
                   Eigen::Vector3d* normals) const;

  GeometryDescription description_;
  std::vector<Pad> pads_;  // per matrix
};

}  // namespace palpate
