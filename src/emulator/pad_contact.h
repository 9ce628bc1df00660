// Pads that touch each other: fingers of an empty hand that is closed until they meet. Two rubber
// foundations in a row, so each gives way by half of how far the surfaces would overlap.
#pragma once

#include <cstddef>
#include <functional>

#include <palpate/kinematics/hand_geometry.h>

namespace palpate {

// How deep a point lies behind the surface of a matrix, along the normal there [mm]; 0: in front of
// it, beside the pad, or so deep that it can't be the pad that it met.
double depthBehindPad(const GeometryDescription& hand,
                      const HandPose& pose,
                      std::size_t matrix,
                      const Eigen::Vector3d& pointMm);

// Calls `touch` for every taxel (matrix, y, x) that overlaps with a pad of another finger, with the
// depth [mm].
void findPadContacts(
    const HandPose& pose,
    const std::function<void(std::size_t matrix, int y, int x, double depthMm)>& touch);

}  // namespace palpate
