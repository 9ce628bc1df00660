#include "palpate/live/live_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "palpate/core/time.h"

namespace palpate {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
// Forgotten samples are removed when there are so many, and at least as many as others.
constexpr std::size_t kLeastRemoved = 1024;

double valueIn(const std::vector<double>& values, std::size_t index) {
  return index < values.size() ? values[index] : kNoValue;
}

}  // namespace

void LiveSeries::setHistory(const SignalHistory* history) {
  history_ = history;
  originUs_.reset();
  newestUs_.reset();
  timeS_.clear();
  first_ = 0;
  breaks_.clear();
  breakAfterUs_.reset();
  for (Entry& entry : entries_) entry.values.clear();
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
    case SeriesChoice::Kind::kColumn:
      for (const FurtherSample& each : sample.further) {
        if (each.series->name != choice.series) continue;
        const auto& columns = each.series->columns;
        for (std::size_t i = 0; i < columns.size(); ++i)
          if (columns[i].name == choice.column) return valueIn(each.sample.values, i);
      }
      return kNoValue;
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
    if (known != entries_.end() && known->values.size() == timeS_.size()) {
      entries.push_back(std::move(*known));
      known->values.clear();
      continue;
    }
    entries.push_back({.choice = choice, .layout = {}, .chosen = {}, .values = {}});
    entries.back().values.assign(timeS_.size(), kNoValue);
    added.push_back(entries.size() - 1);
  }
  entries_ = std::move(entries);
  if (added.empty() || !history_ || empty()) return;
  std::size_t at = first_;
  for (const SharedSignalSample& sample :
       history_->after(std::numeric_limits<std::int64_t>::min())) {
    if (sample->hostUs > *newestUs_) break;
    const double timeS = secondsOf(sample->hostUs);
    while (at < timeS_.size() && timeS_[at] < timeS) ++at;
    if (at == timeS_.size()) break;
    if (timeS_[at] != timeS) continue;
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
    if (!empty() && (sample->afterGap || missed || told)) breaks_.push_back(timeS_.size() - 1);
    missed = false;
    timeS_.push_back(secondsOf(sample->hostUs));
    for (Entry& entry : entries_) entry.values.push_back(valueOf(entry, *sample));
    newestUs_ = sample->hostUs;
  }
  if (const auto oldestUs = history_->oldestUs()) forgetBefore(*oldestUs);
  return samples.size();
}

void LiveSeries::breakAfter(std::int64_t hostUs) {
  if (!newestUs_ || hostUs >= *newestUs_) {
    breakAfterUs_ = hostUs;
    return;
  }
  const auto index = indexAt(secondsOf(hostUs));
  if (!index) return;
  const auto at = std::ranges::lower_bound(breaks_, *index);
  if (at == breaks_.end() || *at != *index) breaks_.insert(at, *index);
}

void LiveSeries::forgetBefore(std::int64_t hostUs) {
  const double oldestS = secondsOf(hostUs);
  while (first_ < timeS_.size() && timeS_[first_] < oldestS) ++first_;
  if (first_ < kLeastRemoved || 2 * first_ < timeS_.size()) return;
  const auto removed = static_cast<std::ptrdiff_t>(first_);
  timeS_.erase(timeS_.begin(), timeS_.begin() + removed);
  for (Entry& entry : entries_)
    entry.values.erase(entry.values.begin(), entry.values.begin() + removed);
  std::erase_if(breaks_, [this](std::size_t index) { return index < first_; });
  for (std::size_t& index : breaks_) index -= first_;
  first_ = 0;
}

const LiveSeries::Entry* LiveSeries::find(const SeriesChoice& choice) const {
  const auto found = std::find_if(
      entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.choice == choice; });
  return found == entries_.end() ? nullptr : &*found;
}

std::vector<SeriesPoint> LiveSeries::points(const SeriesChoice& choice,
                                            const DecimationOptions& options) const {
  const Entry* entry = find(choice);
  if (!entry || empty()) return {};
  DecimationOptions all = options;
  std::vector<std::size_t> breaks;
  for (const std::size_t index : breaks_)
    if (index >= first_) breaks.push_back(index - first_);
  all.breaks = breaks;
  return minMaxDecimated(
      std::span(timeS_).subspan(first_), std::span(entry->values).subspan(first_), all);
}

std::optional<std::size_t> LiveSeries::indexAt(double timeS) const {
  const auto after =
      std::upper_bound(timeS_.begin() + static_cast<std::ptrdiff_t>(first_), timeS_.end(), timeS);
  const auto index = static_cast<std::size_t>(after - timeS_.begin());
  return index == first_ ? std::nullopt : std::optional(index - 1);
}

std::optional<double> LiveSeries::valueAt(const SeriesChoice& choice, double timeS) const {
  const Entry* entry = find(choice);
  const auto index = indexAt(timeS);
  if (!entry || !index || timeS > newestS()) return std::nullopt;
  if (timeS > timeS_[*index] && std::binary_search(breaks_.begin(), breaks_.end(), *index))
    return std::nullopt;
  const double value = entry->values[*index];
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<double> LiveSeries::sampleTimeAt(double timeS) const {
  return sampleTimeBeside(timeS, 0);
}

std::optional<double> LiveSeries::sampleTimeBeside(double timeS, std::ptrdiff_t samples) const {
  if (empty()) return std::nullopt;
  const auto at = static_cast<std::ptrdiff_t>(indexAt(timeS).value_or(first_)) + samples;
  return timeS_[static_cast<std::size_t>(std::clamp(
      at, static_cast<std::ptrdiff_t>(first_), static_cast<std::ptrdiff_t>(timeS_.size()) - 1))];
}

std::optional<TimeSpan> LiveSeries::gapAt(double timeS) const {
  const auto index = indexAt(timeS);
  if (!index || timeS <= timeS_[*index] ||
      !std::binary_search(breaks_.begin(), breaks_.end(), *index))
    return std::nullopt;
  return TimeSpan{timeS_[*index], timeS_[*index + 1]};
}

std::optional<std::pair<double, double>> LiveSeries::extremes(const SeriesChoice& choice,
                                                              double fromS,
                                                              double toS) const {
  const Entry* entry = find(choice);
  if (!entry) return std::nullopt;
  const auto begin = timeS_.begin() + static_cast<std::ptrdiff_t>(first_);
  const auto from =
      static_cast<std::size_t>(std::lower_bound(begin, timeS_.end(), fromS) - timeS_.begin());
  const auto to =
      static_cast<std::size_t>(std::upper_bound(begin, timeS_.end(), toS) - timeS_.begin());
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
  for (const std::size_t index : breaks_)
    if (index >= first_) spans.push_back({timeS_[index], timeS_[index + 1]});
  return spans;
}

}  // namespace palpate
