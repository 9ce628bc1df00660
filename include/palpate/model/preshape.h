// Grasp preshapes: joint angles as a function of how far the hand is closed. The grasp commands and
// the emulated hand use them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// Angle of one joint: angle(c) = open + slope * c [deg], with the close ratio c = 0 (open) .. 1
// (closed).
struct PreshapeJoint {
  double openDeg = 0.0;
  double slopeDeg = 0.0;
};

// One preshape of a hand.
struct Preshape {
  std::string name;                   // name on the command line: "pinch-parallel"
  std::string title;                  // title in the window: "Pinch, parallel fingertips"
  std::vector<PreshapeJoint> joints;  // one per axis

  // Returns the joint angles [deg]. Throws std::invalid_argument when the ratio is not in 0..1.
  std::vector<double> anglesDeg(double closeRatio) const;
};

// Finds one of a hand's preshapes by its name. Throws std::invalid_argument that lists all names.
const Preshape& findPreshape(const std::vector<Preshape>& preshapes, std::string_view name);

}  // namespace palpate
