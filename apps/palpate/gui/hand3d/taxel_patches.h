// Where each taxel lies in space: on the hand, or with all matrices laid flat side by side like the
// heat maps.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/hand_description.h>

namespace palpate::gui {

// One place of a matrix [mm].
struct TaxelPatch {
  std::array<Eigen::Vector3f, 4> cornersMm;  // counter-clockwise seen from outside
  Eigen::Vector3f centreMm;
  Eigen::Vector3f normal;
};

// One per place, matrix after matrix, row by row, as in a frame.
using TaxelPatches = std::vector<TaxelPatch>;
void patchesOnHand(const HandPose& pose, const SensorLayout& layout, TaxelPatches& out);
// Matrices as HandDescription::pictureColumn and pictureRow say, x right, y up, around the origin,
// facing z.
void patchesLaidFlat(const HandDescription& hand, TaxelPatches& out);

}  // namespace palpate::gui
