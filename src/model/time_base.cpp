#include "palpate/model/time_base.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/core/number_text.h"

#include "model/clock_tracker.h"
#include "model/clock_windows.h"

namespace palpate {
namespace {

using Verdict = ClockTracker::Verdict;
using Judged = ClockTracker::Judged;

constexpr std::size_t kFewestItems = 20;
constexpr double kMaxDriftPpm = 10'000.0;
// An item that is faster than the fastest ones by more has a wrong time [us].
constexpr double kTooEarlyUs = 20'000.0;
constexpr double kTooEarlySigmas = 6.0;
constexpr std::size_t kMonitoredWindows = 300;
constexpr std::size_t kLookBackItems = 64;

// A stretch that is being fitted: positions in the list of usable items.
struct Part {
  std::size_t begin = 0;
  std::size_t end = 0;
  ClockWindows windows = {};
  ClockLine line = {};
};

ClockWindows windowsOf(const std::vector<Judged>& usable, std::size_t begin, std::size_t end) {
  ClockWindows windows;
  for (std::size_t i = begin; i < end; ++i) windows.add(usable[i].hostUs, usable[i].deviceUs);
  return windows;
}

// The item with which the lag of a step begins: where the sender's clock paused, if it did.
std::size_t firstOfStep(const std::vector<Judged>& usable,
                        const Part& part,
                        const ClockStep& step) {
  const auto& windows = part.windows.all();
  const std::int64_t fromUs = windows[step.window - std::min<std::size_t>(step.window, 3)].beginUs;
  const std::int64_t toUs = windows[std::min(step.window + 3, windows.size()) - 1].endUs;
  const auto at = [&](std::int64_t us) {
    return static_cast<std::size_t>(
        std::lower_bound(usable.begin() + static_cast<std::ptrdiff_t>(part.begin),
                         usable.begin() + static_cast<std::ptrdiff_t>(part.end),
                         us,
                         [](const Judged& item, std::int64_t time) { return item.hostUs < time; }) -
        usable.begin());
  };
  const std::size_t from = std::max(at(fromUs), part.begin + 1);
  const std::size_t to = std::min(at(toUs), part.end - 1);
  const auto levelOf = [&](std::size_t i) {
    return part.windows.lagUs(usable[i].hostUs, usable[i].deviceUs) -
           step.slope * part.windows.deviceS(usable[i].deviceUs);
  };
  const double middle = 0.5 * (step.beforeUs + step.afterUs);
  // Items above the middle may belong to both sides, in a delay; those below it only to one.
  std::size_t first = from, last = to;
  if (step.afterUs > step.beforeUs) {
    for (std::size_t i = from; i <= to; ++i)
      if (levelOf(i) < middle) first = std::min(i + 1, to);
    const double reachedUs = step.afterUs + 0.5 * (step.afterUs - step.beforeUs);
    last = first;
    while (last < to && levelOf(last) > reachedUs) ++last;
  } else {
    last = from;
    while (last < to && levelOf(last) >= middle) ++last;
    first = last - std::min(last - from, kLookBackItems);
  }
  std::size_t best = last;
  std::int64_t longestUs = 0;
  for (std::size_t i = first; i <= last; ++i)
    if (const auto us = usable[i].deviceUs - usable[i - 1].deviceUs; us > longestUs) {
      longestUs = us;
      best = i;
    }
  return static_cast<double>(longestUs) > 1.5 * step.usualStepUs ? best : last;
}

void divide(const std::vector<Judged>& usable,
            std::size_t begin,
            std::size_t end,
            std::vector<Part>& parts) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{begin, end}};
  while (!open.empty()) {
    Part part{open.back().first, open.back().second};
    open.pop_back();
    part.windows = windowsOf(usable, part.begin, part.end);
    if (const auto step = clockStepIn(part.windows.all())) {
      const std::size_t first = firstOfStep(usable, part, *step);
      open.emplace_back(first, part.end);
      open.emplace_back(part.begin, first);
    } else {
      parts.push_back(std::move(part));
    }
  }
}

