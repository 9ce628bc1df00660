#include "palpate/calibration/sensitivity_search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kNoLimit = 2.0;

void requireSensitivitySearch(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument("SensitivitySearch: " + what);
}

}  // namespace

void SensitivitySearchOptions::validate() const {
  requireSensitivitySearch(least > 0.0 && least <= most && most <= 1.0,
                           "least and most must be within 0..1, in order");
  requireSensitivitySearch(resolution > 0.0,
                           "resolution must be above 0, is " + numberText(resolution));
  requireSensitivitySearch(saturationCounts > 0.0,
                           "saturationCounts must be above 0, is " + numberText(saturationCounts));
  requireSensitivitySearch(headroom >= 0.0 && headroom <= 0.9,
                           "headroom must be 0..0.9, is " + numberText(headroom));
  requireSensitivitySearch(framesPerTrial >= 1, "framesPerTrial must be 1 or more");
  requireSensitivitySearch(
      resetUpperBoundAfterS >= 0.0,
      "resetUpperBoundAfterS must be 0 or more, is " + numberText(resetUpperBoundAfterS));
}

SensitivitySearch::SensitivitySearch(double sensitivity,
                                     double thresholdCounts,
                                     const SensitivitySearchOptions& options)
    : options_(options),
      thresholdCounts_(thresholdCounts),
      sensitivity_(sensitivity),
      lowestSaturated_(kNoLimit) {
  options_.validate();
  requireSensitivitySearch(thresholdCounts >= 0.0 && std::isfinite(thresholdCounts),
                           "thresholdCounts must be 0 or more");
  requireSensitivitySearch(
      sensitivity >= options_.least && sensitivity <= options_.most,
      "sensitivity must be between least and most, is " + numberText(sensitivity));
}

std::optional<double> SensitivitySearch::propose(double sensitivity) {
  const double next = std::clamp(sensitivity, options_.least, options_.most);
  frames_ = 0;
  largest_ = 0.0;
  lowSinceS_.reset();
  if (std::abs(next - sensitivity_) < 0.5 * options_.resolution && next != options_.least &&
      next != options_.most)
    return std::nullopt;
  if (next == sensitivity_) return std::nullopt;
  sensitivity_ = next;
  settled_ = false;
  return next;
}

std::optional<double> SensitivitySearch::observe(double timeS, double maximumCounts) {
  if (!std::isfinite(maximumCounts) || !(maximumCounts > 0.0)) return std::nullopt;
  if (maximumCounts >= options_.saturationCounts) {
    // React at once, since saturated readings are lost.
    lowestSaturated_ = std::min(lowestSaturated_, sensitivity_);
    if (highestUnsaturated_ >= lowestSaturated_)
      highestUnsaturated_ = 0.0;  // the load has grown since
    saturated_ = sensitivity_ <= options_.least;
    settled_ = saturated_;
    return propose(highestUnsaturated_ > 0.0
                       ? 0.5 * (highestUnsaturated_ + lowestSaturated_)
                       : 0.5 * (options_.least + lowestSaturated_) - 0.25 * options_.resolution);
  }
  saturated_ = false;
  largest_ = std::max(largest_, maximumCounts);
  const double aim = (1.0 - options_.headroom) * options_.saturationCounts;
  if (settled_) {
    // The maximum is much lower for a while: the load has changed, and so has the limit.
    const double wanted =
        sensitivity_ * (aim + thresholdCounts_) / (maximumCounts + thresholdCounts_);
    const bool low = sensitivity_ < options_.most &&
                     wanted > sensitivity_ + 2.0 * options_.resolution + options_.headroom;
    if (!low) lowSinceS_.reset();
    if (low && !lowSinceS_) lowSinceS_ = timeS;
    if (!low || timeS - *lowSinceS_ < options_.resetUpperBoundAfterS) return std::nullopt;
    lowestSaturated_ = kNoLimit;
    return propose(wanted);
  }
  if (++frames_ < options_.framesPerTrial) return std::nullopt;
  highestUnsaturated_ = std::max(highestUnsaturated_, sensitivity_);
  const double expected = sensitivity_ * (aim + thresholdCounts_) / (largest_ + thresholdCounts_);
  const double next = std::min(
      {expected,
       options_.most,
       lowestSaturated_ < kNoLimit ? 0.5 * (highestUnsaturated_ + lowestSaturated_) : kNoLimit});
  const auto proposal = next > sensitivity_ + options_.resolution ? propose(next) : std::nullopt;
  if (!proposal) settled_ = true;
  return proposal;
}

}  // namespace palpate
