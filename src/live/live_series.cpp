#include "palpate/live/live_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "palpate/core/time.h"

namespace palpate {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
// Expired samples are compacted once they outnumber the live ones (and this minimum).
constexpr std::size_t kMinRemoved = 1024;

double valueIn(const std::vector<double>& values, std::size_t index) {
  return index < values.size() ? values[index] : kNoValue;
}

}  // namespace

void LiveSeries::setHistory(const SignalHistory* history) {
  history_ = history;
  originUs_.reset();
  newestUs_.reset();
  frames_ = {};
  breakAfterUs_.reset();
  for (Entry& entry : entries_) entry = {.choice = std::move(entry.choice)};
}

double LiveSeries::secondsOf(std::int64_t hostUs) const noexcept {
  return static_cast<double>(hostUs - originUs_.value_or(hostUs)) / kUsPerS;
}

double LiveSeries::valueOf(Entry& entry, const SignalSample& sample) {
  const SeriesChoice& choice = entry.choice;
  switch (choice.kind) {
    case SeriesChoice::Kind::kAngle:
      return valueIn(sample.anglesDeg, choice.index);
    case SeriesChoice::Kind::kTemperature: {
      const double degC = valueIn(sample.temperatures, choice.index);
      return degC == 0.0 ? kNoValue : degC;
    }
    case SeriesChoice::Kind::kForce:
      return valueIn(sample.forcesN, choice.index);
    case SeriesChoice::Kind::kColumn:   // by takeColumn()
    case SeriesChoice::Kind::kFormula:  // only of recordings
      return kNoValue;
    case SeriesChoice::Kind::kTaxels:
      if (entry.layout != sample.layout) {
        entry.layout = sample.layout;
        entry.chosen.assign(sample.layout->numCells(), false);
        entry.numChosen = 0;
        const std::size_t matrices =
            std::min(choice.taxels.numMatrices(), sample.layout->numMatrices());
        for (std::size_t m = 0; m < matrices; ++m) {
          const Mask& mask = choice.taxels.mask(m);
          const std::size_t offset = sample.layout->offset(m);
          for (std::size_t i = 0; i < mask.size() && offset + i < entry.chosen.size(); ++i) {
            if (!mask[i]) continue;
            entry.chosen[offset + i] = true;
            ++entry.numChosen;
          }
        }
      }
      return sample.taxels.meanOf(entry.chosen, entry.numChosen);
    case SeriesChoice::Kind::kMatrix:
      break;
  }
  return choice.index < sample.rows.size()
             ? palpate::valueOf(sample.rows[choice.index], choice.signal)
             : kNoValue;
}

void LiveSeries::setWanted(const std::vector<SeriesChoice>& wanted) {
  std::vector<Entry> entries;
  std::vector<std::size_t> added;
  for (const SeriesChoice& choice : wanted) {
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
      return entry.choice == choice;
    });
    if (known != entries_.end() && known->values.size() == timesOf(*known).timeS.size()) {
      entries.push_back(std::move(*known));
      known->values.clear();
      continue;
    }
    entries.push_back({.choice = choice});
    if (entries.back().isColumn()) continue;
    entries.back().values.assign(frames_.timeS.size(), kNoValue);
    added.push_back(entries.size() - 1);
  }
  entries_ = std::move(entries);
  for (Entry& entry : entries_) takeColumn(entry);
  if (added.empty() || !history_ || empty()) return;
  std::size_t at = frames_.first;
  for (const SharedSignalSample& sample :
       history_->after(std::numeric_limits<std::int64_t>::min())) {
    if (sample->hostUs > *newestUs_) break;
    const double timeS = secondsOf(sample->hostUs);
    while (at < frames_.timeS.size() && frames_.timeS[at] < timeS) ++at;
    if (at == frames_.timeS.size()) break;
    if (frames_.timeS[at] != timeS) continue;
    for (const std::size_t i : added) entries_[i].values[at] = valueOf(entries_[i], *sample);
  }
}

