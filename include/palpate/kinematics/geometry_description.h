// The geometry of a hand as data: chains of joints (standard, distal Denavit-Hartenberg) and sensor
// surfaces on their links. HandGeometry computes poses from it; another hand is another
// description.
//
// Frames: the hand's base frame (the palm's) has z up from the palm. A link's frame has X along the
// link towards the tip, Y out of the sensor surface, Z across. All interfaces use lengths in mm and
// angles in degrees. Source for the SDH-2: the study, chapter 4 (tables 4.1 to 4.3), with the
// constants of the study's program where the printed ones are wrong (d2 = 14.8, t_y = 12 w).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/model/matrix_layout.h>

namespace palpate {

// One link: T = Rz(theta) Tz(d) Tx(r) Rx(alpha), theta = sign * angle of the axis + offset.
struct DhLink {
  // The axis of the hand that turns the link; empty when theta is the fixed offset.
  std::optional<std::size_t> axis;
  double sign = 1.0;
  double offsetDeg = 0.0;
  double dMm = 0.0;
  double rMm = 0.0;
  double alphaDeg = 0.0;
};

// A finger: its base on the palm and its chain of links.
struct Finger {
  Eigen::Vector3d baseMm = Eigen::Vector3d::Zero();  // origin in the base frame [mm]
  Eigen::Matrix3d baseRotation = Eigen::Matrix3d::Identity();
  std::vector<DhLink> links;
};

// The surface of one matrix in the frame at the end of link `link` of a finger. Column x, row y
// (cell centres at whole numbers) are at
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
  std::optional<double> bendRow;  // empty: flat
  double radiusMm = 0.0;          // radius of the bend [mm]
};

// The geometry of a whole hand.
struct GeometryDescription {
  std::size_t numAxes = 0;
  std::vector<Finger> fingers;
  std::vector<SensorSurface> surfaces;  // one per matrix
  SensorLayout layout;

  // Throws std::invalid_argument that names the inconsistency (an axis or link that does not exist,
  // a value that is not finite, and so on).
  void validate() const;
};

// A row of a sensor surface in the frame of its link: the point where its line of taxels crosses Z
// = 0, and the normal there.
struct SurfaceRow {
  double xMm = 0.0, yMm = 0.0;
  double normalX = 0.0, normalY = 1.0;
};
// Returns the surface at any row, also between taxels and beyond the edge.
SurfaceRow surfaceRow(const SensorSurface& surface, double pitchMm, double row);

// Radius of the SDH-2's bent fingertips in the study's program [mm].
constexpr double kStudyFingertipRadiusMm = 58.0;
// The geometry of the SDH-2.
// Effective radius of these fingertips [mm]: with it the same rigid object always measures the
// same.
constexpr double kEffectiveFingertipRadiusMm = 48.4;

// Returns the geometry of the SDH-2.
GeometryDescription sdh2Geometry(double fingertipRadiusMm = kStudyFingertipRadiusMm);

}  // namespace palpate
