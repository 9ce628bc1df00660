#include "palpate/slip/slip_detector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

// Exponent of the odds of P(moved) when the reported motion is weighted.
constexpr double kReading = 2.0;
// MotionSdInflation above which P(moved) must be larger to have the same weight.
constexpr double kDoubtFrom = 3.0;
constexpr double kDoubt = 4.0;
constexpr double kSureP = 0.9;
constexpr double kSureTaxels = 0.35;
constexpr int kSureFrames = 2;
// Residual above which neither hypothesis is accepted.
constexpr double kModelInvalid = 60.0;
constexpr int kCalmFrames = 3;
// Fraction of the threshold of a window below which the contact counts as at rest.
constexpr double kCalmPart = 0.5;
// The same for a plain threshold.
constexpr double kPlainCalmPart = 0.8;
// See slip_rule.h.
constexpr double kSlipDetectorCentroidPart = 1.3;
// Frames between checks for rotation when there is no translation.
constexpr std::size_t kTurnLook = 3;
constexpr std::size_t kRestAge = 15;
constexpr double kRestTaxels = 0.1;
// Change of ln(load).
constexpr double kRestLoad = 0.05;
// Full scale of readings whose limits these are.
constexpr double kSlipFullScaleCounts = 4095.0;

SlipTrackerOptions trackerOptions(const SlipDetectorOptions& options) {
  SlipTrackerOptions tracker = options.tracker;
  tracker.method = options.method == SlipMethod::kContest ? SlipMethod::kRegister : options.method;
  tracker.firstContactIsReference = options.reference == SlipReference::kFirst;
  return tracker;
}

double slipDetectorShift(const WindowEvidence& window) {
  return std::hypot(window.centroidX, window.centroidY);
}

}  // namespace

void SlipDetectorOptions::validate() const {
  rule.validate();
  windows.validate();
  trackerOptions(*this).validate();
  if (!(countsScale > 0.0 && std::isfinite(countsScale)))
    throw std::invalid_argument("SlipDetectorOptions: countsScale is " +
                                std::to_string(countsScale));
}

SlipDetectorOptions withScaleOf(const HandDescription& hand,
                                std::size_t matrix,
                                SlipDetectorOptions options) {
  options.countsScale = kSlipFullScaleCounts / static_cast<double>(hand.maximumOf(matrix));
  const double saturation = static_cast<double>(hand.saturationOf(matrix)) * options.countsScale;
  options.tracker.saturationCounts = saturation;
  options.windows.hypotheses.registration.saturationCounts = saturation;
  return options;
}

SlipDetector::SlipDetector(const MatrixLayout& layout, const SlipDetectorOptions& options)
    : layout_(layout),
      options_(options),
      tracker_(layout, trackerOptions(options)),
      windows_(layout, options.windows),
      rule_(options.rule),
      reference_(layout) {
  reset();
}

void SlipDetector::reset() {
  clearReference();
  // Last, because it may then wait for its first contact.
  tracker_.reset();
  windows_.reset();
  rule_.reset();
  detection_ = {};
  wantsReference_ = options_.reference == SlipReference::kFirst;
  calm_ = 0;
  rotationChecks_ = 0;
}

void SlipDetector::clearReference() {
  tracker_.clearReference();
  reference_.clear();
  condition_ = {.x = kUnboundedMotionSdInflation, .y = kUnboundedMotionSdInflation};
  referenceHypotheses_.reset();
  hasReference_ = wantsReference_ = slipped_ = latched_ = hasLastScored_ = false;
  certain_ = 0;
}

void SlipDetector::setReference() {
  clearReference();
  tracker_.setReference();
  wantsReference_ = !updateReference();
}

// Makes the present frame the reference of the hypotheses. Returns false if it has no contact.
bool SlipDetector::updateReference() {
  if (!reference_.set(windows_.frame())) return false;
  hasReference_ = true;
  wantsReference_ = false;
  condition_ = motionSdInflation(reference_, options_.windows.hypotheses.registration);
  return true;
}

