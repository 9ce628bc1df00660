// The part of a hand description that recognition needs: the two opposite pads that hold an object,
// the ratio of their gains, and the geometry of the hand.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile.h>

namespace palpate {

struct PinchHand {
  // Matrices of the two pads.
  std::array<std::size_t, 2> pads{0, 1};
  // If the two pads don't face each other (an object held by three fingers), the first of these
  // pairs that does is used. Their pads are assumed to have the same gain.
  std::vector<std::array<std::size_t, 2>> otherPads = {};
  // Gain ratio, > 0: counts of the second pad multiplied by this equal the counts of the first pad
  // for the same force.
  double secondPadGain = 1.0;
  // Full scale [counts] by which the study's features divide.
  double fullScaleCounts = 4096.0;
  // Side length [pixels] of the square image that the study's features are computed from; the
  // pad's values are placed at the middle of its top edge.
  int imageSize = 1;
  // Largest counts observed on each pad; they correspond to an indentation of 1 mm (study), > 0.
  std::array<double, 2> largestCounts{1.0, 1.0};
  // Geometry of the study, and the geometry with which a rigid object has the same measured size
  // everywhere on the pads. Never null.
  std::shared_ptr<const HandGeometry> studyGeometry, effectiveGeometry;
  // Axes that hold the object; the set `session` contains their angles at rest.
  std::vector<std::size_t> gripAxes;

  // Returns why a recording does not belong to this hand (other matrices, other axes); empty if it
  // does.
  std::string mismatch(const Profile& profile) const;
  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// Returns what recognition needs of a hand: its `pinch` (PinchDescription) and its geometry. Null
// when its description has no pads that pinch, or no geometry. The result is kept for the next
// recording of the same hand; may be called from several threads.
std::shared_ptr<const PinchHand> pinchHandOf(const HandDescription& hand);

// Why the features of two pads that pinch cannot be computed for a hand without them, one line.
std::string withoutPinchText(const HandDescription& hand);

}  // namespace palpate