bool runsWrong(const ClockLine& line) { return std::abs(line.slope()) > kMaxDriftPpm; }

// Gives items without a time their arrival, and lets all ascend.
void fillAndSort(std::span<const ClockStamp> stamps,
                 const std::vector<bool>& isFitted,
                 std::vector<std::int64_t>& timesUs) {
  for (std::size_t i = timesUs.size(); i-- > 0;)
    if (!isFitted[i]) {
      timesUs[i] = stamps[i].hostUs;
      if (i + 1 < timesUs.size()) timesUs[i] = std::min(timesUs[i], timesUs[i + 1] - 1);
    }
  for (std::size_t i = 1; i < timesUs.size(); ++i)
    timesUs[i] = std::max(timesUs[i], timesUs[i - 1] + 1);
}

std::string driftText(double ppm) { return fixedText(ppm, std::abs(ppm) < 100.0 ? 1 : 0) + " ppm"; }

}  // namespace

std::string clockText(const ClockReport& report) {
  std::string text =
      report.driftPpm ? "drift " + driftText(*report.driftPpm) : "drift not known yet";
  text += ", delays vary by " + fixedText(report.delaySpreadMs, 1) + " ms, " +
          counted(report.restarts, "restart") + ", error " + fixedText(report.rmsMs, 2) +
          " ms (at most " + fixedText(report.boundMs, 2) + ")";
  if (report.unusable > 0)
    text += ", " + counted(report.unusable, "item") + " without a usable time";
  return text;
}

struct ClockMonitor::State {
  ClockTracker tracker;
  ClockWindows windows;
  std::vector<Judged> judged;
  ClockReport report;
  bool known = false;
};

ClockMonitor::ClockMonitor() : state_(std::make_unique<State>()) {}
ClockMonitor::~ClockMonitor() = default;
ClockMonitor::ClockMonitor(ClockMonitor&&) noexcept = default;
ClockMonitor& ClockMonitor::operator=(ClockMonitor&&) noexcept = default;

void ClockMonitor::add(const ClockStamp& stamp) {
  State& state = *state_;
  state.known = state.known || stamp.deviceUs;
  ++state.report.items;
  state.judged.clear();
  state.tracker.push(stamp, state.judged);
  for (const Judged& each : state.judged) {
    if (each.verdict == Verdict::kUnusable) {
      ++state.report.unusable;
      continue;
    }
    if (each.verdict == Verdict::kRestart) {
      ++state.report.restarts;
      state.windows = {};
      state.report.driftPpm.reset();
    }
    auto& windows = state.windows.all();
    const std::size_t before = windows.size();
    state.windows.add(each.hostUs, each.deviceUs);
    if (windows.size() == before || before == 0) continue;
    if (windows.size() > kMonitoredWindows) windows.pop_front();
    // The newest window has only begun.
    std::deque<ClockWindow> complete(windows.begin(), windows.end() - 1);
    if (const auto step = clockStepIn(complete)) {
      ++state.report.restarts;
      const auto gone = static_cast<std::ptrdiff_t>(step->window);
      windows.erase(windows.begin(), windows.begin() + gone);
      complete.erase(complete.begin(), complete.begin() + gone);
    }
    const ClockLine line = clockLineOf(complete);
    state.report.driftPpm = line.measured ? std::optional<double>(-line.slope()) : std::nullopt;
    state.report.delaySpreadMs = line.delaySpreadUs / 1e3;
    state.report.rmsMs = line.rmsUs / 1e3;
    state.report.boundMs = line.boundUs / 1e3;
  }
}

std::optional<ClockReport> ClockMonitor::report() const {
  return state_->known ? std::optional(state_->report) : std::nullopt;
}

