#include "palpate/live/signal_history.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/calibration/pressure_map.h"
#include "palpate/core/statistics.h"
#include "palpate/core/time.h"
#include "palpate/model/gap_detector.h"

namespace palpate {

KeptTaxels::KeptTaxels(const std::vector<float>& values) {
  const auto isZero = [](float value) { return value == 0.0F; };
  const auto active =
      values.size() - static_cast<std::size_t>(std::count_if(values.begin(), values.end(), isZero));
  if (active > 0 &&
      active * (sizeof(float) + sizeof(std::uint32_t)) >= values.size() * sizeof(float)) {
    values_ = values;
    return;
  }
  places_.reserve(active);
  values_.reserve(active);
  for (std::size_t place = 0; place < values.size(); ++place) {
    if (isZero(values[place])) continue;
    places_.push_back(static_cast<std::uint32_t>(place));
    values_.push_back(values[place]);
  }
}

double KeptTaxels::meanOf(const std::vector<bool>& chosen, std::size_t numChosen) const {
  if (numChosen == 0) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::size_t place = places_.empty() ? i : places_[i];
    if (place < chosen.size() && chosen[place]) sum += static_cast<double>(values_[i]);
  }
  return sum / static_cast<double>(numChosen);
}

std::size_t KeptTaxels::bytes() const noexcept {
  return places_.size() * sizeof(std::uint32_t) + values_.size() * sizeof(float);
}

std::size_t SignalSample::bytes() const noexcept {
  return sizeof(SignalSample) + rows.size() * sizeof(CharacteristicSignals) + taxels.bytes() +
         (anglesDeg.size() + temperatures.size() + forcesN.size()) * sizeof(double);
}

SignalHistory::SignalHistory(const SignalHistoryOptions& options) : options_(options) {
  if (!(options_.keepS > 0.0 && std::isfinite(options_.keepS)))
    throw std::invalid_argument("SignalHistoryOptions: keepS must be above 0");
  if (options_.keepSamples == 0)
    throw std::invalid_argument("SignalHistoryOptions: keepSamples must be at least 1");
  if (options_.keepBytes == 0)
    throw std::invalid_argument("SignalHistoryOptions: keepBytes must be at least 1");
}

std::int64_t SignalHistory::Intervals::gapUs() const {
  const std::int64_t medianUs =
      newestUs.empty() ? 0 : upperMedian(std::vector(newestUs.begin(), newestUs.end()));
  return gapThresholdUs(medianUs);
}

void SignalHistory::Intervals::add(std::int64_t us) {
  constexpr std::size_t kIntervals = 15;
  newestUs.push_back(us);
  if (newestUs.size() > kIntervals) newestUs.pop_front();
}

std::size_t SignalHistory::Kept::bytes() const noexcept {
  return hostUs.size() * (sizeof(std::int64_t) + 1) + values.size() * sizeof(double);
}

void SignalHistory::Kept::dropOldest() {
  hostUs.pop_front();
  afterGap.pop_front();
  values.erase(values.begin(),
               values.begin() + static_cast<std::ptrdiff_t>(series->columns.size()));
}

void SignalHistory::add(const FurtherSample& sample) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find_if(
      further_, [&](const Kept& each) { return each.series->name == sample.series->name; });
  Kept& kept =
      known == further_.end() ? further_.emplace_back(Kept{.series = sample.series}) : *known;
  if (kept.series->columns != sample.series->columns) kept = Kept{.series = sample.series};
  const std::int64_t hostUs = sample.sample.hostUs;
  bool afterGap = false;
  if (!kept.hostUs.empty()) {
    const std::int64_t intervalUs = hostUs - kept.hostUs.back();
    if (intervalUs <= 0) return;
    afterGap = intervalUs > kept.intervals.gapUs();
    kept.intervals.add(intervalUs);
  }
  kept.hostUs.push_back(hostUs);
  kept.afterGap.push_back(afterGap);
  kept.values.insert(kept.values.end(), sample.sample.values.begin(), sample.sample.values.end());
  dropOldRows(hostUs);
}