std::size_t LiveSeries::update() {
  if (!history_) return 0;
  const auto keptFromUs = history_->oldestUs();
  // After a long time without update() the history has dropped samples that were never taken.
  bool missed = newestUs_ && keptFromUs && *keptFromUs > *newestUs_;
  const auto samples =
      history_->after(newestUs_.value_or(std::numeric_limits<std::int64_t>::min()));
  for (const SharedSignalSample& sample : samples) {
    if (!originUs_) originUs_ = sample->hostUs;
    const bool told = breakAfterUs_ && sample->hostUs > *breakAfterUs_;
    if (told) breakAfterUs_.reset();
    if (!empty() && (sample->afterGap || missed || told))
      frames_.breaks.push_back(frames_.timeS.size() - 1);
    missed = false;
    frames_.timeS.push_back(secondsOf(sample->hostUs));
    for (Entry& entry : entries_)
      if (!entry.isColumn()) entry.values.push_back(valueOf(entry, *sample));
    newestUs_ = sample->hostUs;
  }
  for (Entry& entry : entries_) takeColumn(entry);
  if (const auto oldestUs = history_->oldestUs()) forgetBefore(*oldestUs);
  return samples.size();
}

void LiveSeries::takeColumn(Entry& entry) {
  if (!entry.isColumn() || !history_ || !originUs_) return;
  const ColumnRows rows =
      history_->column(entry.choice.series,
                       entry.choice.column,
                       entry.newestUs.value_or(std::numeric_limits<std::int64_t>::min()));
  if (rows.hostUs.empty()) return;
  Times& own = entry.own;
  for (const std::size_t index : rows.afterGaps)
    if (const std::size_t at = own.timeS.size() + index; at > 0) own.breaks.push_back(at - 1);
  for (const std::int64_t hostUs : rows.hostUs) own.timeS.push_back(secondsOf(hostUs));
  entry.values.insert(entry.values.end(), rows.values.begin(), rows.values.end());
  entry.newestUs = rows.hostUs.back();
  entry.gapS = static_cast<double>(rows.gapUs) / kUsPerS;
}

void LiveSeries::breakAfter(std::int64_t hostUs) {
  if (!newestUs_ || hostUs >= *newestUs_) {
    breakAfterUs_ = hostUs;
    return;
  }
  const auto index = frames_.indexAt(secondsOf(hostUs));
  if (!index) return;
  const auto at = std::ranges::lower_bound(frames_.breaks, *index);
  if (at == frames_.breaks.end() || *at != *index) frames_.breaks.insert(at, *index);
}

void LiveSeries::forgetBefore(std::int64_t hostUs) {
  const double oldestS = secondsOf(hostUs);
  const std::size_t removed = frames_.forgetBefore(oldestS);
  for (Entry& entry : entries_) {
    const std::size_t count = entry.isColumn() ? entry.own.forgetBefore(oldestS) : removed;
    entry.values.erase(entry.values.begin(),
                       entry.values.begin() + static_cast<std::ptrdiff_t>(count));
  }
}

std::size_t LiveSeries::Times::forgetBefore(double oldestS) {
  while (first < timeS.size() && timeS[first] < oldestS) ++first;
  if (first < kMinRemoved || 2 * first < timeS.size()) return 0;
  const std::size_t removed = first;
  timeS.erase(timeS.begin(), timeS.begin() + static_cast<std::ptrdiff_t>(removed));
  std::erase_if(breaks, [removed](std::size_t index) { return index < removed; });
  for (std::size_t& index : breaks) index -= removed;
  first = 0;
  return removed;
}

const LiveSeries::Entry* LiveSeries::find(const SeriesChoice& choice) const {
  const auto found = std::find_if(
      entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.choice == choice; });
  return found == entries_.end() ? nullptr : &*found;
}