const SlipDetection& SlipDetector::update(const ConstMatrixMap& given,
                                          std::int64_t timeUs,
                                          std::span<const double> jointsDeg) {
  const bool isScaled = options_.countsScale != 1.0;
  if (isScaled) scaled_ = static_cast<float>(options_.countsScale) * given;
  const ConstMatrixMap frame =
      isScaled ? ConstMatrixMap(scaled_.data(), scaled_.rows(), scaled_.cols()) : given;
  const SlipEvidence& evidence = windows_.add(frame, timeUs, jointsDeg);
  const bool wasSlipping = detection_.slipping;
  const SlipMotion motion = tracker_.update(windows_.frame(), windows_.afterGap());
  detection_ = {};
  detection_.motion = motion;
  detection_.slipping = wasSlipping;
  const bool lost = motion.active == 0 || motion.afterGap;
  if (lost && options_.reference == SlipReference::kWhenAtRest) clearReference();
  if (wantsReference_) updateReference();
  if (options_.method == SlipMethod::kContest) applyMotionScore(motion);
  if (options_.hypothesisAlarm)
    decideByHypotheses(evidence);
  else
    decideByThresholds();
  if (lost) detection_.slipping = false;
  if (detection_.slipping) slipped_ = true;
  if (options_.reference == SlipReference::kWhenAtRest && isAtRest(evidence)) {
    const bool again = slipped_;
    if (!hasReference_ || again) {
      setReference();
      detection_.newReference = true;
      detection_.motion.refValid = true;
      detection_.motion.refDx = detection_.motion.refDy = 0.0;
      hasLastScored_ = options_.method == SlipMethod::kContest;
      lastScoredX_ = lastScoredY_ = 0.0;
    }
  }
  detection_.motion.sum /= options_.countsScale;
  return detection_;
}

bool SlipDetector::isAtRest(const SlipEvidence& evidence) const {
  const WindowEvidence& middle = evidence.windows[kMiddleWindow];
  return evidence.computable && evidence.contactAge >= kRestAge && middle.filled &&
         !detection_.slipping && std::abs(middle.logLoadRatio) < kRestLoad &&
         slipDetectorShift(middle) < kRestTaxels;
}

// Scales the motion of `register` by the score of the comparison of reference and present frame.
void SlipDetector::applyMotionScore(const SlipMotion& moved) {
  referenceHypotheses_.reset();
  SlipMotion& motion = detection_.motion;
  if (!hasReference_ || !moved.refValid) {
    hasLastScored_ = false;
    return;
  }
  double weight = 1.0;
  if (!latched_) {
    double p = 1.0;
    const RigidMotion start{.dx = moved.refDx,
                            .dy = moved.refDy,
                            .angleDeg = moved.rotation.refValid ? moved.rotation.refRotationDeg : 0,
                            .gain = moved.sum / reference_.sum()};
    referenceHypotheses_ = compareSlipHypotheses(
        reference_, windows_.frame(), std::span(&start, 1), options_.windows.hypotheses);
    if (referenceHypotheses_->computed) {
      p = referenceHypotheses_->pMoved;
      // The less the shape distinguishes the hypotheses, the larger P(moved) must be.
      const double doubt = std::max(1.0, std::max(condition_.x, condition_.y) / kDoubtFrom);
      const double odds = std::pow(p / std::max(1.0 - p, 1e-9), kReading) / std::pow(doubt, kDoubt);
      weight = odds / (1.0 + odds);
    }
    const double shifted = kSlipDetectorCentroidPart * std::hypot(moved.x - reference_.centerX(),
                                                                  moved.y - reference_.centerY());
    const double sure = std::min(shifted, std::hypot(moved.refDx, moved.refDy));
    certain_ = p > kSureP && sure > kSureTaxels ? certain_ + 1 : 0;
    latched_ = certain_ >= kSureFrames;
    if (latched_) weight = 1.0;
  }
  // The standard deviations are those of the registration by itself.
  if (weight < 1.0) motion.sdX = motion.sdY = 0.0;
  motion.refDx = weight * moved.refDx;
  motion.refDy = weight * moved.refDy;
  if (motion.valid && hasLastScored_) {
    motion.dx = motion.refDx - lastScoredX_;
    motion.dy = motion.refDy - lastScoredY_;
  }
  lastScoredX_ = motion.refDx;
  lastScoredY_ = motion.refDy;
  hasLastScored_ = true;
}

void SlipDetector::latchAlarm(bool raised, bool calm) {
  detection_.alarm = raised;
  if (raised) {
    detection_.slipping = true;
    calm_ = 0;
  } else if (detection_.slipping) {
    calm_ = calm ? calm_ + 1 : 0;
    if (calm_ >= kCalmFrames) detection_.slipping = false;
  }
  detection_.indicator = detection_.slipping ? SlipIndicator::kSlipping : SlipIndicator::kReady;
}

