// Follows the contact on one matrix over a stream of frames, by any method but `contest`.
//
// The reference is the first frame with an active taxel until another is set; it outlives loss of
// contact (a flag says when contact is new). Memory is taken at construction, none per frame.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <palpate/model/gap_detector.h>
#include <palpate/model/hand_description.h>
#include <palpate/slip/learned_surface.h>
#include <palpate/slip/slip_method.h>
#include <palpate/slip/slip_motion.h>

namespace palpate {

struct SlipTrackerOptions {
  SlipMethod method = SlipMethod::kCentroid;  // not kHypotheses
  bool firstContactIsReference = true;        // else none until setReference()
  // A taxel at or above is saturated, > 0.
  double saturationCounts = static_cast<double>(kSdh2SaturationCounts);
  int maxStepTaxels = 4;  // ncc, phase: a step is looked for within, 1..8
  RotationOptions rotation = {};
  RegistrationOptions registration = {.noiseCounts = 5.0, .relativeError = 0.001};
  LearnedSurfaceOptions surface = {};

  void validate() const;  // throws std::invalid_argument naming the field
};

class TranslationMethod;  // one of the ways to measure: src/slip/translation_method.h

class SlipTracker {
 public:
  // Throws std::invalid_argument.
  explicit SlipTracker(const MatrixLayout& layout, const SlipTrackerOptions& options = {});
  ~SlipTracker();
  SlipTracker(SlipTracker&&) noexcept;
  SlipTracker& operator=(SlipTracker&&) noexcept;

  // The next frame of the matrix. afterGap: frames are missing before it; then there is no step.
  // Throws std::invalid_argument for another size.
  const SlipMotion& update(const ConstMatrixMap& frame, bool afterGap = false);
  // The newest frame becomes the reference; without contact in it, the next one that has contact.
  void setReference();
  void clearReference();
  // As new.
  void reset();

  const SlipMotion& last() const noexcept { return motion_; }
  const SlipTrackerOptions& options() const noexcept { return options_; }
  const MatrixLayout& layout() const noexcept { return layout_; }

 private:
  double unseenFraction(const ConstMatrixMap& frame);
  int minForReference() const noexcept;

  MatrixLayout layout_;
  SlipTrackerOptions options_;
  ContactOutline outline_;
  RotationTracker rotation_;
  std::unique_ptr<TranslationMethod> method_;
  SlipMotion motion_;
  bool wantsReference_ = true;
};

// A tracker per matrix of a sensor; knows by the stamps when frames are missing (longer than max(1
// s, 5 median intervals)).
class SensorSlipTracker {
 public:
  // Throws std::invalid_argument.
  explicit SensorSlipTracker(const SensorLayout& layout, const SlipTrackerOptions& options = {});

  // The next frame; one motion per matrix, valid until the next call. Throws std::invalid_argument
  // (another layout).
  const std::vector<SlipMotion>& update(const TactileFrame& frame);
  void setReference();
  void clearReference();
  void reset();
  SlipTracker& tracker(std::size_t matrix) { return trackers_.at(matrix); }
  const std::vector<SlipMotion>& last() const noexcept { return motions_; }

 private:
  std::vector<SlipTracker> trackers_;
  std::vector<SlipMotion> motions_;
  GapDetector gaps_;
};

}  // namespace palpate
