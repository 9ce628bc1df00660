// A hand as recognition sees it: the two opposite pads that hold a thing, how they compare, and
// where they are. Another hand is another description.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/profile.h>

namespace palpate {

struct PinchHand {
  std::array<std::size_t, 2> pads{0, 1};  // matrices
  // Where the two don't face each other (three fingers around a thing), the first of these that do;
  // all alike in gain.
  std::vector<std::array<std::size_t, 2>> otherPads = {};
  // Gain ratio, > 0: counts of the second pad multiplied by this equal the counts of the first pad
  // for the same force.
  double secondPadGain = 1.0;
  double fullScaleCounts = 4096.0;  // counts are divided by it in the study's features
  // Side length [pixels] of the square image that the study's features are computed from; the
  // pad's values are placed at the middle of its top edge.
  int imageSize = 1;
  std::array<double, 2> largestCounts{
      1.0, 1.0};  // seen on each pad: 1 mm of impression there (study), > 0
  // Geometry of the study, and the one in which a rigid object measures the same everywhere on the
  // pads; never null.
  std::shared_ptr<const HandGeometry> studyGeometry, effectiveGeometry;
  // Axes whose angles at rest the features of a session hold (those that hold the thing).
  std::vector<std::size_t> gripAxes;

  // Why a recording is none of this hand's ("" when it is): other matrices, other axes.
  std::string mismatch(const Profile& profile) const;
  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// The SDH-2 in a pinch grip: the distal pads of fingers 0 and 2 (matrices 1 and 5). Gain 2.7:
// finger 0's pad reads 2.4 to 3.2 times finger 2's for the same force; 3554 and 2493 are the
// largest counts of the study's 856 grasps.
const PinchHand& sdh2PinchHand();

}  // namespace palpate