std::vector<SeriesPoint> LiveSeries::points(const SeriesChoice& choice,
                                            const DecimationOptions& options) const {
  const Entry* entry = find(choice);
  if (!entry || timesOf(*entry).empty()) return {};
  const Times& times = timesOf(*entry);
  DecimationOptions all = options;
  std::vector<std::size_t> breaks;
  for (const std::size_t index : times.breaks)
    if (index >= times.first) breaks.push_back(index - times.first);
  all.breaks = breaks;
  return minMaxDecimated(std::span(times.timeS).subspan(times.first),
                         std::span(entry->values).subspan(times.first),
                         all);
}

std::optional<std::size_t> LiveSeries::Times::indexAt(double atS) const {
  const auto after =
      std::upper_bound(timeS.begin() + static_cast<std::ptrdiff_t>(first), timeS.end(), atS);
  const auto index = static_cast<std::size_t>(after - timeS.begin());
  return index == first ? std::nullopt : std::optional(index - 1);
}

bool LiveSeries::Times::breaksAt(std::size_t index) const {
  return std::binary_search(breaks.begin(), breaks.end(), index);
}

std::optional<double> LiveSeries::valueAt(const SeriesChoice& choice, double timeS) const {
  const Entry* entry = find(choice);
  if (!entry) return std::nullopt;
  const Times& times = timesOf(*entry);
  const auto index = times.indexAt(timeS);
  if (!index || timeS > std::max(newestS(), times.timeS.back())) return std::nullopt;
  if (timeS > times.timeS[*index] && times.breaksAt(*index)) return std::nullopt;
  if (timeS > times.timeS.back() + entry->gapS) return std::nullopt;  // only of a column
  const double value = entry->values[*index];
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<double> LiveSeries::sampleTimeAt(double timeS) const {
  return sampleTimeBeside(timeS, 0);
}

std::optional<double> LiveSeries::sampleTimeBeside(double timeS, std::ptrdiff_t samples) const {
  if (empty()) return std::nullopt;
  const auto first = static_cast<std::ptrdiff_t>(frames_.first);
  const auto at =
      static_cast<std::ptrdiff_t>(frames_.indexAt(timeS).value_or(frames_.first)) + samples;
  return frames_.timeS[static_cast<std::size_t>(
      std::clamp(at, first, static_cast<std::ptrdiff_t>(frames_.timeS.size()) - 1))];
}

std::optional<TimeSpan> LiveSeries::gapAt(double timeS) const {
  const auto index = frames_.indexAt(timeS);
  if (!index || timeS <= frames_.timeS[*index] || !frames_.breaksAt(*index)) return std::nullopt;
  return TimeSpan{frames_.timeS[*index], frames_.timeS[*index + 1]};
}

std::optional<std::pair<double, double>> LiveSeries::extremes(const SeriesChoice& choice,
                                                              double fromS,
                                                              double toS) const {
  const Entry* entry = find(choice);
  if (!entry) return std::nullopt;
  const Times& times = timesOf(*entry);
  const auto begin = times.timeS.begin() + static_cast<std::ptrdiff_t>(times.first);
  const auto indexOf = [&](auto at) { return static_cast<std::size_t>(at - times.timeS.begin()); };
  const std::size_t from = indexOf(std::lower_bound(begin, times.timeS.end(), fromS));
  const std::size_t to = indexOf(std::upper_bound(begin, times.timeS.end(), toS));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  // Comparisons with NaN are false.
  for (std::size_t i = from; i < to; ++i) {
    if (entry->values[i] < low) low = entry->values[i];
    if (entry->values[i] > high) high = entry->values[i];
  }
  if (!(low <= high)) return std::nullopt;
  return std::pair(low, high);
}

std::vector<TimeSpan> LiveSeries::gaps() const {
  std::vector<TimeSpan> spans;
  for (const std::size_t index : frames_.breaks)
    if (index >= frames_.first) spans.push_back({frames_.timeS[index], frames_.timeS[index + 1]});
  return spans;
}

}  // namespace palpate
