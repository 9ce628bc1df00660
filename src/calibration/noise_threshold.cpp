#include "palpate/calibration/noise_threshold.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

void requireNoiseThreshold(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument("NoiseThresholds: " + what);
}

}  // namespace

std::vector<std::optional<std::size_t>> nearestSensors(const HandDescription& hand) {
  std::vector<std::optional<std::size_t>> sensors;
  for (const MatrixDescription& matrix : hand.matrices) sensors.push_back(matrix.temperatureSensor);
  return sensors;
}

void NoiseThresholdOptions::validate() const {
  requireNoiseThreshold(sigmas >= 0.0 && sigmas <= 20.0,
                        "sigmas must be 0..20, is " + numberText(sigmas));
  requireNoiseThreshold(sensitivity >= 0.0 && sensitivity <= 1.0,
                        "sensitivity must be 0..1, is " + numberText(sensitivity));
  requireNoiseThreshold(minCounts >= 0 && minCounts <= maxCounts && maxCounts <= 4095,
                        "minCounts and maxCounts must be 0..4095, in order");
  requireNoiseThreshold(hysteresisCounts >= 1, "hysteresisCounts must be 1 or more");
  requireNoiseThreshold(minIntervalS >= 0.0, "minIntervalS must be 0 or more");
  requireNoiseThreshold(
      rateCollapseFraction >= 0.0 && rateCollapseFraction <= 1.0,
      "rateCollapseFraction must be 0..1, is " + numberText(rateCollapseFraction));
  requireNoiseThreshold(guardWindowS > 0.0 && guardCalmS > 0.0,
                        "guardWindowS and guardCalmS must be above 0");
  requireNoiseThreshold(guardStepCounts >= 1, "guardStepCounts must be 1 or more");
}

int noiseThreshold(const NoiseLine& line, double degC, const NoiseThresholdOptions& options) {
  const double counts = std::ceil(line.threshold(degC, options.sigmas));
  return static_cast<int>(std::clamp(
      counts, static_cast<double>(options.minCounts), static_cast<double>(options.maxCounts)));
}

NoiseThresholds::NoiseThresholds(NoiseFloor floor,
                                 std::vector<std::optional<std::size_t>> sensors,
                                 TactileThresholds reset,
                                 double usualRateHz,
                                 NoiseThresholdOptions options)
    : floor_(std::move(floor)),
      sensors_(std::move(sensors)),
      reset_(std::move(reset)),
      usualRateHz_(usualRateHz),
      options_(options) {
  options_.validate();
  requireNoiseThreshold(!reset_.counts.empty() && sensors_.size() == reset_.counts.size(),
                        std::to_string(sensors_.size()) + " sensors for " +
                            std::to_string(reset_.counts.size()) + " matrices");
  requireNoiseThreshold(floor_.lines.size() <= reset_.counts.size(),
                        "more noise lines than matrices");
  requireNoiseThreshold(usualRateHz > 0.0 && std::isfinite(usualRateHz),
                        "usualRateHz must be above 0");
}

// Returns true when the guard changed.
bool NoiseThresholds::watchRate(double timeS, double rateHz) {
  if (!std::isfinite(rateHz)) return false;
  const bool slow = rateHz < options_.rateCollapseFraction * usualRateHz_;
  auto& since = slow ? slowSinceS_ : calmSinceS_;
  (slow ? calmSinceS_ : slowSinceS_).reset();
  if (!since) since = timeS;
  if (slow && timeS - *since >= options_.guardWindowS) {
    since = timeS;  // wait for the next step until the rate had time to change
    if (status_.guardAtLimit) return false;
    status_.guardCounts += options_.guardStepCounts;
    return true;
  }
  if (!slow && status_.guardCounts > 0 && timeS - *since >= options_.guardCalmS) {
    since = timeS;
    status_.guardCounts = std::max(status_.guardCounts - options_.guardStepCounts, 0);
    return true;
  }
  return false;
}

std::vector<int> NoiseThresholds::wanted(std::span<const double> degC) {
  status_.extrapolated.clear();
  status_.unknown.clear();
  status_.guardAtLimit = status_.guardCounts > 0;
  std::vector<int> counts = reset_.counts;
  for (std::size_t m = 0; m < counts.size(); ++m) {
    const std::size_t sensor = sensors_[m].value_or(SIZE_MAX);
    const double t = sensor < degC.size() ? degC[sensor] : 0.0;
    const bool known =
        m < floor_.lines.size() && floor_.lines[m].valid && std::isfinite(t) && t != 0.0;
    if (known) {
      counts[m] = noiseThreshold(floor_.lines[m], t, options_);
      if (floor_.lines[m].maxDegC > floor_.lines[m].minDegC && !floor_.lines[m].covers(t))
        status_.extrapolated.push_back(m);
    } else {
      status_.unknown.push_back(m);
    }
    counts[m] = std::min(counts[m] + status_.guardCounts, std::max(options_.maxCounts, counts[m]));
    status_.guardAtLimit = status_.guardAtLimit && counts[m] >= options_.maxCounts;
  }
  return counts;
}

std::optional<TactileThresholds> NoiseThresholds::update(double timeS,
                                                         std::span<const double> degC,
                                                         double rateHz) {
  const bool guardMoved = watchRate(timeS, rateHz);
  std::vector<int> counts = wanted(degC);
  status_.guarding = status_.guardCounts > 0;
  if (lastSetS_ && !guardMoved) {
    if (timeS - *lastSetS_ < options_.minIntervalS) return std::nullopt;
    bool moves = false;
    for (std::size_t m = 0; m < counts.size(); ++m) {
      const int by = counts[m] - proposed_.counts[m];
      moves = moves || by >= options_.hysteresisCounts || by <= -2 * options_.hysteresisCounts;
    }
    if (!moves) return std::nullopt;
  }
  TactileThresholds next{options_.sensitivity, std::move(counts)};
  if (lastSetS_ && next == proposed_) return std::nullopt;
  lastSetS_ = timeS;
  proposed_ = next;
  return next;
}

}  // namespace palpate
