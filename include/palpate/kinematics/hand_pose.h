// The pose of a hand at one set of joint angles: positions of its taxels, their corners, links and
// joints. A value that HandGeometry::pose() makes; it refers to that geometry, which must outlive
// it.
//
// Everything is in the hand's base frame (the palm's: z up from the palm), in mm. A transform
// `bFromA` converts coordinates in frame A to coordinates in frame B. Points of a sensor surface
// are given in mm from the centre of taxel (0, 0), along the surface: x across (rising column), y
// towards the palm (rising row). The surface continues beyond its edge.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <palpate/kinematics/geometry_description.h>

namespace palpate {

// A joint as a line in space. When the axis moves by 1 (degree, or mm), all links of the finger
// from `link` on turn by |direction| degrees about `direction`, or move by `direction` [mm].
struct JointAxis {
  JointType type = JointType::kRevolute;
  std::size_t axis = 0;
  std::size_t finger = 0;
  std::size_t link = 0;
  Eigen::Vector3d originMm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

// A default-constructed pose has no taxels; accessors of a taxel throw std::out_of_range.
class HandPose {
 public:
  bool empty() const noexcept { return description_ == nullptr; }
  // The geometry of the hand. Throws std::out_of_range when the pose is empty.
  const GeometryDescription& description() const;

  // Positions of all places, matrix after matrix, row by row, including places without a taxel
  // [mm].
  const std::vector<Eigen::Vector3d>& positionsMm() const noexcept { return positionsMm_; }
  // Unit vectors out of the sensor surface, in the same order.
  const std::vector<Eigen::Vector3d>& normals() const noexcept { return normals_; }
  // Position and normal of one taxel. Both throw std::out_of_range.
  const Eigen::Vector3d& positionMm(std::size_t matrix, int y, int x) const;
  const Eigen::Vector3d& normal(std::size_t matrix, int y, int x) const;

  // Position and normal of any point of a sensor surface. They throw std::out_of_range for a matrix
  // that does not exist, and std::invalid_argument for coordinates that are not finite.
  Eigen::Vector3d pointMm(std::size_t matrix, double xMm, double yMm) const;
  Eigen::Vector3d normalAt(std::size_t matrix, double xMm, double yMm) const;
  // The frame that is tangential to the surface at a point: X across (rising column), Y towards the
  // fingertip (falling row), Z = normal.
  Eigen::Isometry3d baseFromSurface(std::size_t matrix, double xMm, double yMm) const;

  // Corner (y, x) of a matrix, y 0..rows, x 0..columns: where taxels (y-1, x-1), (y-1, x), (y, x-1)
  // and (y, x) meet. The corners of taxel (y, x) are (y, x), (y, x+1), (y+1, x+1), (y+1, x). Like
  // the taxels, corners are on the curved surface. Throws std::out_of_range.
  Eigen::Vector3d cornerMm(std::size_t matrix, int y, int x) const;
  // Writes all corners of a matrix, (rows + 1) x (columns + 1), row by row, to `out` and reuses its
  // memory.
  void cornersMm(std::size_t matrix, std::vector<Eigen::Vector3d>& out) const;

  // The frame at the end of a link (the next joint, or the tip of the finger). Throws
  // std::out_of_range.
  const Eigen::Isometry3d& baseFromLink(std::size_t finger, std::size_t link) const;
  // The same of any place, also of the base frame itself.
  const Eigen::Isometry3d& baseFrom(const LinkPlace& place) const;
  // The frame of a matrix' surface (SensorSurface): origin at the centre of taxel (0, 0) unless it
  // is bent there, x along rising columns, y along rising rows, z into the body. For a surface
  // that is described by its taxels: origin and axes at its middle. Throws std::out_of_range.
  Eigen::Isometry3d baseFromMatrix(std::size_t matrix) const;
  // All joints of all fingers. An axis that turns two fingers is listed twice.
  const std::vector<JointAxis>& jointAxes() const noexcept { return jointLines_; }

 private:
  friend class HandGeometry;
  const Eigen::Isometry3d& linkOf(std::size_t matrix) const;
  std::size_t placeOf(std::size_t matrix, int y, int x) const;

  const GeometryDescription* description_ = nullptr;
  std::vector<std::vector<Eigen::Isometry3d>> links_;  // base from link, per finger
  std::vector<Eigen::Vector3d> positionsMm_, normals_;
  std::vector<JointAxis> jointLines_;
};

}  // namespace palpate
