#include "palpate/model/hand_description.h"

#include <cmath>

namespace palpate {
namespace {

// Rows and columns of the two kinds of DSA matrices, and their pitch.
constexpr int kProximalRows = 14;
constexpr int kDistalRows = 13;
constexpr int kColumns = 6;
constexpr double kPitchMm = 3.4;
constexpr int kCutCornerRows = 5;  // rows of a fingertip that lack their first and last taxel

std::shared_ptr<const SensorLayout> sdh2Layout() {
  const MatrixLayout proximal = MatrixLayout::full(kProximalRows, kColumns, kPitchMm);
  MatrixLayout distal = MatrixLayout::full(kDistalRows, kColumns, kPitchMm);
  for (int y = 0; y < kCutCornerRows; ++y) {
    distal.staticMask[static_cast<std::size_t>(y * kColumns)] = 0;
    distal.staticMask[static_cast<std::size_t>(y * kColumns + kColumns - 1)] = 0;
  }
  return std::make_shared<SensorLayout>(
      std::vector<MatrixLayout>{proximal, distal, proximal, distal, proximal, distal});
}

MatrixDescription fingerMatrix(int finger, const std::string& segment) {
  const std::string number = std::to_string(finger);
  return {"finger " + number + " " + segment,
          number + " " + segment,
          finger,
          segment,
          finger,
          segment == "distal" ? 0 : 1,
          std::nullopt};
}

HandDescription handDescriptionMakeSdh2() {
  HandDescription hand;
  hand.name = "SCHUNK SDH-2 with Weiss Robotics DSA";
  hand.layout = sdh2Layout();
  for (int finger = 0; finger < 3; ++finger) {
    hand.matrices.push_back(fingerMatrix(finger, "proximal"));
    hand.matrices.push_back(fingerMatrix(finger, "distal"));
  }
  // The motor in the joint below matrix m drives axis m + 1 (study, 3.4).
  for (std::size_t m = 0; m < hand.matrices.size(); ++m) hand.matrices[m].temperatureSensor = m + 1;
  // Velocities and accelerations are the controller's answers to vlim and alim (SDH-2 firmware
  // 0.0.3.3).
  hand.axes = {{"fingers 0 and 2 base", 0.0, 90.0, 83.0, 5000.0},
               {"finger 0 proximal", -90.0, 90.0, 140.0, 400.0},
               {"finger 0 distal", -90.0, 90.0, 200.0, 1500.0},
               {"finger 1 proximal", -90.0, 90.0, 140.0, 400.0},
               {"finger 1 distal", -90.0, 90.0, 200.0, 1500.0},
               {"finger 2 proximal", -90.0, 90.0, 140.0, 400.0},
               {"finger 2 distal", -90.0, 90.0, 200.0, 1500.0}};
  for (std::size_t axis = 0; axis < hand.axes.size(); ++axis)
    hand.temperatureSensors.push_back({"motor " + std::to_string(axis)});
  hand.temperatureSensors.push_back({"FPGA"});
  hand.temperatureSensors.push_back({"circuit board"});
  hand.maximumCounts = kSdh2FullScaleCounts;
  hand.saturationCounts = kSdh2SaturationCounts;
  return hand;
}

bool sameSizes(const SensorLayout& a, const SensorLayout& b) {
  if (a.numMatrices() != b.numMatrices()) return false;
  for (std::size_t i = 0; i < a.numMatrices(); ++i)
    if (a.matrix(i).rows != b.matrix(i).rows || a.matrix(i).columns != b.matrix(i).columns)
      return false;
  return true;
}

}  // namespace

std::string HandDescription::matrixName(std::size_t matrix) const {
  return matrix < matrices.size() ? matrices[matrix].name : "matrix " + std::to_string(matrix);
}

const HandDescription& sdh2() {
  static const HandDescription hand = handDescriptionMakeSdh2();
  return hand;
}

HandDescription describeHand(const SensorLayout& layout,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors) {
  HandDescription hand;
  if (sameSizes(layout, *sdh2().layout)) {
    hand = sdh2();
  } else {
    hand.name = "unknown sensor";
    // Use a grid that is as square as possible, filled row by row.
    const auto count = static_cast<int>(layout.numMatrices());
    const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i);
      hand.matrices.push_back({"matrix " + number, number, i, "", i % columns, i / columns});
    }
  }
  hand.layout = std::make_shared<SensorLayout>(layout);
  if (numAxes != 0 && numAxes != hand.axes.size()) {
    hand.axes.clear();
    for (std::size_t i = 0; i < numAxes; ++i)
      hand.axes.push_back({"axis " + std::to_string(i), -180.0, 180.0});
  }
  if (numTemperatureSensors != 0 && numTemperatureSensors != hand.temperatureSensors.size()) {
    hand.temperatureSensors.clear();
    for (MatrixDescription& matrix : hand.matrices) matrix.temperatureSensor.reset();
    for (std::size_t i = 0; i < numTemperatureSensors; ++i)
      hand.temperatureSensors.push_back({"sensor " + std::to_string(i)});
  }
  return hand;
}

}  // namespace palpate
