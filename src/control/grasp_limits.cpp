// What is checked before a grasp begins, and readings beside their limits.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "palpate/control/grasp_state_machine.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

// Joints that changed by less were not moved by anybody.
constexpr double kUnmovedDeg = 0.2;
// The creep of the rubber raises a reading to no more than this multiple of what was left.
constexpr float kMaxCreep = 1.5F;
constexpr double kStillRisen = 0.5;  // of the rise: below it the rise is past

}  // namespace

void GraspStateMachine::refuse(const std::string& why) const {
  throw DeviceError(DeviceFault::kRefused, "grasp", why);
}

int GraspStateMachine::fingerOf(std::size_t matrix) const noexcept {
  return matrix < hand_.matrices.size() ? hand_.matrices[matrix].finger : -1;
}

// Throws when a matrix that may come into contact can't measure the limit.
void GraspStateMachine::requireMeasurableLimit(const GraspRequest& request) const {
  std::string text;
  for (const UnmeasurableLimit& unfelt : unmeasurableLimits(hand_, settings_, request))
    text += (text.empty() ? "" : "; ") + unfelt.why;
  if (!text.empty())
    refuse("refused: a limit of " + std::to_string(maxLimitOf(request)) +
           " counts can't be measured: " + text);
}

// Throws when a force limit of the request can't be measured, or is exceeded already and may not
// be.
std::optional<FingerForces> GraspStateMachine::forcesFor(const GraspRequest& request,
                                                         bool mayBeOver) const {
  if (request.forceLimitsN.empty()) return std::nullopt;
  if (!calibration_)
    refuse("refused: a limit in newtons needs a calibration of this hand, and none is applied");
  std::optional<FingerForces> forces;
  try {
    forces.emplace(*calibration_, hand_, settings_);
    if (newest_.layout) forces->apply(newest_, degC_);
  } catch (const std::invalid_argument& error) {
    refuse("refused: forces can't be measured: " + std::string(error.what()));
  }
  for (std::size_t finger = 0; finger < forces->forcesN().size(); ++finger) {
    const auto limitN = forceLimitOf(request, finger);
    const double largestN = forces->largestN(finger);
    if (limitN && !(*limitN <= largestN))
      refuse("refused: a limit of " + numberText(*limitN) + " N would not be felt: finger " +
             std::to_string(finger) + " measures no more than " + fixedText(largestN, 1) + " N");
    if (!mayBeOver && limitN && !(forces->forcesN()[finger] <= *limitN))
      refuse("refused: over the limit of " + numberText(*limitN) + " N already, at finger " +
             std::to_string(finger) + ": " + fixedText(forces->forcesN()[finger], 2) +
             " N; open the hand, or raise the limit");
  }
  return forces;
}

bool GraspStateMachine::holdsAlready(const GraspRequest& request) const {
  const GraspRequest& last = report_.request;
  if (request.mode != GraspMode::kSlip || request.startRatio || isJointMotion(request) ||
      isJointMotion(last) || heldDeg_.size() != anglesDeg_.size())
    return false;
  const auto terms = [](const GraspRequest& of) {
    return std::tie(of.preshape,
                    of.closeRatio,
                    of.object,
                    of.limitCounts,
                    of.fingerLimitCounts,
                    of.forceLimitsN,
                    of.keepsLimit);
  };
  const float left = report_.peakAfterStop ? commonCounts(*report_.peakAfterStop, request) : 0.0F;
  const float most = kMaxCreep * std::max(left, static_cast<float>(report_.limitCounts));
  if (terms(request) != terms(last) || commonCounts(loadedTaxel(request), request) > most)
    return false;
  return !heldDeg_.empty() &&
         std::equal(heldDeg_.begin(), heldDeg_.end(), anglesDeg_.begin(), [](double a, double b) {
           return std::abs(a - b) < kUnmovedDeg;
         });
}

bool GraspStateMachine::isOverLimit() const noexcept {
  // The limit is below saturation: see requireMeasurableLimit().
  return loadCounts() > static_cast<float>(limit_) || fingerOverForce(report_.request, forces_);
}

float GraspStateMachine::commonCounts(const TaxelPeak& peak,
                                      const GraspRequest& request) const noexcept {
  return peak.counts +
         static_cast<float>(request.limitCounts - limitOf(request, fingerOf(peak.matrix)));
}

const TaxelPeak& GraspStateMachine::loadedTaxel(const GraspRequest& request) const noexcept {
  if (request.fingerLimitCounts.empty()) return peak_;
  const TaxelPeak* loaded = &peak_;
  for (const TaxelPeak& each : matrixPeaks_)
    if (isTouched(each.counts) && commonCounts(each, request) > commonCounts(*loaded, request))
      loaded = &each;
  return *loaded;
}

std::optional<std::size_t> GraspStateMachine::fingerOverForce(
    const GraspRequest& request,
    const std::optional<FingerForces>& forces,
    std::optional<std::size_t> except) noexcept {
  if (!forces) return std::nullopt;
  for (std::size_t finger = 0; finger < forces->forcesN().size(); ++finger)
    if (const auto limitN = forceLimitOf(request, finger);
        finger != except && limitN && !(forces->forcesN()[finger] <= *limitN))
      return finger;
  return std::nullopt;
}

double GraspStateMachine::timesLimitOf(const TaxelPeak& peak) const noexcept {
  const int lower = report_.request.limitCounts - limitOf(report_.request, fingerOf(peak.matrix));
  return static_cast<double>(peak.counts) / std::max(limit_ - lower, 1);
}

double GraspStateMachine::timesLimit() const noexcept {
  double times = timesLimitOf(loadedTaxel(report_.request));
  if (!forces_) return times;
  for (std::size_t finger = 0; finger < forces_->forcesN().size(); ++finger)
    if (const auto limitN = forceLimitOf(report_.request, finger))
      times = std::max(times, forces_->forcesN()[finger] / *limitN);
  return times;
}

// Only after the limit was reached.
void GraspStateMachine::measurePeakAfterStop() {
  const TaxelPeak& loaded = loadedTaxel(report_.request);
  if (commonCounts(loaded, report_.request) > commonCounts(*report_.peakAfterStop, report_.request))
    report_.peakAfterStop = loaded;
  if (report_.forceFinger && forces_)
    report_.forceAfterStopN =
        std::max(report_.forceAfterStopN, forces_->forcesN()[*report_.forceFinger]);
}

bool GraspStateMachine::isStillRisen() const {
  if (!report_.peakAfterStop) return false;
  if (report_.forceFinger && forces_)
    return forces_->forcesN()[*report_.forceFinger] - report_.forceN >
           kStillRisen * (report_.forceAfterStopN - report_.forceN);
  const float atStop = commonCounts(report_.peak, report_.request);
  const float rise = commonCounts(*report_.peakAfterStop, report_.request) - atStop;
  return static_cast<double>(loadCounts() - atStop) > kStillRisen * static_cast<double>(rise);
}

}  // namespace palpate
