#include "palpate/control/finger_forces.h"

#include <algorithm>
#include <stdexcept>

namespace palpate {
namespace {

constexpr double kNewtonsPerKpaMm2 = 1e-3;

PressureMapOptions mapOptions(const std::vector<MatrixSettings>& settings, std::size_t matrices) {
  PressureMapOptions options;
  options.compensateDrift = false;
  if (settings.size() == matrices)
    for (const MatrixSettings& matrix : settings)
      options.settings.push_back(
          {matrix.sensitivity, static_cast<double>(matrix.thresholdCounts), false});
  // PressureMap refuses a sensitivity of 0 only when it takes other settings.
  for (const SensorSettings& used : options.settings)
    if (!(used.sensitivity > 0.0))
      throw std::invalid_argument("a matrix has the sensitivity 0: its force can't be measured");
  return options;
}

const Calibration& fitting(const Calibration& calibration, const HandDescription& hand) {
  if (!calibration.pressure.valid()) throw std::invalid_argument("the calibration has no P(K, T)");
  if (!calibration.hand.empty() && calibration.hand != hand.name)
    throw std::invalid_argument("the calibration is for another hand: " + calibration.hand);
  return calibration;
}

}  // namespace

std::size_t numFingers(const HandDescription& hand) {
  std::size_t number = 0;
  for (const MatrixDescription& matrix : hand.matrices)
    if (matrix.finger >= 0) number = std::max(number, static_cast<std::size_t>(matrix.finger) + 1);
  return number;
}

FingerForces::FingerForces(const Calibration& calibration,
                           const HandDescription& hand,
                           const std::vector<MatrixSettings>& settings)
    : map_(fitting(calibration, hand), hand, mapOptions(settings, hand.layout->numMatrices())),
      forcesN_(numFingers(hand), 0.0),
      largestN_(numFingers(hand), 0.0) {
  const PressureModel& model = calibration.pressure;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
    const int finger = m < hand.matrices.size() ? hand.matrices[m].finger : -1;
    fingers_.push_back(finger < 0 ? SIZE_MAX : static_cast<std::size_t>(finger));
    if (fingers_.back() >= largestN_.size()) continue;
    const double ratio = settings.size() == hand.layout->numMatrices()
                             ? calibration.settings.sensitivity / settings[m].sensitivity
                             : 1.0;
    const MatrixLayout& layout = hand.layout->matrix(m);
    const double kpa =
        model.pressureAt(ratio * static_cast<double>(hand.saturationOf(m)), std::nullopt).kpa;
    largestN_[fingers_.back()] += kpa * static_cast<double>(layout.numEnabled()) *
                                  layout.taxelAreaMm2() * model.areaFraction * kNewtonsPerKpaMm2;
  }
}

void FingerForces::apply(const TactileFrame& frame, std::span<const double> degC) {
  map_.apply(frame, degC, pressures_);
  std::fill(forcesN_.begin(), forcesN_.end(), 0.0);
  for (std::size_t m = 0; m < std::min(pressures_.matrices.size(), fingers_.size()); ++m)
    if (fingers_[m] < forcesN_.size()) forcesN_[fingers_[m]] += pressures_.matrices[m].forceN;
}

}  // namespace palpate
