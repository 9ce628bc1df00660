// The joints of a hand's URDF, and which axis of the hand moves each of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/model/hand_description.h>

namespace palpate {

// A joint that can move. Its value = factor * value of the axis + offset [deg, sliding: mm].
struct HandJoint {
  std::string name;
  bool isSliding = false;
  std::optional<std::size_t> axis;  // empty: the joint rests at `offset`
  double factor = 1.0;
  double offset = 0.0;

  // The value for angles of the axes (Sample::deg) [rad, sliding: m]; that of an axis which is
  // missing in `angles` counts as 0.
  double valueSi(std::span<const double> angles) const;
};

// Joints in the order of the axes that move them, then the other ones of the URDF, those that mimic
// others included. A hand without a URDF has one joint per axis, with its name; so has an axis
// without joints. Throws FormatError that names what does not fit in hand.json or the URDF.
std::vector<HandJoint> handJoints(const HandDescription& hand);
// The same for messages about joints, which must have names anyway: never throws FormatError, but
// returns one joint per axis then.
std::vector<HandJoint> shownJoints(const HandDescription& hand);

}  // namespace palpate
