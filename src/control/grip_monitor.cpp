#include "palpate/control/grip_monitor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr int kFramesInARow = 2;

SlipTrackerOptions trackerOptions(const GripMonitorOptions& options, const HandDescription& hand) {
  options.validate();
  SlipTrackerOptions tracker;
  tracker.method = options.method;
  tracker.firstContactIsReference = false;
  tracker.saturationCounts = static_cast<double>(hand.saturationCounts);
  return tracker;
}

void check(bool good, const char* field, double value) {
  if (!good)
    throw std::invalid_argument(std::string("GripMonitorOptions: ") + field + " is " +
                                numberText(value));
}

}  // namespace

void GripMonitorOptions::validate() const {
  check(stepTaxels > 0.0, "stepTaxels", stepTaxels);
  check(referenceTaxels > 0.0, "referenceTaxels", referenceTaxels);
  check(turnDeg > 0.0, "turnDeg", turnDeg);
  check(minTaxels >= 2, "minTaxels", minTaxels);
  check(minCounts >= 0.0, "minCounts", minCounts);
  check(minConfidence >= 0.0 && minConfidence <= 1.0, "minConfidence", minConfidence);
}

GripMonitor::GripMonitor(const HandDescription& hand, const GripMonitorOptions& options)
    : hand_(hand),
      options_(options),
      tracker_(*hand.layout, trackerOptions(options, hand)),
      fast_(hand.layout->numMatrices(), 0) {}

void GripMonitor::onFrame(const TactileFrame& frame) {
  sum_ = 0.0;
  const auto& motions = tracker_.update(frame);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const SlipMotion& motion = motions[m];
    sum_ += motion.sum;
    const bool counts = motion.active >= options_.minTaxels && motion.sum >= options_.minCounts &&
                        motion.confidence >= options_.minConfidence;
    const bool fast =
        counts && motion.valid && std::hypot(motion.dx, motion.dy) > options_.stepTaxels;
    fast_[m] = fast ? fast_[m] + 1 : 0;
  }
}

void GripMonitor::setReference() {
  tracker_.setReference();
  std::fill(fast_.begin(), fast_.end(), 0);
  referenced_ = true;
}

void GripMonitor::reset() {
  tracker_.reset();
  std::fill(fast_.begin(), fast_.end(), 0);
  referenced_ = false;
  sum_ = 0.0;
}

std::optional<GripSlip> GripMonitor::slip() const {
  if (!referenced_) return std::nullopt;
  std::optional<GripSlip> most;
  double worst = 1.0;  // relative to its limit
  const auto& motions = tracker_.last();
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const SlipMotion& motion = motions[m];
    if (motion.active < options_.minTaxels || motion.sum < options_.minCounts ||
        motion.confidence < options_.minConfidence)
      continue;
    const auto consider = [&](double value, double threshold, const std::string& what) {
      if (value <= worst * threshold) return;
      worst = value / threshold;
      most = GripSlip{m, motion, hand_.matrixName(m) + ": " + fixedText(value, 2) + what};
    };
    if (fast_[m] >= kFramesInARow)
      consider(std::hypot(motion.dx, motion.dy), options_.stepTaxels, " taxels in a frame");
    if (motion.refValid)
      consider(std::hypot(motion.refDx, motion.refDy),
               options_.referenceTaxels,
               " taxels since the reference");
    if (motion.rotation.refValid)
      consider(std::abs(motion.rotation.refRotationDeg),
               options_.turnDeg,
               " degrees since the reference");
  }
  return most;
}

}  // namespace palpate
