// A SlipDetector per matrix of a sensor, fed with whole frames.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/model/tactile_frame.h>
#include <palpate/slip/slip_detector.h>

namespace palpate {

class SensorSlipDetector {
 public:
  // Throws std::invalid_argument.
  explicit SensorSlipDetector(const SensorLayout& layout, const SlipDetectorOptions& options = {});

  // The next frame, and the joint angles that belong to it (or none); one verdict per matrix, valid
  // until the next call. Throws std::invalid_argument (another layout).
  const std::vector<SlipDetection>& update(const TactileFrame& frame,
                                           std::span<const double> jointsDeg = {});
  // Of all matrices, as SlipDetector.
  void setReference();
  void clearReference();
  void reset();
  void setOn(bool on) noexcept;

  const std::vector<SlipDetection>& last() const noexcept { return verdicts_; }
  bool slipping() const noexcept;  // any matrix
  SlipDetector& matrix(std::size_t index) { return detectors_.at(index); }
  const SlipDetector& matrix(std::size_t index) const { return detectors_.at(index); }

 private:
  void collect();

  std::vector<SlipDetector> detectors_;
  std::vector<SlipDetection> verdicts_;
};

}  // namespace palpate