std::optional<TimeBase> TimeBase::fit(std::span<const ClockStamp> stamps, std::string* why) {
  const auto refuse = [&](std::string text) -> std::optional<TimeBase> {
    if (why) *why = std::move(text);
    return std::nullopt;
  };
  if (std::none_of(stamps.begin(), stamps.end(), [](const auto& stamp) { return stamp.deviceUs; }))
    return refuse("no times of the sender's clock");
  std::vector<Judged> judged, byItem(stamps.size());
  ClockTracker tracker;
  for (const ClockStamp& stamp : stamps) {
    judged.clear();
    tracker.push(stamp, judged);
    if (&stamp == &stamps.back()) tracker.finish(judged);
    for (const Judged& each : judged) byItem[each.item] = each;
  }
  std::vector<Judged> usable;
  std::vector<std::size_t> begins{0};
  for (const Judged& each : byItem) {
    if (each.verdict == Verdict::kRestart && !usable.empty()) begins.push_back(usable.size());
    if (each.verdict != Verdict::kUnusable) usable.push_back(each);
  }
  byItem = {};
  if (usable.size() < kFewestItems)
    return refuse("only " + counted(usable.size(), "usable time") + " of the sender's clock, " +
                  std::to_string(kFewestItems) + " are needed");
  begins.push_back(usable.size());
  std::vector<Part> parts;
  for (std::size_t i = 0; i + 1 < begins.size(); ++i)
    divide(usable, begins[i], begins[i + 1], parts);
  // A short stretch has the drift of the longest one: it is the same clock.
  double slope = 0.0;
  std::size_t longest = 0;
  for (Part& part : parts) {
    part.line = clockLineOf(part.windows.all());
    if (runsWrong(part.line))
      return refuse("the sender's clock runs " +
                    fixedText(1.0 / (1.0 + part.line.slope() / 1e6), 3) +
                    " times as fast as ours: is the unit of its times right?");
    if (!part.line.measured || part.end - part.begin <= longest) continue;
    longest = part.end - part.begin;
    slope = part.line.slope();
  }
  TimeBase base;
  base.timesUs_.resize(stamps.size());
  std::vector<bool> isFitted(stamps.size());
  std::size_t fitted = 0;
  double squares = 0.0, spreads = 0.0, slopes = 0.0, sloped = 0.0;
  for (Part& part : parts) {
    if (!part.line.measured) part.line = clockLineOf(part.windows.all(), slope);
    const ClockLine& line = part.line;
    const double earlyUs = -std::max(kTooEarlyUs, kTooEarlySigmas * line.rmsUs);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Judged& item = usable[i];
      const double lagUs = line.at(part.windows.deviceS(item.deviceUs));
      if (part.windows.lagUs(item.hostUs, item.deviceUs) - lagUs < earlyUs) continue;
      base.timesUs_[item.item] = item.deviceUs + part.windows.firstLagUs() + std::llround(lagUs);
      isFitted[item.item] = true;
      ++fitted;
    }
    base.stretches_.push_back({usable[part.begin].item,
                               part.end < usable.size() ? usable[part.end].item : stamps.size(),
                               line.measured ? std::optional(-line.slope()) : std::nullopt,
                               line.delaySpreadUs / 1e3,
                               line.rmsUs / 1e3,
                               line.boundUs / 1e3});
    const auto weight = static_cast<double>(part.end - part.begin);
    squares += weight * line.rmsUs * line.rmsUs;
    spreads += weight * line.delaySpreadUs;
    slopes += line.measured ? weight * line.slope() : 0.0;
    sloped += line.measured ? weight : 0.0;
    base.report_.boundMs = std::max(base.report_.boundMs, line.boundUs / 1e3);
  }
  base.stretches_.front().begin = 0;
  fillAndSort(stamps, isFitted, base.timesUs_);
  const auto all = static_cast<double>(usable.size());
  base.report_.items = stamps.size();
  base.report_.unusable = stamps.size() - fitted;
  base.report_.restarts = parts.size() - 1;
  if (sloped > 0.0) base.report_.driftPpm = -slopes / sloped;
  base.report_.delaySpreadMs = spreads / all / 1e3;
  base.report_.rmsMs = std::sqrt(squares / all) / 1e3;
  return base;
}

}  // namespace palpate
