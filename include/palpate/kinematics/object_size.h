// Size and compression of a held object: the distance between two opposite finger pads during a
// grasp [mm].
//
// Two pads tilted by an angle a touch a sphere or a cylinder on a chord, not on its diameter:
//   D = (P2 - P1) . n / cos a,   n = unit(N1 - N2),   cos a = sqrt((1 - N1 . N2) / 2)
// P: contact centroids, N: normals of the surface there. With the effective fingertip radius
// of 48.4 mm the same rigid object then measures the same within .23 mm rms (.51 with the plain
// distance and 58 mm): use sdh2Geometry(kEffectiveFingertipRadiusMm) for sizes.
//
// Foam. The pads are rubber foam and give way, too: a rigid ball seems to shrink by 2 mm while it
// is gripped. Modelled is
//   indentation of a pad = foamMm sqrt(peak taxel / 1000 counts)
// with foamMm = 0.80, fitted to 28 classes of rigid objects (455 grasps of 12 to 15 September
// 2014): +- 24 % from object to object, 0.4 on flat blocks, 1.1 on the hockey ball (pointed
// contacts sink in deeper). docs/contact.md has the table. The model does not include hysteresis
// and temperature of the foam, nor other sensitivities: it uses counts, not forces.
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
  // Two matrices; nothing: of two different fingers those with the largest sums over the grasp.
  std::optional<std::pair<std::size_t, std::size_t>> pads = std::nullopt;
  // The plateau: frames whose load (five-frame mean; each pad counts alike) is at least this part
  // of the largest; 0.5..1.
  double plateauFraction = 0.9;
  double foamMm = 0.80;          // [mm] at a peak of 1000 counts, per pad, >= 0
  double foamRelativeSd = 0.24;  // from object to object, >= 0
  double noiseSdMm = 0.25;       // of the shrinkage of one grasp, >= 0
  double sessionSdMm = 3.0;  // of all sizes of one day together (calibration of the joints), >= 0

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct SizeSample {
  std::size_t frame = 0;
  std::int64_t timeUs = 0;  // host time [us since 1970]
  double sphereMm = 0.0;  // diameter of the smallest sphere around all active taxels [mm]; 0: none
  // D between the plateau's centroids [mm]: the course of the joints alone
  double distanceMm = 0.0;
  double foamMm = 0.0;     // modelled indentation of both pads together [mm]
  double load = 0.0;       // of both pads, as part of the largest: 0..1
  bool bothTouch = false;  // both pads have active taxels
};

struct ObjectSizeReport {
  bool valid = false;
  // why not: no joint angles, fewer than two pads, pads that don't face each other
  std::string problem;
  std::size_t unusableFrames = 0;  // without usable joint angles: left out
  std::pair<std::size_t, std::size_t> pads{0, 0};
  std::vector<SizeSample> samples;  // a row per frame that counts

  // All below of a valid report only; lengths in mm.
  std::size_t startFrame = 0;     // the first one in which both pads touch
  std::size_t plateauFrame = 0;   // the first one of the plateau
  std::size_t plateauFrames = 0;  // how many belong to it
  double startMm = 0.0;           // D at first contact
  double plateauMm = 0.0;         // D, median of the plateau
  double spherePlateauMm = 0.0;   // diameter of the sphere, median of the plateau
  // shrink = startMm - plateauMm = foam + compression.
  double shrinkMm = 0.0;
  double foamMm = 0.0;  // modelled growth of both pads' indentation from start to plateau
  double compressionMm = 0.0;
  // Of the compression: scatter of the foam from object to object, noise, and the way of one frame
  // at first contact (contact begins between two frames).
  double compressionSdMm = 0.0;
  // Of the object as it is held: plateau + indentation of both pads. The same day's offset is in
  // its sd only.
  double diameterMm = 0.0;
  double diameterSdMm = 0.0;
};

// Over frames begin..end (both inclusive), best those of one grasp. What the recording lacks is
// said by the report; throws std::invalid_argument (options, pads, geometry of another sensor),
// std::out_of_range (frames), Cancelled.
ObjectSizeReport objectSize(const Profile& profile,
                            const HandGeometry& geometry,
                            std::size_t begin,
                            std::size_t end,
                            const ObjectSizeOptions& options = {},
                            const Progress& progress = {});

// D of two surface points with their normals (see above): nothing where the pads don't face each
// other (N1 . N2 > -0.1).
std::optional<double> chordDistanceMm(const Eigen::Vector3d& point1Mm,
                                      const Eigen::Vector3d& normal1,
                                      const Eigen::Vector3d& point2Mm,
                                      const Eigen::Vector3d& normal2);

}  // namespace palpate
