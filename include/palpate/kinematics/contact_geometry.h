// Where a hand touches: contact centroid, area, mean normal and principal axes of every matrix, and
// the spheres around all of it, in the hand's base frame (the palm's).
//
// A taxel is active when its value is finite and above the threshold, and a taxel exists there
// (static mask). Values that aren't finite are counted and left out; negative ones (filters make
// them) are not active.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/kinematics/bounding_sphere.h>
#include <palpate/kinematics/hand_pose.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

struct ContactOptions {
  // A taxel is active above this value [counts, or what the frame holds], >= 0.
  double threshold = 0.0;
  // The spheres take most of the time; who draws only axes can do without.
  bool spheres = true;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Of a matrix without an active taxel everything is 0.
struct MatrixContact {
  std::size_t numActive = 0;  // active taxels
  double sum = 0.0;           // of their values
  // number x area of a taxel (pitch squared: along the curve arc length is kept)
  double areaMm2 = 0.0;
  // The value-weighted mean of the taxels' places on the unrolled surface, in mm from the centre of
  // taxel (0, 0): x across, y towards the palm; and that point of the surface in the base frame
  // (the study's contact point).
  double xMm = 0.0, yMm = 0.0;
  Eigen::Vector3d centroidMm = Eigen::Vector3d::Zero();
  // Value-weighted mean of the taxels' normals, of length 1, out of the sensor.
  Eigen::Vector3d meanNormal = Eigen::Vector3d::Zero();
  // Principal axes of the values on the unrolled surface, as unit vectors that touch it at the
  // centroid: the major one, along which the contact is longest, and the minor one at a right angle
  // to it (major x minor = normal there). Signs mean nothing. A round contact's major axis lies
  // across the matrix.
  Eigen::Vector3d majorAxis = Eigen::Vector3d::Zero();
  Eigen::Vector3d minorAxis = Eigen::Vector3d::Zero();
  // Value-weighted standard deviations along them [mm], of taxels as points: 0 for a single one.
  double majorSdMm = 0.0, minorSdMm = 0.0;
};

struct HandContact {
  std::vector<MatrixContact> matrices;  // one per matrix
  std::size_t numActive = 0;            // taxels of all matrices
  std::size_t numNotFinite = 0;         // values left out: NaN, infinite
  double sum = 0.0;
  double areaMm2 = 0.0;
  // Value-weighted mean of all active taxels' positions: between the fingers, on none of them.
  std::optional<Eigen::Vector3d> centroidMm;
  // Smallest spheres around all active taxels, and around the matrices' centroids.
  std::optional<Sphere> taxelSphere, centroidSphere;
  // Positions of the active taxels, matrix after matrix, row by row.
  std::vector<Eigen::Vector3d> activeMm;
};

// Throws std::invalid_argument: options; a frame whose matrices have other sizes than the pose's;
// an empty pose.
HandContact contactOf(const TactileFrame& frame,
                      const HandPose& pose,
                      const ContactOptions& options = {});
// The same, reusing the memory of `out`.
void contactOf(const TactileFrame& frame,
               const HandPose& pose,
               const ContactOptions& options,
               HandContact& out);

}  // namespace palpate
