#include "palpate/slip/sensor_slip_detector.h"

#include <algorithm>
#include <stdexcept>

namespace palpate {

SensorSlipDetector::SensorSlipDetector(const SensorLayout& layout,
                                       const SlipDetectorOptions& options)
    : detections_(layout.numMatrices()) {
  detectors_.reserve(layout.numMatrices());
  for (const MatrixLayout& matrix : layout.matrices()) detectors_.emplace_back(matrix, options);
}

SensorSlipDetector::SensorSlipDetector(const HandDescription& hand,
                                       const SlipDetectorOptions& options)
    : detections_(hand.layout->numMatrices()) {
  detectors_.reserve(detections_.size());
  for (std::size_t m = 0; m < detections_.size(); ++m)
    detectors_.emplace_back(hand.layout->matrix(m), withScaleOf(hand, m, options));
}

const std::vector<SlipDetection>& SensorSlipDetector::update(const TactileFrame& frame,
                                                             std::span<const double> jointsDeg) {
  if (!frame.layout || frame.layout->numMatrices() != detectors_.size())
    throw std::invalid_argument("SensorSlipDetector: the frame has a different layout");
  for (std::size_t m = 0; m < detectors_.size(); ++m)
    detections_[m] = detectors_[m].update(frame.matrix(m), frame.hostUs, jointsDeg);
  return detections_;
}

void SensorSlipDetector::collect() {
  for (std::size_t m = 0; m < detectors_.size(); ++m) detections_[m] = detectors_[m].last();
}

void SensorSlipDetector::setReference() {
  for (SlipDetector& detector : detectors_) detector.setReference();
  collect();
}

void SensorSlipDetector::clearReference() {
  for (SlipDetector& detector : detectors_) detector.clearReference();
  collect();
}

void SensorSlipDetector::reset() {
  for (SlipDetector& detector : detectors_) detector.reset();
  collect();
}

void SensorSlipDetector::setLoss() noexcept {
  for (SlipDetector& detector : detectors_) detector.setLoss();
}

void SensorSlipDetector::setOn(bool on) noexcept {
  for (SlipDetector& detector : detectors_) detector.setOn(on);
}

bool SensorSlipDetector::slipping() const noexcept {
  return std::any_of(detections_.begin(), detections_.end(), [](const SlipDetection& one) {
    return one.slipping;
  });
}

}  // namespace palpate
