#include "palpate/signals/resampled_series.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

void requireAscending(const Series& series) {
  if (series.timeS.size() != series.values.size())
    throw std::invalid_argument("a series needs as many times as values");
  for (std::size_t i = 1; i < series.timeS.size(); ++i)
    if (!(series.timeS[i] > series.timeS[i - 1]))
      throw std::invalid_argument("times must ascend; sample " + std::to_string(i) + " doesn't");
}

}  // namespace

std::vector<double> resampled(const Series& series,
                              std::span<const double> timeS,
                              double longestS) {
  requireAscending(series);
  std::vector<double> times, values;
  for (std::size_t i = 0; i < series.timeS.size(); ++i) {
    if (!std::isfinite(series.values[i])) continue;
    times.push_back(series.timeS[i]);
    values.push_back(series.values[i]);
  }
  std::vector<double> result(timeS.size(), std::numeric_limits<double>::quiet_NaN());
  std::size_t next = 0;  // first sample after the time
  for (std::size_t i = 0; i < timeS.size(); ++i) {
    while (next < times.size() && times[next] <= timeS[i]) ++next;
    if (next == 0) continue;
    if (times[next - 1] == timeS[i]) {
      result[i] = values[next - 1];
      continue;
    }
    if (next == times.size()) continue;
    const double intervalS = times[next] - times[next - 1];
    if (intervalS > longestS) continue;
    const double part = (timeS[i] - times[next - 1]) / intervalS;
    result[i] = values[next - 1] + part * (values[next] - values[next - 1]);
  }
  return result;
}

std::vector<double> heldAt(const Series& series, std::span<const double> timeS) {
  requireAscending(series);
  std::vector<double> result(timeS.size(), std::numeric_limits<double>::quiet_NaN());
  std::size_t next = 0;  // first sample after the time
  for (std::size_t i = 0; i < timeS.size(); ++i) {
    while (next < series.timeS.size() && series.timeS[next] <= timeS[i]) ++next;
    if (next > 0) result[i] = series.values[next - 1];
  }
  return result;
}

}  // namespace palpate
