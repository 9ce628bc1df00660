// How the contact of a matrix moved lately, for arrows on the hand.
#pragma once

#include <cstddef>
#include <optional>

namespace palpate::gui {

// In taxels: x right, y down.
struct HandSlip {
  std::size_t matrix = 0;
  double x = 0.0;  // where it is
  double y = 0.0;
  double dx = 0.0;  // what it moved by
  double dy = 0.0;
  std::optional<double> turnDeg = {};  // clockwise on the screen
  bool slipping = false;
  bool operator==(const HandSlip&) const = default;
};

}  // namespace palpate::gui
