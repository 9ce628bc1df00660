// Grasp preshapes: joint angles as a function of how far the hand is closed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpate {

// angle(c) = open + slope c [deg], close ratio c = 0 (open) .. 1 (closed).
struct PreshapeJoint {
  double openDeg = 0.0;
  double slopeDeg = 0.0;
};

struct Preshape {
  std::string name;                   // as on the command line: "pinch-parallel"
  std::string title;                  // for people: "Pinch, parallel fingertips"
  std::vector<PreshapeJoint> joints;  // one per axis

  // Joint angles [deg]. Throws std::invalid_argument when the ratio is not in 0..1.
  std::vector<double> anglesDeg(double closeRatio) const;
};

// The SDH-2's: parallel, cylindrical, centrical, spherical, pinch-parallel, pinch-tilted,
// pinch-empty, calibration.
const std::vector<Preshape>& sdh2Preshapes();
// By name; throws std::invalid_argument naming them all.
const Preshape& sdh2Preshape(std::string_view name);

}  // namespace palpate
