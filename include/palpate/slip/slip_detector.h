// Slip detector of one matrix: it measures how the contact moves and decides whether that is slip.
// The live slip stage and SlipRun use one per matrix.
//
// The motion is measured by one of the methods of SlipTracker, or by the method `contest`: the
// motion of `register`, multiplied by the score P(moved) of the reference frame and the present
// frame (slip_hypotheses.h), until slip is confirmed (P > 0.9 over 0.35 taxel in two frames, or an
// alarm). From then on the unscaled motion is reported, until the next reference.
// The alarm doesn't depend on the method of the motion. It comes from comparing the hypotheses over
// three windows (slip_rule.h), or, with plain thresholds, from the motion: |step| > 0.20 or |motion
// since the reference| > 1.0 taxel along an axis, as in the prior program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/slip/slip_motion.h>
#include <palpate/slip/slip_state.h>
#include <palpate/slip/slip_tracker.h>
#include <palpate/slip/slip_windows.h>

namespace palpate {

// Which frame is the reference of the motion.
enum class SlipReference {
  // The first frame with an active taxel; it stays the reference.
  kFirst,
  // A new reference for each contact: the first frame in which it is at rest, and again when it is
  // at rest after a slip.
  kWhenAtRest,
  // There is no reference until setReference() is called.
  kGiven,
};

struct SlipDetectorOptions {
  SlipMethod method = SlipMethod::kContest;
  SlipReference reference = SlipReference::kWhenAtRest;
  // Whether the alarm comes from the hypotheses (slip_rule.h); false: from plain thresholds.
  bool hypothesisAlarm = true;
  // Its stepTaxels, referenceTaxels and rotationDeg are the plain thresholds, too.
  SlipRuleOptions rule = {};
  SlipWindowsOptions windows = {};
  // `method` and `firstContactIsReference` are overwritten by the options above.
  SlipTrackerOptions tracker = {};
  // Readings are multiplied by this before anything is computed of them, > 0: limits and standard
  // deviations of slip detection are in counts of 12 bits. See withScaleOf().
  double countsScale = 1.0;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Returns the options for readings of a matrix of a hand: countsScale brings its full scale to
// 4095, and its saturation is that of all registrations.
SlipDetectorOptions withScaleOf(const HandDescription& hand,
                                std::size_t matrix,
                                SlipDetectorOptions options);

// Result of one frame of one matrix.
struct SlipDetection {
  // If `motion.valid` is false, the motion in this frame is not known.
  SlipMotion motion;
  SlipIndicator indicator = SlipIndicator::kNotComputable;
  SlipState state = SlipState::kInvalid;
  // True from an alarm of translation until the contact is at rest again; with the hypotheses, an
  // alarm of rotation counts as well.
  bool slipping = false;
  // Whether this frame raised the alarm.
  bool alarm = false;
  bool rotating = false;
  // Motion score of the window that decides in this frame; empty if no comparison was needed or
  // possible. `residual` is the smaller residual of both hypotheses.
  std::optional<double> pMoved;
  double residual = 0.0;
  // Confidence in the state: a score, 0..1.
  double confidence = 0.0;
  // Whether the detector made this frame the reference by itself.
  bool newReference = false;
};

class SlipDetector {
 public:
  // Throws std::invalid_argument.
  explicit SlipDetector(const MatrixLayout& layout, const SlipDetectorOptions& options = {});

  // Processes the next frame; time stamps must ascend [us]. `jointsDeg` are the joint angles that
  // belong to the frame, or empty. Throws std::invalid_argument when the frame has another size.
  const SlipDetection& update(const ConstMatrixMap& frame,
                              std::int64_t timeUs,
                              std::span<const double> jointsDeg = {});
  // Makes the newest frame the reference; if it has no contact, the next frame with contact.
  void setReference();
  void clearReference();
  void reset();
  // Frames before the next one are lost: there is a gap, however short it is.
  void setLoss() noexcept { windows_.setLoss(); }

  const SlipDetection& last() const noexcept { return detection_; }
  // Whether the shape of the contact at the reference allows motion to be distinguished from a tilt
  // of the load, per axis.
  const MotionSdInflation& condition() const noexcept { return condition_; }
  const SlipDetectorOptions& options() const noexcept { return options_; }

 private:
  void applyMotionScore(const SlipMotion& moved);
  void decideByHypotheses(const SlipEvidence& evidence);
  void decideByThresholds();
  void latchAlarm(bool raised, bool calm);
  bool isAtRest(const SlipEvidence& evidence) const;
  bool updateReference();

  MatrixLayout layout_;
  SlipDetectorOptions options_;
  // The newest frame, multiplied by countsScale.
  MatrixValues scaled_;
  SlipTracker tracker_;
  SlipWindows windows_;
  SlipRule rule_;
  KeyFrame reference_;
  MotionSdInflation condition_;
  SlipDetection detection_;
  std::optional<SlipHypothesisResult> referenceHypotheses_;
  bool hasReference_ = false;
  bool wantsReference_ = false;
  // Whether the contact slipped since the reference was taken.
  bool slipped_ = false;
  // Number of frames in which P was sure.
  int certain_ = 0;
  bool latched_ = false;
  int calm_ = 0;
  std::size_t rotationChecks_ = 0;
  double lastScoredX_ = 0.0, lastScoredY_ = 0.0;
  bool hasLastScored_ = false;
};

// Returns a detector per matrix of a hand, with the scale and masks of that matrix. Throws
// std::invalid_argument.
std::vector<SlipDetector> slipDetectors(const HandDescription& hand,
                                        const SlipDetectorOptions& options = {});

}  // namespace palpate
