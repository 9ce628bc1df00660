// The bodies of a hand as simple shapes made from its geometry: palm, knuckles, links that carry
// their sensor surface. No third-party mesh: another hand is another GeometryDescription.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <palpate/kinematics/hand_geometry.h>

namespace palpate::gui {

enum class HandBodyRole { kPalm, kKnuckle, kLink };

// Moves as one. In the frame of a link [mm], or in the hand's base frame.
struct HandBody {
  struct Corner {
    Eigen::Vector3f atMm;
    Eigen::Vector3f normal;  // out of the body
  };
  HandBodyRole role = HandBodyRole::kLink;
  std::size_t finger = 0;
  std::optional<std::size_t> link;  // nothing: fixed to the palm
  std::vector<Corner> triangles;    // three each, counter-clockwise seen from outside
  std::vector<std::pair<Eigen::Vector3f, Eigen::Vector3f>> edges;  // for a wire frame
};

std::vector<HandBody> handBodies(const HandGeometry& geometry);

// A convex outline (counter-clockwise, x right, y up), drawn out from zMin to zMax, its rims cut by
// `chamferMm`.
void appendExtrusion(HandBody& body,
                     const std::vector<Eigen::Vector2d>& outlineMm,
                     double zMinMm,
                     double zMaxMm,
                     double chamferMm);
// The smallest convex outline around points, counter-clockwise.
std::vector<Eigen::Vector2d> convexOutline(std::vector<Eigen::Vector2d> pointsMm);

}  // namespace palpate::gui
