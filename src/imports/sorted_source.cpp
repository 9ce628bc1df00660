#include "imports/sorted_source.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxSortedNumbers = 1u << 23;
constexpr std::size_t kNumbersOfRow = 24;  // what a row takes beside its values

}  // namespace

void findTimeWithin(const PlannedSeries& series, TableRow& row) {
  if (!series.timeWithin || !row.complete) return;
  constexpr double kLargestExact = 9007199254740992.0;  // 2^53
  const double number = row.values[*series.timeWithin];
  row.time = {.state = std::isfinite(number) ? CellState::kNumber : CellState::kNotFinite,
              .number = number};
  if (number == std::floor(number) && std::abs(number) < kLargestExact)
    row.time.whole = static_cast<std::int64_t>(number);
}

TimesOfRows timesOfRows(TableSource& source,
                        const PlannedSeries& series,
                        TimeReader times,
                        std::uint64_t mostRows) {
  if (series.timeWithin)
    source.start(series.columns, std::nullopt);
  else
    source.start({}, series.time);
  TimesOfRows found;
  std::optional<std::int64_t> last;
  TableRow row;
  for (std::uint64_t i = 0; i < mostRows && source.next(row); ++i) {
    findTimeWithin(series, row);
    auto us = row.complete ? times.us(row.time) : std::nullopt;
    if (!us) continue;
    if (const auto whole = times.wholeOf(row.time); whole && times.mayRestart(*whole)) {
      times.restart();
      us = times.us(row.time);
    }
    if (!us) continue;
    found.ascend = found.ascend && *us >= last.value_or(*us);
    found.leastUs = std::min(*us, found.leastUs.value_or(*us));
    last = us;
    times.keep();
  }
  return found;
}

SortedSource::SortedSource(std::shared_ptr<TableSource> source,
                           const PlannedSeries& series,
                           const TimeReader& times,
                           std::uint64_t mostRows)
    : source_(std::move(source)), series_(series), times_(times), mostRows_(mostRows) {}

void SortedSource::start(std::span<const std::size_t> columns, std::optional<std::size_t> time) {
  rows_.clear();
  names_.clear();
  next_ = 0;
  for (const std::size_t c : columns)
    for (std::size_t i = 0; i < source_->columns()[c].width(); ++i)
      names_.push_back(source_->columns()[c].name);
  source_->start(columns, time);
  std::int64_t us = INT64_MIN;
  TimeReader times = times_;
  TableRow row;
  while (rows_.size() < mostRows_ && source_->next(row)) {
    findTimeWithin(series_, row);
    if (const auto known = row.complete ? times.us(row.time) : std::nullopt) us = *known;
    if ((rows_.size() + 1) * (names_.size() + kNumbersOfRow) > kMaxSortedNumbers)
      throw FormatError(path(), "time: too many rows to be sorted by time; sort the file");
    Kept kept{us, row, std::string(row.time.text), {}};
    for (std::size_t i = 0; i < row.states.size() && row.complete && kept.text.empty(); ++i)
      if (row.states[i] == CellState::kText) kept.text = source_->textOf(i);
    rows_.push_back(std::move(kept));
  }
  std::stable_sort(
      rows_.begin(), rows_.end(), [](const Kept& a, const Kept& b) { return a.us < b.us; });
}

bool SortedSource::next(TableRow& row) {
  if (next_ == rows_.size()) return false;
  row = rows_[next_].row;
  row.time.text = rows_[next_].time;
  ++next_;
  return true;
}

double SortedSource::fraction() const noexcept {
  return rows_.empty() ? 1.0 : static_cast<double>(next_) / static_cast<double>(rows_.size());
}

std::string SortedSource::textOf(std::size_t index) const {
  const Kept& kept = rows_.at(next_ - 1);
  return kept.row.states.at(index) == CellState::kText ? kept.text
                                                       : numberText(kept.row.values.at(index));
}

std::string SortedSource::placeOf(std::size_t index) const {
  return shortened(names_.at(index)) + ": " + inQuotes(textOf(index));
}

}  // namespace palpate
