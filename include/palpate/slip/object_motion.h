// Motion of the held object, estimated from the slip of all matrices by least squares over tangent
// vectors in space. The 3D view of the window shows it.
//
// A contact at r_i (base frame) on a surface with the tangents X_i (rising column) and Y_i (rising
// row) slips by s_i taxels: the point of the object at the contact moves by pitch.x s_x X_i +
// pitch.y s_y Y_i along the surface. Motion across the surface cannot be measured. With v_i = t + w
// x (r_i - c):
//   X_i . (t + w x (r_i - c)) = pitch.x s_x,    Y_i . (..) = pitch.y s_y,
//   w . N_i = turn_i where a rotation is known
// These equations are solved for t and w. Singular values below 1e-3 of the largest are dropped, so
// that undetermined components are 0. Two contacts leave the rotation about the line between them
// undetermined unless their own rotations are known; one contact leaves more undetermined. The
// equations are linearised: they hold for motions that are small compared with the object.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <palpate/kinematics/hand_pose.h>
#include <palpate/slip/slip_motion.h>

namespace palpate {

// Slip of one matrix as an arrow in space.
struct SlipArrow {
  std::size_t matrix = 0;
  // Centroid of the contact on the surface, in the base frame [mm].
  Eigen::Vector3d originMm = Eigen::Vector3d::Zero();
  // Motion along the surface [mm].
  Eigen::Vector3d vectorMm = Eigen::Vector3d::Zero();
  // Unit tangents in the directions of rising column and rising row.
  Eigen::Vector3d alongX = Eigen::Vector3d::UnitX();
  Eigen::Vector3d alongY = Eigen::Vector3d::UnitY();
  // Unit normal that points out of the sensor.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  // Rotation about the normal, right-handed [rad], where it is known. On the screen (y down) a
  // clockwise rotation is positive; the normal points to the viewer, so that this value has the
  // opposite sign.
  std::optional<double> turnRad;
  double weight = 1.0;  // > 0
};

// Returns the arrow of a contact at (x, y) [taxels] that moved by (dx, dy) [taxels]. Throws
// std::out_of_range (matrix), std::invalid_argument (a value that is not finite, weight, pitch).
SlipArrow slipArrow(const HandPose& pose,
                    std::size_t matrix,
                    const TaxelPitch& pitchMm,
                    double x,
                    double y,
                    double dx,
                    double dy,
                    std::optional<double> turnDeg = std::nullopt,
                    double weight = 1.0);

struct ObjectMotion {
  std::size_t contacts = 0;
  // Number of determined components of t and w, 0..6.
  int rank = 0;
  // Point c: the mean of the contacts [mm].
  Eigen::Vector3d centerMm = Eigen::Vector3d::Zero();
  // Translation t of the point c [mm].
  Eigen::Vector3d translationMm = Eigen::Vector3d::Zero();
  // Rotation vector w: axis times angle [rad].
  Eigen::Vector3d rotationRad = Eigen::Vector3d::Zero();
  // Weighted rms residual of the tangent components [mm].
  double residualMm = 0.0;
  // Undetermined directions, as unit vectors of (t, w times the mean distance of the contacts from
  // c).
  std::vector<Eigen::Matrix<double, 6, 1>> unknown;
};

// Throws std::invalid_argument (a vector or weight that is not finite, weight <= 0).
ObjectMotion objectMotion(std::span<const SlipArrow> arrows);

}  // namespace palpate
