// Hands for the tests of streams, built in memory.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "palpate/model/hand_description.h"

namespace palpate::testing {

// Pads of `sizes` (rows, columns) without axes; counts up to 4095.
inline HandDescription padHand(const std::vector<std::pair<int, int>>& sizes) {
  std::vector<MatrixLayout> matrices;
  HandDescription hand;
  for (const auto& [rows, columns] : sizes) {
    matrices.push_back(MatrixLayout::full(rows, columns, 2.0));
    MatrixDescription described;
    described.shortName = std::to_string(hand.matrices.size());
    described.name = "pad " + described.shortName;
    hand.matrices.push_back(std::move(described));
  }
  hand.name = "test pad";
  hand.layout = std::make_shared<const SensorLayout>(std::move(matrices));
  return hand;
}

// One matrix of 2 x 2 places with a masked place (row 0, column 1), two axes, one temperature
// sensor.
inline HandDescription smallHand() {
  HandDescription hand = padHand({{2, 2}});
  MatrixLayout matrix = MatrixLayout::full(2, 2, 2.0);
  matrix.staticMask[1] = 0;
  matrix.dynamicMask[1] = 0;
  hand.layout = std::make_shared<const SensorLayout>(std::vector{matrix});
  hand.axes.resize(2);
  hand.temperatureSensors.resize(1);
  return hand;
}

}  // namespace palpate::testing