void SignalHistory::dropOldRows(std::int64_t newestUs) {
  const auto oldestUs = newestUs - static_cast<std::int64_t>(options_.keepS * kUsPerS);
  std::size_t bytes = 0;
  for (Kept& each : further_) {
    while (!each.hostUs.empty() && each.hostUs.front() < oldestUs) each.dropOldest();
    bytes += each.bytes();
  }
  while (bytes > options_.keepBytes) {
    Kept& largest = *std::ranges::max_element(further_, {}, &Kept::bytes);
    if (largest.hostUs.size() <= 1) return;
    bytes -= largest.bytes();
    largest.dropOldest();
    bytes += largest.bytes();
  }
}

ColumnRows SignalHistory::column(const std::string& series,
                                 const std::string& column,
                                 std::int64_t afterUs) const {
  const std::lock_guard lock(mutex_);
  ColumnRows rows;
  const auto kept =
      std::ranges::find_if(further_, [&](const Kept& each) { return each.series->name == series; });
  if (kept == further_.end()) return rows;
  const auto& columns = kept->series->columns;
  const auto at = std::ranges::find(columns, column, &Column::name);
  if (at == columns.end()) return rows;
  rows.gapUs = kept->intervals.gapUs();
  const auto first = std::ranges::upper_bound(kept->hostUs, afterUs) - kept->hostUs.begin();
  for (auto i = static_cast<std::size_t>(first); i < kept->hostUs.size(); ++i) {
    if (kept->afterGap[i]) rows.afterGaps.push_back(rows.hostUs.size());
    rows.hostUs.push_back(kept->hostUs[i]);
    rows.values.push_back(
        kept->values[i * columns.size() + static_cast<std::size_t>(at - columns.begin())]);
  }
  return rows;
}

void SignalHistory::add(const LiveResults& results) {
  auto sample = std::make_shared<SignalSample>();
  sample->hostUs = results.frame->hostUs;
  sample->rows.reserve(results.matrixSignals.size() + 1);
  sample->rows = results.matrixSignals;
  sample->rows.push_back(results.wholeSignals);
  sample->layout = results.frame->layout;
  sample->taxels = KeptTaxels(results.frame->allValues());
  if (results.angles) sample->anglesDeg = results.angles->values;
  if (results.temperatures) sample->temperatures = results.temperatures->values;
  if (results.pressure) {
    sample->forcesN.reserve(results.pressure->matrices.size() + 1);
    for (const MatrixPressure& matrix : results.pressure->matrices)
      sample->forcesN.push_back(matrix.forceN);
    sample->forcesN.push_back(results.pressure->forceN);
  }

  const std::lock_guard lock(mutex_);
  if (!samples_.empty()) {
    const std::int64_t intervalUs = sample->hostUs - samples_.back()->hostUs;
    if (intervalUs <= 0) return;
    sample->afterGap = intervalUs > intervals_.gapUs();
    intervals_.add(intervalUs);
  }
  bytes_ += sample->bytes();
  samples_.push_back(std::move(sample));
  const auto oldestUs =
      samples_.back()->hostUs - static_cast<std::int64_t>(options_.keepS * kUsPerS);
  // The newest sample is always kept.
  while (samples_.size() > 1 &&
         (samples_.size() > options_.keepSamples || bytes_ > options_.keepBytes ||
          samples_.front()->hostUs < oldestUs)) {
    bytes_ -= samples_.front()->bytes();
    samples_.pop_front();
  }
  if (!further_.empty()) dropOldRows(samples_.back()->hostUs);
}

void SignalHistory::clear() {
  const std::lock_guard lock(mutex_);
  samples_.clear();
  bytes_ = 0;
  intervals_ = {};
  further_.clear();
}

std::vector<SharedSignalSample> SignalHistory::after(std::int64_t hostUs) const {
  const std::lock_guard lock(mutex_);
  const auto from = std::upper_bound(
      samples_.begin(),
      samples_.end(),
      hostUs,
      [](std::int64_t us, const SharedSignalSample& sample) { return us < sample->hostUs; });
  return {from, samples_.end()};
}

std::optional<std::int64_t> SignalHistory::oldestUs() const {
  const std::lock_guard lock(mutex_);
  return samples_.empty() ? std::nullopt : std::optional(samples_.front()->hostUs);
}

std::size_t SignalHistory::size() const {
  const std::lock_guard lock(mutex_);
  return samples_.size();
}

std::size_t SignalHistory::bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t bytes = bytes_;
  for (const Kept& each : further_) bytes += each.bytes();
  return bytes;
}

}  // namespace palpate