void SlipDetector::decideByHypotheses(const SlipEvidence& seen) {
  const auto asked = rule_.windowToEvaluate(seen);
  const bool recent = rule_.needsRecent(seen);
  if (recent) windows_.evaluateRecent();
  if (asked && !(recent && *asked == kShortWindow))
    windows_.evaluateHypotheses(*asked);
  else if (!asked && rule_.mayDetectRotation(seen) && ++rotationChecks_ % kTurnLook == 0)
    windows_.evaluateHypotheses(kMiddleWindow);
  const SlipEvidence& evidence = windows_.evidence();
  const SlipRuleResult outcome = rule_.decide(evidence);
  if (!evidence.computable || (!outcome.leading && !outcome.alarm && !detection_.slipping)) {
    // The contact is too small, or too new for the windows and without an alarm.
    detection_.slipping = detection_.slipping && evidence.computable;
    detection_.state = SlipState::kInvalid;
    detection_.indicator = SlipIndicator::kNotComputable;
    return;
  }
  detection_.rotating = outcome.rotating;
  const bool calm = kSlipDetectorCentroidPart * slipDetectorShift(evidence.windows[kShortWindow]) <
                        kCalmPart * options_.rule.shortSteps * options_.rule.stepTaxels &&
                    kSlipDetectorCentroidPart * slipDetectorShift(evidence.windows[kMiddleWindow]) <
                        kCalmPart * options_.rule.middleSteps * options_.rule.stepTaxels;
  latchAlarm(outcome.alarm || outcome.rotating, calm);
  if (outcome.alarm && hasReference_) latched_ = true;

  const SlipHypothesisResult* deciding = asked ? &evidence.windows[*asked].hypotheses : nullptr;
  if (!deciding && referenceHypotheses_) deciding = &*referenceHypotheses_;
  if (deciding && deciding->computed) {
    detection_.pMoved = deciding->pMoved;
    detection_.residual = std::min(deciding->loadShiftResidual, deciding->motionResidual);
  }
  if (detection_.slipping) {
    detection_.state = SlipState::kSlip;
    detection_.confidence = std::max(0.5, detection_.pMoved.value_or(0.5));
  } else if (outcome.thresholdRatio < 1.0) {
    detection_.state = SlipState::kStill;
    detection_.confidence = 1.0 - 0.5 * outcome.thresholdRatio;
  } else if (outcome.allowedThresholdRatio < 1.0) {
    detection_.state = SlipState::kLoading;
    detection_.confidence = 1.0 - 0.5 * outcome.allowedThresholdRatio;
  } else if (!detection_.pMoved || detection_.residual > kModelInvalid) {
    detection_.state = SlipState::kInvalid;
  } else if (*detection_.pMoved < kMaxStillScore) {
    detection_.state = SlipState::kLoadShift;
    detection_.confidence = 1.0 - *detection_.pMoved;
  } else if (*detection_.pMoved > kMinMotionScore) {
    detection_.state = SlipState::kSlip;
    detection_.confidence = *detection_.pMoved;
  } else {
    detection_.state = SlipState::kAmbiguous;
    detection_.confidence = 0.5;
  }
}

void SlipDetector::decideByThresholds() {
  const SlipMotion& motion = detection_.motion;
  if (!motion.valid && !motion.refValid) {
    detection_.slipping = false;
    return;
  }
  const double step = std::max(std::abs(motion.dx), std::abs(motion.dy));
  const double whole = std::max(std::abs(motion.refDx), std::abs(motion.refDy));
  const double thresholdRatio =
      std::max(step / options_.rule.stepTaxels, whole / options_.rule.referenceTaxels);
  latchAlarm(thresholdRatio > 1.0, thresholdRatio < kPlainCalmPart);
  detection_.state = detection_.slipping ? SlipState::kSlip : SlipState::kStill;
  detection_.residual = motion.residual;
  detection_.confidence = motion.confidence;
}

std::vector<SlipDetector> slipDetectors(const HandDescription& hand,
                                        const SlipDetectorOptions& options) {
  std::vector<SlipDetector> detectors;
  detectors.reserve(hand.layout->numMatrices());
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
    detectors.emplace_back(hand.layout->matrix(m), withScaleOf(hand, m, options));
  return detectors;
}

}  // namespace palpate
