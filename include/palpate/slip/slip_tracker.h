// Follows the contact on one matrix over a stream of frames with one of the slip methods (all but
// `contest`, which SlipDetector adds).
//
// The reference is the first frame with an active taxel until another one is set. It is kept when
// contact is lost; SlipMotion::touched marks a new contact. Memory is allocated in the constructor,
// none per frame.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <palpate/model/gap_detector.h>
#include <palpate/model/hand_description.h>
#include <palpate/slip/learned_surface.h>
#include <palpate/slip/most_probable_surface.h>
#include <palpate/slip/slip_method.h>
#include <palpate/slip/slip_motion.h>

namespace palpate {

struct SlipTrackerOptions {
  // Any method but kContest.
  SlipMethod method = SlipMethod::kCentroid;
  // Whether the first frame with contact becomes the reference; if false, there is none until
  // setReference().
  bool firstContactIsReference = true;
  // A taxel at or above this value is saturated [counts], > 0; infinity: none is.
  double saturationCounts = std::numeric_limits<double>::infinity();
  // ncc, phase: largest step that is searched for [taxels], 1..8.
  int maxStepTaxels = 4;
  RotationOptions rotation = {};
  RegistrationOptions registration = {.noiseCounts = 5.0, .relativeError = 0.001};
  // register: of strong contacts that end inside the matrix (contact_ends.h), and of all others.
  MostProbableSurfaceOptions probableSurface = {};
  LearnedSurfaceOptions surface = {};

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// One method to measure translation; defined in src/slip/translation_method.h.
class TranslationMethod;

class SlipTracker {
 public:
  // Throws std::invalid_argument.
  explicit SlipTracker(const MatrixLayout& layout, const SlipTrackerOptions& options = {});
  ~SlipTracker();
  SlipTracker(SlipTracker&&) noexcept;
  SlipTracker& operator=(SlipTracker&&) noexcept;

  // Processes the next frame of the matrix. afterGap: frames are missing before it; there is then
  // no step. Throws std::invalid_argument when the frame has another size.
  const SlipMotion& update(const ConstMatrixMap& frame, bool afterGap = false);
  // Makes the newest frame the reference; if it has no contact, the next frame with contact.
  void setReference();
  void clearReference();
  // Returns to the state after construction.
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

// Slip tracker of a whole sensor: one SlipTracker per matrix. It detects gaps from the time stamps
// (intervals longer than max(1 s, 5 median intervals)).
class SensorSlipTracker {
 public:
  // Throws std::invalid_argument.
  explicit SensorSlipTracker(const SensorLayout& layout, const SlipTrackerOptions& options = {});

  // Processes the next frame and returns one motion per matrix, valid until the next call. Throws
  // std::invalid_argument (another layout).
  const std::vector<SlipMotion>& update(const TactileFrame& frame);
  void setReference();
  void reset();
  const std::vector<SlipMotion>& last() const noexcept { return motions_; }

 private:
  std::vector<SlipTracker> trackers_;
  std::vector<SlipMotion> motions_;
  GapDetector gaps_;
};

}  // namespace palpate
