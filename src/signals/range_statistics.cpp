#include "palpate/signals/range_statistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "palpate/core/statistics.h"

namespace palpate {

RangeStatistics rangeStatistics(std::span<const double> timeS,
                                std::span<const double> values,
                                double longestS) {
  if (timeS.size() != values.size())
    throw std::invalid_argument("a range needs as many times as values");
  RangeStatistics result;
  std::vector<double> finite;
  double sum = 0.0, timeSum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const bool first = result.count++ == 0;
    finite.push_back(values[i]);
    sum += values[i];
    timeSum += timeS[i];
    result.minimum = first ? values[i] : std::min(result.minimum, values[i]);
    result.maximum = first ? values[i] : std::max(result.maximum, values[i]);
  }
  if (result.count == 0) return result;
  const auto count = static_cast<double>(result.count);
  result.mean = sum / count;
  const double meanTimeS = timeSum / count;
  // The sums of squares are about the means, so that an offset of the signal costs no digits.
  double squares = 0.0, timeSquares = 0.0, products = 0.0;
  result.integral = 0.0;
  std::size_t before = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const double value = values[i] - result.mean;
    const double time = timeS[i] - meanTimeS;
    squares += value * value;
    timeSquares += time * time;
    products += time * value;
    if (before < values.size()) {
      const double interval = timeS[i] - timeS[before];
      if (interval <= longestS) result.integral += 0.5 * interval * (values[i] + values[before]);
    }
    before = i;
  }
  if (result.count > 1) result.sd = std::sqrt(squares / (count - 1.0));
  result.rms = std::sqrt(result.mean * result.mean + squares / count);
  result.median = median(std::move(finite));
  if (timeSquares > 0.0) result.slope = products / timeSquares;
  return result;
}

std::optional<RangeChange> rangeChange(std::size_t numSamples,
                                       const std::function<double(std::size_t)>& timeSAt,
                                       const std::function<double(std::size_t)>& valueAt) {
  std::size_t first = 0;
  double from = 0.0;
  for (; first < numSamples; ++first)
    if (from = valueAt(first); std::isfinite(from)) break;
  if (first == numSamples) return std::nullopt;
  std::size_t last = numSamples - 1;
  double to = from;
  for (; last > first; --last)
    if (to = valueAt(last); std::isfinite(to)) break;
  if (last == first) to = from;
  return RangeChange{.fromS = timeSAt(first), .toS = timeSAt(last), .from = from, .to = to};
}

}  // namespace palpate
