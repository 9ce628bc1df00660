// Watches one matrix: how its contact moves, and whether that is slip.
//
// The motion is measured by one of the methods of SlipTracker, or by the method `contest`: the
// motion of `register`, multiplied by the score P(moved) of the reference frame and the present
// frame (slip_hypotheses.h), until slip is confirmed (P > 0.9 over 0.35 taxel in two frames, or an
// alarm). From then on the unscaled motion is reported, until the next reference. The alarm comes
// from the contest of three windows (slip_rule.h), whatever gives the vector; or, plain, from
// thresholds on the vector: |step| > 0.20 or |since reference| > 1.0 taxel along an axis, as the
// prior program had it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <palpate/slip/slip_motion.h>
#include <palpate/slip/slip_state.h>
#include <palpate/slip/slip_tracker.h>
#include <palpate/slip/slip_windows.h>

namespace palpate {

enum class SlipReference {
  kFirst,  // the first frame with an active taxel, kept whatever comes
  // A new reference for each contact: the first frame in which it is at rest, and again when it is
  // at rest after a slip.
  kWhenAtRest,
  kGiven,  // none until setReference()
};

struct SlipDetectorOptions {
  SlipMethod method = SlipMethod::kHypotheses;
  SlipReference reference = SlipReference::kWhenAtRest;
  bool hypothesisAlarm = true;  // false: plain thresholds
  SlipRuleOptions rule = {};    // its thresholds are the plain ones, too
  SlipWindowsOptions windows = {};
  SlipTrackerOptions tracker = {};  // `method` and `firstContactIsReference` are set from above

  void validate() const;  // throws std::invalid_argument naming the field
};

struct SlipDetection {
  SlipMotion motion;  // valid false: nothing is known of this frame's motion
  SlipIndicator lamp = SlipIndicator::kNotComputable;
  SlipState state = SlipState::kInvalid;
  // True from the alarm until the contact is at rest again; translation or, with the contest,
  // rotation.
  bool slipping = false;
  bool alarm = false;  // of this frame alone
  bool rotating = false;
  // Motion score of the window that decides in this frame; empty if no comparison was needed or
  // possible. `residual` is the smaller residual of both hypotheses.
  std::optional<double> pMoved;
  double residual = 0.0;
  double confidence = 0.0;    // in the state, 0..1: a score
  bool newReference = false;  // this frame became the reference by itself
};

class SlipDetector {
 public:
  // Throws std::invalid_argument.
  explicit SlipDetector(const MatrixLayout& layout, const SlipDetectorOptions& options = {});

  // The next frame; stamps ascending [us]. `jointsDeg`: the joint angles that belong to it, or
  // none. Throws std::invalid_argument for another size.
  const SlipDetection& update(const ConstMatrixMap& frame,
                              std::int64_t timeUs,
                              std::span<const double> jointsDeg = {});
  // The newest frame becomes the reference (without contact in it: the next one with contact).
  void setReference();
  void clearReference();
  void reset();
  // While off, it reports nothing but keeps its state up to date.
  void setOn(bool on) noexcept { on_ = on; }

  const SlipDetection& last() const noexcept { return verdict_; }
  // Whether the shape of the contact at the reference tells motion from a tilt of the load, per
  // axis.
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
  SlipTracker tracker_;
  SlipWindows windows_;
  SlipRule rule_;
  KeyFrame reference_;
  MotionSdInflation condition_;
  SlipDetection verdict_;
  std::optional<SlipHypothesisResult> referenceHypotheses_;
  bool on_ = true;
  bool hasReference_ = false;
  bool wantsReference_ = false;
  bool slipped_ = false;  // since the reference was taken
  int certain_ = 0;       // frames in which P was sure
  bool latched_ = false;
  int calm_ = 0;
  std::size_t rotationChecks_ = 0;
  double lastScoredX_ = 0.0, lastScoredY_ = 0.0;
  bool hasLastScored_ = false;
};

}  // namespace palpate
