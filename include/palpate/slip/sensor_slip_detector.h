// Slip detector of a whole sensor: one SlipDetector per matrix, fed with whole frames.
// runSlipDetector() uses it for recordings.
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
  // For readings of a hand: each matrix has its own scale, see withScaleOf(). Throws
  // std::invalid_argument.
  explicit SensorSlipDetector(const HandDescription& hand, const SlipDetectorOptions& options = {});

  // Processes the next frame and the joint angles that belong to it (may be empty). Returns one
  // result per matrix, valid until the next call. Throws std::invalid_argument (another layout).
  const std::vector<SlipDetection>& update(const TactileFrame& frame,
                                           std::span<const double> jointsDeg = {});
  // The following apply to all matrices; see SlipDetector.
  void setReference();
  void clearReference();
  void reset();
  void setLoss() noexcept;
  void setOn(bool on) noexcept;

  const std::vector<SlipDetection>& last() const noexcept { return detections_; }
  // Whether any matrix slips.
  bool slipping() const noexcept;
  SlipDetector& matrix(std::size_t index) { return detectors_.at(index); }
  const SlipDetector& matrix(std::size_t index) const { return detectors_.at(index); }

 private:
  void collect();

  std::vector<SlipDetector> detectors_;
  std::vector<SlipDetection> detections_;
};

}  // namespace palpate
