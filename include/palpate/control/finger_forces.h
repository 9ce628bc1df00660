// Normal force of each finger in each frame [N], by a calibration: the sum of the forces of its
// matrices (calibration/pressure_map.h). A grasp with a limit in newtons depends on it. Creep is
// not removed: it makes a lasting contact read more than it is, so that a limit is reached rather
// too early than too late.
#pragma once

#include <span>
#include <vector>

#include <palpate/calibration/pressure_map.h>
#include <palpate/device/device.h>
#include <palpate/model/hand_description.h>

namespace palpate {

// Number of fingers that carry a matrix of this hand: the largest finger index, plus 1.
std::size_t numFingers(const HandDescription& hand);

class FingerForces {
 public:
  // `settings` of the matrices as reported by the controller; with another number than that of the
  // matrices those of the calibration are assumed. Throws std::invalid_argument: a calibration
  // without P(K, T), or of another hand; a sensitivity of 0.
  FingerForces(const Calibration& calibration,
               const HandDescription& hand,
               const std::vector<MatrixSettings>& settings);

  // Takes the next frame. `degC` as in PressureMap::apply(). Throws std::invalid_argument unless
  // the frame has the hand's layout.
  void apply(const TactileFrame& frame, std::span<const double> degC);
  // Of the newest frame, one per finger [N], >= 0; 0 before the first frame.
  const std::vector<double>& forcesN() const noexcept { return forcesN_; }
  // The largest force that a finger can be measured to have: every scanned taxel of its matrices
  // saturated [N].
  double largestN(std::size_t finger) const { return largestN_.at(finger); }

 private:
  std::vector<std::size_t> fingers_;  // per matrix
  PressureMap map_;
  PressureFrame pressures_;
  std::vector<double> forcesN_;
  std::vector<double> largestN_;
};

}  // namespace palpate
