// A hand as data: its sensor matrices, axes and temperature sensors. Algorithms know none of these
// numbers; another hand, or a single pad, is another description.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/model/matrix_layout.h>

namespace palpate {

// Readings of an SDH-2's tactile sensor [counts]. The converter has 12 bits, but the amplifier ends
// before: the largest reading in 1052 recordings is 3567.
constexpr float kSdh2FullScaleCounts = 4095.0F;
// Value that readings approach at high pressure [counts].
constexpr float kSdh2LargestCounts = 3560.0F;
// A taxel at or above this value [counts] is saturated: its reading is only a lower bound of the
// load.
constexpr float kSdh2SaturationCounts = 3500.0F;

struct MatrixDescription {
  std::string name;       // "finger 0 distal"
  std::string shortName;  // "0 distal"
  int finger = 0;         // finger it sits on
  std::string segment;    // "proximal", "distal"; empty for a pad
  // Where a picture of the whole sensor draws it: column and row of a grid, fingertips on top.
  int pictureColumn = 0;
  int pictureRow = 0;
  // The temperature sensor nearest to it (index into temperatureSensors); nothing: none is known to
  // be near.
  std::optional<std::size_t> temperatureSensor = std::nullopt;
};

struct AxisDescription {
  std::string name;         // "finger 1 proximal"
  double minimumDeg = 0.0;  // range of motion [deg]
  double maximumDeg = 0.0;
  double maximumVelocityDegPerS = 0.0;       // as the controller's firmware allows [deg/s]
  double maximumAccelerationDegPerS2 = 0.0;  // [deg/s^2]
};

struct TemperatureSensorDescription {
  std::string name;  // "motor 0", "FPGA", "circuit board"
};

struct HandDescription {
  std::string name;                            // "SCHUNK SDH-2 with Weiss DSA"
  std::shared_ptr<const SensorLayout> layout;  // never null
  std::vector<MatrixDescription> matrices;     // one per matrix of the layout
  std::vector<AxisDescription> axes;
  std::vector<TemperatureSensorDescription> temperatureSensors;
  float maximumCounts = 4095.0F;  // full scale of the converter [counts]
  // A taxel at or above is saturated [counts]. Everything that asks for saturation asks here.
  float saturationCounts = 4095.0F;

  // "finger 0 distal", or "matrix 7" where the description has no such matrix.
  std::string matrixName(std::size_t matrix) const;
};

// The SDH-2 with its six DSA matrices: 14x6 proximal (0, 2, 4), 13x6 distal (1, 3, 5), 3.4 mm, 12
// bit. Sources: .dsa survey of 1052 recordings; SDH-2 manual for the axis ranges.
const HandDescription& sdh2();

// A description for a layout that was found in a file. The SDH-2's, when sizes agree (with the
// file's own masks and pitch); otherwise matrices are named by number and drawn side by side.
HandDescription describeHand(const SensorLayout& layout,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors);

}  // namespace palpate
