// Measures the size and compression of a held object: the distance between two opposite finger pads
// during a grasp [mm]. The command `contact --size` and the features of a grasp use it.
//
// Two pads tilted by an angle a touch a sphere or a cylinder on a chord, not on its diameter:
//   D = (P2 - P1) . n / cos a,   n = unit(N1 - N2),   cos a = sqrt((1 - N1 . N2) / 2)
// P are the contact centroids, N the normals of the surface there. With the effective fingertip
// radius of 48.4 mm, sizes of the same rigid object agree within 0.23 mm rms (0.51 mm with the
// plain distance and 58 mm): use BendRadius::kEffective for sizes.
//
// The pads are of rubber foam and yield, too: a rigid ball seems to shrink by 2 mm during the
// grasp. The model of the foam is
//   indentation of a pad = foamMm sqrt(peak taxel / 1000 counts)
// with foamMm = 0.80, fitted to 28 classes of rigid objects (455 grasps of 12 to 15 September
// 2014). It varies by +- 24 % from object to object: 0.4 on flat blocks, 1.1 on the hockey ball
// (pointed contacts sink in deeper). docs/notes/contact.md has the table. The model does not
// include hysteresis and temperature of the foam, nor other sensitivities: it uses counts, not
// forces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/profile.h>

namespace palpate {

struct ObjectSizeOptions {
  // The two matrices to use; empty: of two different fingers, those with the largest sums over the
  // grasp.
  std::optional<std::pair<std::size_t, std::size_t>> pads = std::nullopt;
  // A frame belongs to the plateau when its load (five-frame mean; both pads have the same weight)
  // is at least this part of the largest load; 0.5..1.
  double plateauFraction = 0.9;
  double foamMm = 0.80;  // indentation per pad at a peak of 1000 counts [mm], >= 0
  // Scatter of foamMm from object to object, >= 0.
  double foamRelativeSd = 0.24;
  double noiseSdMm = 0.25;  // of the shrinkage of one grasp [mm], >= 0
  // Common error of all sizes of one day, from the calibration of the joints [mm], >= 0.
  double sessionSdMm = 3.0;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Size and load in one frame.
struct SizeSample {
  std::size_t frame = 0;
  std::int64_t timeUs = 0;  // host time [us since 1970]
  // Diameter of the smallest sphere around all active taxels [mm]; 0 without active taxels.
  double sphereMm = 0.0;
  // D between the centroids of the plateau, so that it changes by the motion of the joints alone
  // [mm].
  double distanceMm = 0.0;
  double foamMm = 0.0;     // modelled indentation of both pads together [mm]
  double load = 0.0;       // of both pads, as part of the largest load: 0..1
  bool bothTouch = false;  // both pads have active taxels
};

// Size and compression of an object during one grasp.
struct ObjectSizeReport {
  bool valid = false;
  // The reason why the report is not valid: no joint angles, fewer than two pads, or pads that do
  // not face each other.
  std::string problem;
  // Frames left out because they have no usable joint angles.
  std::size_t unusableFrames = 0;
  std::pair<std::size_t, std::size_t> pads{0, 0};
  std::vector<SizeSample> samples;  // one per frame that was used

  // The following fields are set only in a valid report; lengths in mm.
  std::size_t startFrame = 0;     // the first frame in which both pads touch
  std::size_t plateauFrame = 0;   // the first frame of the plateau
  std::size_t plateauFrames = 0;  // number of frames in the plateau
  double startMm = 0.0;           // D at first contact
  double plateauMm = 0.0;         // D, median of the plateau
  double spherePlateauMm = 0.0;   // diameter of the sphere, median of the plateau
  // shrink = startMm - plateauMm = foam + compression.
  double shrinkMm = 0.0;
  // Modelled increase of both pads' indentation from start to plateau.
  double foamMm = 0.0;
  double compressionMm = 0.0;
  // Standard deviation of the compression: scatter of the foam from object to object, noise, and
  // the motion during one frame at first contact (contact begins between two frames).
  double compressionSdMm = 0.0;
  // Diameter of the object as it is held: plateau + indentation of both pads. The common error of
  // the day is included in diameterSdMm only.
  double diameterMm = 0.0;
  double diameterSdMm = 0.0;
};

// Measures the object over frames begin..end (both inclusive), normally those of one grasp. The
// report's `problem` says what the recording lacks. Throws std::invalid_argument (options, pads,
// geometry of another sensor), std::out_of_range (frames), Cancelled.
ObjectSizeReport objectSize(const Profile& profile,
                            const HandGeometry& geometry,
                            std::size_t begin,
                            std::size_t end,
                            const ObjectSizeOptions& options = {},
                            const Progress& progress = {});

// Returns D of two surface points with their normals (see above); empty when the pads do not face
// each other (N1 . N2 > -0.1).
std::optional<double> chordDistanceMm(const Eigen::Vector3d& point1Mm,
                                      const Eigen::Vector3d& normal1,
                                      const Eigen::Vector3d& point2Mm,
                                      const Eigen::Vector3d& normal2);

}  // namespace palpate
