// Computes where a hand touches: contact centroid, area, mean normal and principal axes of every
// matrix, and the spheres around all active taxels, in the hand's base frame (the palm's). The
// command `contact`, the 3D view and the object size use it.
//
// A taxel is active when its value is finite and above the threshold, and the static mask says that
// it exists. Values that are not finite are counted and left out. Negative values, which filters
// can produce, are not active.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/option_check.h>
#include <palpate/kinematics/bounding_sphere.h>
#include <palpate/kinematics/hand_pose.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

struct ContactOptions {
  // A taxel is active above this value [counts, or the unit of the frame's values].
  static constexpr OptionRange kThreshold{0.0, 1e9};
  double threshold = 0.0;
  // Whether to compute the spheres, which take most of the time. Drawing only axes does not need
  // them.
  bool spheres = true;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// The contact of one matrix; everything is 0 when no taxel is active.
struct MatrixContact {
  std::size_t numActive = 0;  // number of active taxels
  double sum = 0.0;           // sum of their values
  // numActive * area of a taxel (pitch squared; also on the curved part, where pitch is an arc
  // length).
  double areaMm2 = 0.0;
  // Value-weighted mean of the taxels' places on the unrolled surface, in mm from the centre of
  // taxel (0, 0): x across, y towards the palm. centroidMm is the same point of the surface in the
  // base frame (the study's contact point).
  double xMm = 0.0, yMm = 0.0;
  Eigen::Vector3d centroidMm = Eigen::Vector3d::Zero();
  // Value-weighted mean of the taxels' normals, with length 1; it points out of the sensor.
  Eigen::Vector3d meanNormal = Eigen::Vector3d::Zero();
  // Principal axes of the values on the unrolled surface, as unit vectors tangential to it at the
  // centroid: the major one, along which the contact is longest, and the minor one at a right angle
  // (major x minor = normal at that point). Their signs have no meaning. The major axis of a round
  // contact is across the matrix.
  Eigen::Vector3d majorAxis = Eigen::Vector3d::Zero();
  Eigen::Vector3d minorAxis = Eigen::Vector3d::Zero();
  // Value-weighted standard deviations along the axes [mm], with taxels as points: 0 for a single
  // taxel.
  double majorSdMm = 0.0, minorSdMm = 0.0;
};

// The contact of a whole hand in one frame.
struct HandContact {
  std::vector<MatrixContact> matrices;  // one per matrix
  std::size_t numActive = 0;            // active taxels of all matrices
  std::size_t numNotFinite = 0;         // values left out because they are NaN or infinite
  double sum = 0.0;
  double areaMm2 = 0.0;
  // Value-weighted mean of all active taxels' positions. It lies between the fingers.
  std::optional<Eigen::Vector3d> centroidMm;
  // Smallest spheres around all active taxels, and around the centroids of the matrices.
  std::optional<Sphere> taxelSphere, centroidSphere;
  // Positions of the active taxels, matrix after matrix, row by row.
  std::vector<Eigen::Vector3d> activeMm;
};

// Computes the contact of a frame. Throws std::invalid_argument for bad options, a frame whose
// matrices have other sizes than those of the pose, or an empty pose.
HandContact contactOf(const TactileFrame& frame,
                      const HandPose& pose,
                      const ContactOptions& options = {});
// Does the same and reuses the memory of `out`.
void contactOf(const TactileFrame& frame,
               const HandPose& pose,
               const ContactOptions& options,
               HandContact& out);

}  // namespace palpate
