#include "model/clock_windows.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/statistics.h"

namespace palpate {
namespace {

constexpr std::int64_t kWindowUs = 1'000'000;
constexpr std::size_t kWindowItems = 20;
constexpr std::size_t kSlopeWindows = 10;  // minimum for a slope
constexpr std::size_t kLineWindows = 600;  // of one line, at most
constexpr std::size_t kSlopePoints = 200;  // of which every pair is used
constexpr std::size_t kStepSide = 5;       // windows that are compared on each side of a step
constexpr std::size_t kShortestSide = 3;
constexpr double kSureStepUs = 20'000.0;  // a step without a pause of the sender's clock
constexpr double kSmallestStepUs = 1'000.0;
constexpr double kStepSigmas = 6.0;
constexpr double kPauseSteps = 1.5;
constexpr double kMadToSigma = 1.4826;

// Theil and Sen: the median of the slopes of all pairs [us/s].
double slopeOf(const std::deque<ClockWindow>& windows, std::size_t begin, std::size_t end) {
  const std::size_t every = (end - begin + kSlopePoints - 1) / kSlopePoints;
  std::vector<double> slopes;
  for (std::size_t i = begin; i < end; i += every)
    for (std::size_t j = i + every; j < end; j += every)
      if (const double apartS = windows[j].deviceS - windows[i].deviceS; apartS > 0.0)
        slopes.push_back((windows[j].fastestUs - windows[i].fastestUs) / apartS);
  return slopes.empty() ? 0.0 : median(std::move(slopes));
}

double levelOf(const std::deque<ClockWindow>& windows,
               std::size_t begin,
               std::size_t end,
               double slope) {
  std::vector<double> levels;
  for (std::size_t i = begin; i < end; ++i)
    levels.push_back(windows[i].fastestUs - slope * windows[i].deviceS);
  return median(std::move(levels));
}

}  // namespace

void ClockWindows::add(std::int64_t hostUs, std::int64_t deviceUs) {
  if (all_.empty()) {
    lagUs_ = hostUs - deviceUs;
    deviceUs_ = lastDeviceUs_ = deviceUs;
  }
  const double lag = lagUs(hostUs, deviceUs);
  if (all_.empty() ||
      (hostUs - all_.back().beginUs >= kWindowUs && all_.back().items >= kWindowItems))
    all_.push_back(
        {.beginUs = hostUs, .deviceS = deviceS(deviceUs), .fastestUs = lag, .slowestUs = lag});
  ClockWindow& window = all_.back();
  const auto stepUs = static_cast<double>(deviceUs - lastDeviceUs_);
  lastDeviceUs_ = deviceUs;
  window.endUs = hostUs;
  ++window.items;
  window.meanStepUs += (stepUs - window.meanStepUs) / static_cast<double>(window.items);
  window.longestStepUs = std::max(window.longestStepUs, stepUs);
  window.slowestUs = std::max(window.slowestUs, lag);
  if (lag >= window.fastestUs) return;
  window.fastestUs = lag;
  window.deviceS = deviceS(deviceUs);
}

double ClockLine::at(double deviceS) const {
  if (atS.size() == 1) return lagUs.front();
  const auto above = std::upper_bound(atS.begin() + 1, atS.end() - 1, deviceS);
  const auto i = static_cast<std::size_t>(above - atS.begin());
  const double share = (deviceS - atS[i - 1]) / (atS[i] - atS[i - 1]);
  return lagUs[i - 1] + share * (lagUs[i] - lagUs[i - 1]);
}

double ClockLine::slope() const {
  return atS.size() == 1 ? 0.0 : (lagUs.back() - lagUs.front()) / (atS.back() - atS.front());
}

ClockLine clockLineOf(const std::deque<ClockWindow>& all, double slope) {
  // The last window may be too short to have a fast arrival.
  const std::size_t count =
      all.size() > 1 && all.back().items < kWindowItems ? all.size() - 1 : all.size();
  ClockLine line;
  line.measured = count >= kSlopeWindows;
  const std::size_t parts = (count + kLineWindows - 1) / kLineWindows;
  double lastEndUs = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * count / parts, end = (part + 1) * count / parts;
    const double partSlope = line.measured ? slopeOf(all, begin, end) : slope;
    const double level = levelOf(all, begin, end, partSlope);
    const double atS = all[begin].deviceS;
    const double lagUs = level + partSlope * atS;
    line.atS.push_back(atS);
    line.lagUs.push_back(part == 0 ? lagUs : 0.5 * (lagUs + lastEndUs));
    const double endS = end < count ? all[end].deviceS : std::max(all[end - 1].deviceS, atS + 1.0);
    lastEndUs = level + partSlope * endS;
    if (end < count) continue;
    line.atS.push_back(endS);
    line.lagUs.push_back(lastEndUs);
  }
  std::vector<double> spreads, deviations;
  for (std::size_t i = 0; i < count; ++i) {
    spreads.push_back(all[i].slowestUs - all[i].fastestUs);
    deviations.push_back(std::abs(all[i].fastestUs - line.at(all[i].deviceS)));
  }
  line.delaySpreadUs = median(std::move(spreads));
  line.rmsUs = kMadToSigma * median(std::vector(deviations));
  // In windows beyond, all items were late: they don't say where the line is.
  double squares = 0.0;
  std::size_t used = 0;
  for (const double deviation : deviations) {
    if (deviation > std::max(4.0 * line.rmsUs, 1.0)) continue;
    squares += deviation * deviation;
    ++used;
    line.boundUs = std::max(line.boundUs, deviation);
  }
  if (used > 0) line.rmsUs = std::sqrt(squares / static_cast<double>(used));
  return line;
}

