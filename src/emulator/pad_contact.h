// Contact between pads: fingers of an empty hand that close until they meet. Two rubber foundations
// act in series, so each is indented by half of the overlap of the surfaces.
#pragma once

#include <cstddef>
#include <functional>

#include <palpate/kinematics/hand_geometry.h>

namespace palpate {

// Depth of a point behind the surface of a matrix, along its normal [mm]; 0 when the point is in
// front of it, beside the pad, or too deep to be in contact with this pad.
double depthBehindPad(const GeometryDescription& hand,
                      const HandPose& pose,
                      std::size_t matrix,
                      const Eigen::Vector3d& pointMm);

// Calls `touch` for every taxel (matrix, y, x) that overlaps with a pad of another finger, with the
// depth of the overlap [mm].
void findPadContacts(
    const HandPose& pose,
    const std::function<void(std::size_t matrix, int y, int x, double depthMm)>& touch);

}  // namespace palpate
