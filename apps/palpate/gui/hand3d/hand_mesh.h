// Builds the bodies of a hand: the shapes that its URDF gives to links, and simple shapes (palm,
// knuckles, links with their sensor surface) for a hand without any.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include <palpate/emulator/shape.h>
#include <palpate/kinematics/hand_geometry.h>

namespace palpate::gui {

enum class HandBodyRole { kPalm, kKnuckle, kLink };

// A rigid body, in the frame of a link [mm] or in the hand's base frame.
struct HandBody {
  struct Corner {
    Eigen::Vector3f atMm;
    // Points out of the body.
    Eigen::Vector3f normal;
  };
  HandBodyRole role = HandBodyRole::kLink;
  // What the body is fixed to.
  LinkPlace place;
  // Three corners per triangle, counter-clockwise seen from outside.
  std::vector<Corner> triangles;
  // Edges for the wire frame.
  std::vector<std::pair<Eigen::Vector3f, Eigen::Vector3f>> edges;
};

// In the place of a mesh that can't be read the link is a box; `palpate hands check` says why.
std::vector<HandBody> handBodies(const HandGeometry& geometry);

// The surface of an object, in its own frame.
std::vector<HandBody::Corner> trianglesOf(const Shape& shape);

// Appends a convex outline (counter-clockwise, x right, y up), extruded from zMin to zMax, its rims
// chamfered by `chamferMm`.
void appendExtrusion(HandBody& body,
                     const std::vector<Eigen::Vector2d>& outlineMm,
                     double zMinMm,
                     double zMaxMm,
                     double chamferMm);
// The convex hull of the points, counter-clockwise.
std::vector<Eigen::Vector2d> convexOutline(std::vector<Eigen::Vector2d> pointsMm);

}  // namespace palpate::gui
