// Computes where each taxel is in space: on the hand, or with all matrices laid flat side by side
// like the heat maps.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/hand_description.h>

namespace palpate::gui {

// The surface of one place of a matrix [mm].
struct TaxelPatch {
  // Counter-clockwise seen from outside.
  std::array<Eigen::Vector3f, 4> cornersMm;
  Eigen::Vector3f centreMm;
  Eigen::Vector3f normal;
  // Unit vectors along the surface, towards the next column and the next row.
  Eigen::Vector3f alongX, alongY;
};

// One per place, matrix after matrix, row by row, as in a frame.
using TaxelPatches = std::vector<TaxelPatch>;
void patchesOnHand(const HandPose& pose, const SensorLayout& layout, TaxelPatches& out);
// Arranges the matrices by HandDescription::pictureColumn and pictureRow, x right, y up, around the
// origin, facing z.
void patchesLaidFlat(const HandDescription& hand, TaxelPatches& out);

}  // namespace palpate::gui
