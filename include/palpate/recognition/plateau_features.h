// Eleven features of a grasp that are stable between sessions: contact geometry and force on the
// load plateau of two opposite finger pads. The phases of contact and release are left out, because
// they are not repeatable. They are the set `best` (grasp_features.h).
//
//   size_z           40 ln(1 + D / 40), without a unit: D [mm] is the distance of the pads with the
//   chord corrected
//                    (kinematics/object_size.h), at the effective fingertip radius, of the mean
//                    plateau frame's centroids and the plateau's median angles
//   ln_major         ln(l1 + .15), l1 >= l2: principal second moments of the pressure [taxel^2]
//   ln_minor         ln(l2 + .15)
//   share_1, _4, _9  part of the pressure on the strongest 1, 4 and 9 taxels
//   skew             2 |w| / (u + v + .3), u, v, w: second moments along x, along y, mixed
//   entropy          - sum p ln p
//   ln_active        ln(active taxels + 1)
//   ln_sum           ln(sum of counts)
//   closing_mm       D at a quarter of the load, less D on the plateau [mm]: how far the pads close
//                    while the load rises, foam and object together (the compression of the object
//                    alone: kinematics/object_size.h)
//
// All features except the two that depend on D are means over both pads of the mean plateau frame;
// a taxel is active above 3 % of the largest value of its pad. Load: sum of both pads [counts], the
// second multiplied by its gain, moving average over five frames. Plateau: at most 25 frames,
// evenly selected, with at least 90 % of the largest load. If the two pads do not face each other
// (three-finger grasp), another pair that does is used (PinchHand::otherPads), over the frames in
// which both of its pads touch.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/recognition/grasp_segments.h>
#include <palpate/recognition/pinch_hand.h>

namespace palpate {

struct PlateauFeatureOptions {
  // A plateau frame has at least this fraction of the largest load, 0..1.
  double plateauFraction = 0.9;
  // The compression begins at this fraction of the largest load, 0..1.
  double startFraction = 0.25;
  std::size_t maxPlateauFrames = 25;  // >= 1
  // An active taxel is above this fraction of the largest value of its pad, 0..1.
  double activeFraction = 0.03;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Conversion between D [mm] and size_z, which is nearly linear for small objects and logarithmic
// for large ones. sizeZ() throws nothing; a D of -40 or less (no hand has it) is treated as -39.9.
double sizeZ(double distanceMm) noexcept;
double distanceOfSizeZ(double sizeZ) noexcept;

const std::vector<std::string>& plateauFeatureNames();
// Replaces names in models of earlier releases by the present ones: closing_mm was compression_mm.
void useCurrentFeatureNames(std::vector<std::string>& names);
// Index of size_z in plateauFeatureNames().
constexpr std::size_t kSizeZColumn = 0;

// Values of one pad on the mean plateau frame.
struct PlateauPad {
  double lnMajor = 0.0, lnMinor = 0.0, entropy = 0.0, lnActive = 0.0, lnSum = 0.0;
  // As skew, but signed: > 0 where the contact extends towards rising x and y.
  double slant = 0.0;
  // ln(largest counts).
  double lnPeak = 0.0;
  // Fractions of the strongest 1, 4 and 9 taxels.
  std::array<double, 3> shares{};
  // Centroid [taxels].
  double column = 0.0, row = 0.0;
};

struct PlateauFeatures {
  // Reason why there are no features: no joint angles, no contact, grasp too short, pads that do
  // not face each other, and so on; otherwise empty.
  std::string problem;
  // First frame with a quarter of the largest load.
  std::size_t startFrame = 0;
  // First and last frame of the plateau.
  std::size_t plateauFrame = 0;
  std::size_t plateauEndFrame = 0;
  // D on the plateau [mm].
  double distanceMm = 0.0;
  // Median joint angles over the plateau [deg].
  std::vector<double> plateauAnglesDeg;
  // The two pads that were used.
  std::array<std::size_t, 2> matrices{};
  std::array<PlateauPad, 2> pads;
  // In the order of plateauFeatureNames(); empty if there is a problem.
  std::vector<double> values;
};

// Computes the features of one grasp. Throws std::out_of_range when the grasp has frames that the
// profile doesn't have. What the recording lacks is reported in `problem`.
PlateauFeatures plateauFeatures(const Profile& profile,
                                const GraspSegment& grasp,
                                const PinchHand& hand,
                                const PlateauFeatureOptions& options = {});

}  // namespace palpate
