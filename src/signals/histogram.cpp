#include "palpate/signals/histogram.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr double kMaxAutomaticBins = 200.0;

// The quantile of ascending values, linear between them (numpy's default).
double quantileOf(const std::vector<double>& ascending, double share) {
  const double place = share * static_cast<double>(ascending.size() - 1);
  const auto left = static_cast<std::size_t>(place);
  const std::size_t right = std::min(left + 1, ascending.size() - 1);
  return ascending[left] +
         (place - static_cast<double>(left)) * (ascending[right] - ascending[left]);
}

std::size_t automaticBins(const std::vector<double>& ascending) {
  const auto n = static_cast<double>(ascending.size());
  const double range = ascending.back() - ascending.front();
  double width = range / (std::log2(n) + 1.0);
  const double quartiles = quantileOf(ascending, 0.75) - quantileOf(ascending, 0.25);
  if (quartiles > 0.0) width = std::min(width, 2.0 * quartiles / std::cbrt(n));
  return static_cast<std::size_t>(std::clamp(std::ceil(range / width), 1.0, kMaxAutomaticBins));
}

}  // namespace

Histogram histogramOf(std::span<const double> values, std::size_t bins) {
  if (bins > kMaxHistogramBins)
    throw std::invalid_argument("histogram: bins must be at most " +
                                std::to_string(kMaxHistogramBins) + ", are " +
                                std::to_string(bins));
  Histogram histogram;
  std::vector<double> finite;
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  histogram.notFinite = values.size() - finite.size();
  if (finite.empty()) return histogram;
  std::sort(finite.begin(), finite.end());
  const double range = finite.back() - finite.front();
  if (!(range > 0.0)) {
    const std::size_t count = std::max<std::size_t>(bins, 1);
    histogram.low = finite.front() - 0.5;
    histogram.width = 1.0 / static_cast<double>(count);
    histogram.counts.assign(count, 0);
    histogram.counts[count / 2] = finite.size();
    return histogram;
  }
  histogram.counts.assign(bins > 0 ? bins : automaticBins(finite), 0);
  histogram.low = finite.front();
  histogram.width = range / static_cast<double>(histogram.counts.size());
  for (const double value : finite) {
    const auto bin = static_cast<std::size_t>((value - histogram.low) / histogram.width);
    ++histogram.counts[std::min(bin, histogram.counts.size() - 1)];
  }
  return histogram;
}

}  // namespace palpate
