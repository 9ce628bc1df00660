#include "palpate/slip/rotation_tracker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

// A side cuts a contact if its line of taxels carries at least this fraction of the load of the
// parallel line with the largest load. Below it, the contact ends there.
constexpr double kCutPart = 0.5;
// Eccentricity (study's definition) below which the whole contact would have no direction.
constexpr double kMinWholeEccentricity = 0.6;

// Load of one line of taxels: row `line` (along x), or column `line`.
double lineLoad(const ConstMatrixMap& frame, Eigen::Index line, bool alongX) noexcept {
  double load = 0.0;
  for (Eigen::Index i = 0; i < (alongX ? frame.cols() : frame.rows()); ++i)
    load += static_cast<double>(std::max(alongX ? frame(line, i) : frame(i, line), 0.0F));
  return load;
}

}  // namespace

void RotationOptions::validate() const {
  if (!(minEccentricity >= 0.0 && minEccentricity <= 1.0))
    throw std::invalid_argument("RotationOptions: minEccentricity is " +
                                std::to_string(minEccentricity) + ", not 0..1");
  if (!(maxRoundness >= 0.0 && maxRoundness <= 1.0))
    throw std::invalid_argument("RotationOptions: maxRoundness is " + std::to_string(maxRoundness) +
                                ", not 0..1");
  if (minTaxels < 1)
    throw std::invalid_argument("RotationOptions: minTaxels is " + std::to_string(minTaxels));
}

bool axisIsDetermined(const ConstMatrixMap& frame, const ContactMoments& moments) noexcept {
  if (frame.size() == 0 || !(moments.sum > 0.0)) return true;
  const Eigen::Index right = frame.cols() - 1;
  const Eigen::Index bottom = frame.rows() - 1;
  const double seenDeg = principalAxis(moments).orientationDeg;
  for (const bool alongX : {true, false}) {
    double most = 0.0;
    for (Eigen::Index i = 0; i <= (alongX ? bottom : right); ++i)
      most = std::max(most, lineLoad(frame, i, alongX));
    for (const bool far : {false, true}) {
      const Eigen::Index line = far ? (alongX ? bottom : right) : 0;
      double load = 0.0;
      double first = 0.0;
      for (Eigen::Index i = 0; i <= (alongX ? right : bottom); ++i) {
        const float value = alongX ? frame(line, i) : frame(i, line);
        if (!isTouched(value)) continue;
        load += static_cast<double>(value);
        first += static_cast<double>(value) * static_cast<double>(i);
      }
      if (!(load > 0.0) || load < kCutPart * most) continue;
      const double place = first / load;
      const auto side = static_cast<double>(line);
      const double x = moments.x - (alongX ? place : side);
      const double y = moments.y - (alongX ? side : place);
      // Second moments about the point of symmetry.
      ContactMoments whole = moments;
      whole.mu20 += x * x;
      whole.mu11 += x * y;
      whole.mu02 += y * y;
      const PrincipalAxis axis = principalAxis(whole);
      const double off = axis.orientationDeg - seenDeg;
      // 0 along the side, 90 along its normal [deg].
      const double fromX = std::abs(seenDeg - 180.0 * std::round(seenDeg / 180.0));
      const double fromSideDeg = alongX ? fromX : 90.0 - fromX;
      if (fromSideDeg < 45.0 || axis.studyEccentricity < kMinWholeEccentricity ||
          std::abs(off - 180.0 * std::round(off / 180.0)) > kMaxCutAxisDeg)
        return false;
    }
  }
  return true;
}

RotationTracker::RotationTracker(const RotationOptions& options) : options_(options) {
  options_.validate();
}

const SlipRotation& RotationTracker::update(const ContactMoments& moments,
                                            double roundness,
                                            bool determined) noexcept {
  state_.axis = principalAxis(moments);
  state_.roundness = roundness;
  state_.valid = false;
  state_.refValid = false;
  state_.rotationDeg = 0.0;
  const bool round =
      state_.axis.studyEccentricity < options_.minEccentricity && roundness > options_.maxRoundness;
  state_.reliable =
      moments.active >= options_.minTaxels && state_.axis.lambda1 > 0.0 && !round && determined;
  if (!state_.reliable) {
    hasLast_ = false;
    return state_;
  }
  const double orientation = state_.axis.orientationDeg;
  if (followed_) {
    const double off = orientation - angleDeg_;
    const double step = off - 180.0 * std::round(off / 180.0);
    angleDeg_ += step;
    countsTurns_ = countsTurns_ && std::abs(step) <= kMaxAxisStepDeg;
    state_.valid = hasLast_;
    if (hasLast_) state_.rotationDeg = step;
  } else {
    angleDeg_ = orientation;
    followed_ = true;
  }
  hasLast_ = true;
  if (wantsReference_) {
    referenceDeg_ = angleDeg_;
    hasReference_ = true;
    countsTurns_ = true;
    wantsReference_ = false;
  }
  state_.refValid = hasReference_ && countsTurns_;
  if (state_.refValid) state_.refRotationDeg = angleDeg_ - referenceDeg_;
  return state_;
}

bool RotationTracker::setReference() noexcept {
  state_.refRotationDeg = 0.0;
  hasReference_ = hasLast_;
  wantsReference_ = !hasLast_;
  if (hasLast_) referenceDeg_ = angleDeg_;
  countsTurns_ = true;
  return hasLast_;
}

void RotationTracker::reset() noexcept {
  const RotationOptions options = options_;
  *this = RotationTracker(options);
}

}  // namespace palpate
