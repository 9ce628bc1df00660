// Where the taxels of a hand are: chains of joints (standard, distal Denavit-Hartenberg), sensor surfaces
// on their links, and the pose that joint angles give them.
//
// Frames: the hand's base frame has z up from the palm. A link's frame has X along the link towards the
// tip, Y out of the sensor surface, Z across. Lengths in mm, angles in degrees at every door.
// Source: the study, chapter 4 (tables 4.1 to 4.3), with the constants of its program where the printed
// ones are slips (d2 = 14.8, t_y = 12 w).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/model/matrix_layout.h>

namespace palpate {

// T = Rz(theta) Tz(d) Tx(r) Rx(alpha), theta = sign * angle of the axis + offset.
struct DhLink {
  std::optional<std::size_t> axis;  // of the hand that turns it; nothing: theta is the offset
  double sign = 1.0;
  double offsetDeg = 0.0;
  double dMm = 0.0;
  double rMm = 0.0;
  double alphaDeg = 0.0;
};

struct Finger {
  Eigen::Vector3d baseMm = Eigen::Vector3d::Zero();  // in the base frame
  Eigen::Matrix3d baseRotation = Eigen::Matrix3d::Identity();
  std::vector<DhLink> links;
};

// The surface of one matrix in the frame behind link `link` of a finger. Column x, row y (cell centres at
// whole numbers) lie at
//   X = row0Mm - pitch y, Y = heightMm, Z = column0Mm + pitch x,
// and, towards the tip from row `bendRow` on, on a cylinder about Z that continues it:
//   a = (bendRow - y) pitch / radius,  X = row0Mm - pitch bendRow + radius sin a,
//   Y = heightMm - radius (1 - cos a).
struct SensorSurface {
  std::size_t finger = 0;
  std::size_t link = 0;
  double row0Mm = 0.0;
  double heightMm = 0.0;
  double column0Mm = 0.0;
  std::optional<double> bendRow;  // nothing: flat
  double radiusMm = 0.0;          // of the bend
};

struct GeometryDescription {
  std::size_t numAxes = 0;
  std::vector<Finger> fingers;
  std::vector<SensorSurface> surfaces;  // one per matrix
  SensorLayout layout;
};

// Radius of the SDH-2's bent fingertips [mm].
constexpr double kStudyFingertipRadiusMm = 58.0;      // of the study's program
constexpr double kEffectiveFingertipRadiusMm = 48.4;  // that makes a rigid object measure the same

GeometryDescription sdh2Geometry(double fingertipRadiusMm = kStudyFingertipRadiusMm);

// A joint as a line in space: turning the axis by +1 degree turns all links of the finger from `link` on
// by +1 degree about `direction`.
struct JointLine {
  std::size_t axis = 0;
  std::size_t finger = 0;
  std::size_t link = 0;
  Eigen::Vector3d originMm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit vector
};

// Positions and normals at one set of joint angles. Cheap to keep; a value.
class HandPose {
 public:
  // One per place, matrix after matrix, row by row (places without a taxel, too) [mm, base frame].
  const std::vector<Eigen::Vector3d>& positionsMm() const noexcept { return positionsMm_; }
  // Unit vectors out of the sensor surface, in the same order.
  const std::vector<Eigen::Vector3d>& normals() const noexcept { return normals_; }
  // Of one taxel. Throw std::out_of_range.
  const Eigen::Vector3d& positionMm(std::size_t matrix, int y, int x) const;
  const Eigen::Vector3d& normal(std::size_t matrix, int y, int x) const;
  // Of any point of a sensor surface, in mm from the centre of taxel (0, 0): x across to the right, y
  // towards the palm. Points beyond the edge lie on the surface continued. std::out_of_range: matrix;
  // std::invalid_argument: not finite.
  Eigen::Vector3d pointMm(std::size_t matrix, double xMm, double yMm) const;
  Eigen::Vector3d normalAt(std::size_t matrix, double xMm, double yMm) const;
  // The frame of a matrix' link: columns X, Y, Z in the base frame, and its origin [mm].
  const Eigen::Matrix3d& rotation(std::size_t matrix) const { return frames_.at(matrix).rotation; }
  const Eigen::Vector3d& originMm(std::size_t matrix) const { return frames_.at(matrix).originMm; }
  // All joints of all fingers (an axis that turns two fingers stands here twice).
  const std::vector<JointLine>& jointLines() const noexcept { return jointLines_; }

 private:
  friend class HandGeometry;
  struct Frame {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d originMm;
  };
  const GeometryDescription* description_ = nullptr;
  std::vector<Frame> frames_;  // one per matrix
  std::vector<Eigen::Vector3d> positionsMm_, normals_;
  std::vector<JointLine> jointLines_;
};

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
  // A row's centre line in the link's frame: point at column 0, and normal.
  struct Row {
    double xMm, yMm;  // in the link's frame
    double normalX, normalY;
  };

  GeometryDescription description_;
  std::vector<std::vector<Row>> rows_;  // per matrix
};

}  // namespace palpate
