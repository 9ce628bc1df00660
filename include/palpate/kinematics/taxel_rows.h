// Where the taxels of a hand are in space, as a result table.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/result_table.h>
#include <palpate/kinematics/hand_pose.h>
#include <palpate/model/matrix_layout.h>

namespace palpate {

struct PlacedTaxel {
  std::size_t matrix = 0;
  double x = 0.0, y = 0.0;  // column and row, of a point between taxels with a fraction
  Eigen::Vector3d positionMm = Eigen::Vector3d::Zero();  // in the hand's base frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();      // outwards, a unit vector
  bool exists = false;
};

// The places of all taxels, or of those of one matrix, in wire order.
std::vector<PlacedTaxel> taxelPlaces(const HandPose& pose,
                                    const SensorLayout& layout,
                                    std::optional<std::size_t> matrix = {});
// The table "kinematics".
std::unique_ptr<ResultTable> taxelTable(std::vector<PlacedTaxel> places);

}  // namespace palpate
