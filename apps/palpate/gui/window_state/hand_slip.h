// How the contact on a matrix moved recently, drawn as arrows on the hand in 3-D.
#pragma once

#include <cstddef>
#include <optional>

namespace palpate::gui {

// Lengths in taxels: x to the right, y down.
struct HandSlip {
  std::size_t matrix = 0;
  // Position of the contact.
  double x = 0.0;
  double y = 0.0;
  // Displacement of the contact.
  double dx = 0.0;
  double dy = 0.0;
  // Rotation [deg], clockwise on the screen.
  std::optional<double> turnDeg = {};
  bool slipping = false;
  bool operator==(const HandSlip&) const = default;
};

}  // namespace palpate::gui