std::optional<ClockStep> clockStepIn(const std::deque<ClockWindow>& windows) {
  const std::size_t count = windows.size();
  if (count < 2 * kShortestSide) return std::nullopt;
  const double slope = slopeOf(windows, 0, count);
  std::vector<double> levels, changes, steps;
  for (const ClockWindow& window : windows) {
    levels.push_back(window.fastestUs - slope * window.deviceS);
    steps.push_back(window.meanStepUs);
    if (levels.size() > 1) changes.push_back(std::abs(levels.back() - levels[levels.size() - 2]));
  }
  const double sigma = kMadToSigma / std::sqrt(2.0) * median(std::move(changes));
  const double threshold = std::max(kSmallestStepUs, kStepSigmas * sigma);
  const double usualStepUs = median(std::move(steps));
  const auto around = [&](std::size_t from, std::size_t to) {
    return median(std::vector(levels.begin() + static_cast<std::ptrdiff_t>(from),
                              levels.begin() + static_cast<std::ptrdiff_t>(to)));
  };
  // The lowest levels of several windows, up to each window, and from it on.
  std::vector<double> lowestBefore(count), lowestAfter(count);
  for (std::size_t i = 0; i < count; ++i) {
    lowestBefore[i] = std::min(levels[i], i > 0 ? lowestBefore[i - 1] : levels[i]);
    const std::size_t j = count - 1 - i;
    lowestAfter[j] = std::min(levels[j], i > 0 ? lowestAfter[j + 1] : levels[j]);
  }
  std::optional<ClockStep> best;
  for (std::size_t k = kShortestSide; k + kShortestSide <= count; ++k) {
    const double before = around(k - std::min(k, kStepSide), k);
    const double after = around(k, std::min(count, k + kStepSide));
    const double change = std::abs(after - before);
    if (change < threshold || (best && change <= std::abs(best->afterUs - best->beforeUs)))
      continue;
    bool paused = false;
    for (std::size_t i = k - 1; i <= std::min(k + 1, count - 1); ++i)
      paused = paused || windows[i].longestStepUs > kPauseSteps * usualStepUs;
    // A delay ends again; a clock that jumped stays away.
    const bool stays = after > before ? lowestAfter[k] > before + 0.5 * change
                                      : lowestBefore[k - 1] > after + 0.5 * change;
    if (!paused && (change < std::max(kSureStepUs, 2.0 * usualStepUs) || !stays)) continue;
    best = ClockStep{k, slope, before, after, usualStepUs};
  }
  return best;
}

}  // namespace palpate
