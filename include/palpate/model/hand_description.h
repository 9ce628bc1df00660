// Describes a hand as data: its sensor matrices, axes and temperature sensors. Every module takes
// these numbers from here, so that another hand, or a single pad, is only another description.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/model/matrix_layout.h>
#include <palpate/model/series.h>

namespace palpate {

struct TactileFrame;

// Name and position of one sensor matrix.
struct MatrixDescription {
  std::string name;       // "finger 0 distal"
  std::string shortName;  // "0 distal", for narrow places
  int finger = 0;         // the finger that the matrix is mounted on
  std::string segment;    // "proximal", "distal"; empty for a pad
  // Where a picture of the whole sensor draws the matrix: column and row of a grid with the
  // fingertips on top.
  int pictureColumn = 0;
  int pictureRow = 0;
  // The nearest temperature sensor (index into temperatureSensors); empty when none is known.
  std::optional<std::size_t> temperatureSensor = std::nullopt;
  // Full scale and saturation where they differ from those of the hand, in its unit. Code asks
  // HandDescription::maximumOf() and saturationOf().
  std::optional<float> maximumCounts = std::nullopt;
  std::optional<float> saturationCounts = std::nullopt;
};

// Name and limits of one axis. Lengths take the place of angles where the axis slides: `Deg` in a
// name then means millimetres, here and in Sample (isSliding).
struct AxisDescription {
  std::string name;         // "finger 1 proximal"
  double minimumDeg = 0.0;  // range of motion [deg]
  double maximumDeg = 0.0;
  double maximumVelocityDegPerS = 0.0;       // limit of the controller's firmware [deg/s]
  double maximumAccelerationDegPerS2 = 0.0;  // [deg/s^2]
  bool isSliding = false;                    // moves along a line: all values are in mm
  // Largest torque [N mm] (sliding: force [N]); 0 when it is not known.
  double maximumTorqueNmm = 0.0;

  const char* unit() const { return isSliding ? "mm" : "deg"; }
};

// Name of one temperature sensor.
struct TemperatureSensorDescription {
  std::string name;  // "motor 0", "FPGA", "circuit board"
};

struct HandFile;  // palpate/model/hand_file.h

// All properties of a hand that algorithms and displays need.
struct HandDescription {
  std::string name;                            // "SCHUNK SDH-2 with Weiss DSA"
  std::string maker = {};                      // "SCHUNK, Weiss Robotics"; may be empty
  std::shared_ptr<const SensorLayout> layout;  // never null
  std::vector<MatrixDescription> matrices;     // one per matrix of the layout
  std::vector<AxisDescription> axes;
  std::vector<TemperatureSensorDescription> temperatureSensors;
  // Full scale of the converter; the largest one where matrices differ (maximumOf).
  float maximumCounts = 4095.0F;
  // A taxel at or above this value [counts] is saturated, unless its matrix has a limit of its own
  // (saturationOf).
  float saturationCounts = 4095.0F;
  // Unit of the taxels' values: "counts", or a physical unit ("kPa", "N"). All matrices have the
  // same, since they share a scale of colours, an axis of values, and sums over all of them.
  std::string unit = "counts";
  // Preshapes, surfaces, sensor characteristics and the texts of the files that the description
  // was read from; null when it was not read from a file.
  std::shared_ptr<const HandFile> file = nullptr;

  // Returns for example "finger 0 distal", or "matrix 7" when the description has no such matrix.
  std::string matrixName(std::size_t matrix) const;
  // Full scale of a matrix, and the value from which on its taxels are saturated; those of the hand
  // when the description has no such matrix.
  float maximumOf(std::size_t matrix) const;
  float saturationOf(std::size_t matrix) const;
  // The values from which on taxels are saturated, as text: "3500", or "900 or 3500" where matrices
  // differ.
  std::string saturationText() const;
};

// Number of taxels of a frame of this hand that are saturated; 0 when the frame has another number
// of values than the layout.
std::size_t numSaturated(const HandDescription& hand, const TactileFrame& frame) noexcept;

// Whether two layouts have as many matrices, of the same rows and columns.
bool sameSizes(const SensorLayout& a, const SensorLayout& b);

// Returns the hand with axes and temperature sensors that are named by number where there are
// others than those of its description (0: not known, those of the description).
HandDescription withSeriesOf(HandDescription hand,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors);

// The series of the hand itself: kAngleSeries with a column per axis, kTemperatureSeries with one
// per sensor.
std::vector<SeriesDescription> seriesOf(const HandDescription& hand);

// The sizes of the matrices, equal ones counted: "3 x 14x6, 3 x 13x6" (rows x columns).
std::string sizesText(const SensorLayout& layout);

// Returns a description for a layout whose hand is not named: that of the built-in hand with a
// tactile controller (HandFile::controller) and the same sizes, with the masks and the pitch of the
// layout; otherwise matrices are named by number and drawn in a grid.
HandDescription describeHand(const SensorLayout& layout,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors);

}  // namespace palpate
