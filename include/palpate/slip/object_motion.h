// How the held object moves, from the slip of all matrices: least squares over tangent vectors in
// space.
//
// A contact at r_i (base frame) on a surface with the tangents X_i (rising column) and Y_i (rising
// row) slips by s_i taxels: the object's point there moves by X_i s_x + Y_i s_y along the surface;
// across it nothing is felt. With v_i = t + w x (r_i - c):
//   X_i . (t + w x (r_i - c)) = pitch s_x,    Y_i . (..) = pitch s_y,
//   w . N_i = turn_i where a turn is known
// solved for t and w (singular values below 1e-3 of the largest are dropped: what isn't known is
// 0). Two contacts leave the turn about the line between them free unless their own turns are
// known; one contact leaves more. To first order: for motions small against the object.
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
  // the contact's centroid on the surface, base frame
  Eigen::Vector3d originMm = Eigen::Vector3d::Zero();
  Eigen::Vector3d vectorMm = Eigen::Vector3d::Zero();  // along the surface
  Eigen::Vector3d alongX = Eigen::Vector3d::UnitX();   // unit tangents: rising column, rising row
  Eigen::Vector3d alongY = Eigen::Vector3d::UnitY();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // out of the sensor
  // Turn about the normal by the right hand, where it is known [rad]. On the screen (y down) a turn
  // is clockwise when positive; the normal points to the viewer, so that this is its negative.
  std::optional<double> turnRad;
  double weight = 1.0;  // > 0
};

// Arrow of a contact at (x, y) [taxels] that moved by (dx, dy) [taxels]. Throws std::out_of_range
// (matrix), std::invalid_argument (not finite, weight, pitch).
SlipArrow slipArrow(const HandPose& pose,
                    std::size_t matrix,
                    double pitchMm,
                    double x,
                    double y,
                    double dx,
                    double dy,
                    std::optional<double> turnDeg = std::nullopt,
                    double weight = 1.0);

// Arrows of all matrices with a valid motion: since the reference, or of the last step.
std::vector<SlipArrow> slipArrows(const HandPose& pose,
                                  const SensorLayout& layout,
                                  std::span<const SlipMotion> motions,
                                  bool sinceReference);

struct ObjectMotion {
  std::size_t contacts = 0;
  int rank = 0;  // 0..6: how many numbers of t and w are known
  Eigen::Vector3d centerMm = Eigen::Vector3d::Zero();       // c: mean of the contacts
  Eigen::Vector3d translationMm = Eigen::Vector3d::Zero();  // t, of the point c
  Eigen::Vector3d rotationRad = Eigen::Vector3d::Zero();    // w: axis times angle
  double residualMm = 0.0;  // rms over the tangent components, weighted
  // Directions that nothing tells: of unit length in (t, w times the contacts' mean distance from
  // c).
  std::vector<Eigen::Matrix<double, 6, 1>> unknown;
};

// Throws std::invalid_argument (a vector or weight that isn't finite, weight <= 0).
ObjectMotion objectMotion(std::span<const SlipArrow> arrows);

}  // namespace palpate
