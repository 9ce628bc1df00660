#include "palpate/recording/import_time.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "palpate/core/number_text.h"

#include "recording/import/cell_text.h"

namespace palpate {
namespace {

constexpr double kLargestUs = 1e18;  // what a recording can hold
constexpr std::int64_t kCounterTurn = std::int64_t{1} << 32;
// How near to its turn a counter is when it starts again.
constexpr std::int64_t kNearTurn = kCounterTurn / 20;

std::optional<int> digitsAt(std::string_view text, std::size_t at, std::size_t count) {
  if (at + count > text.size()) return std::nullopt;
  int value = 0;
  for (std::size_t i = at; i < at + count; ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

bool characterAt(std::string_view text, std::size_t at, std::string_view allowed) {
  return at < text.size() && allowed.find(text[at]) != std::string_view::npos;
}

// Reads "10:31", "10:31:05", "10:31:05.123456" from `at` on [us]; moves `at` behind it.
std::optional<std::int64_t> timeOfDayUs(std::string_view text, std::size_t& at) {
  const auto hours = digitsAt(text, at, 2);
  const auto minutes = digitsAt(text, at + 3, 2);
  if (!hours || !minutes || !characterAt(text, at + 2, ":") || *hours > 23 || *minutes > 59)
    return std::nullopt;
  at += 5;
  std::int64_t us = (std::int64_t{*hours} * 60 + *minutes) * 60'000'000;
  if (!characterAt(text, at, ":")) return us;
  const auto seconds = digitsAt(text, at + 1, 2);
  if (!seconds || *seconds > 59) return std::nullopt;
  at += 3;
  us += std::int64_t{*seconds} * 1'000'000;
  if (!characterAt(text, at, ".,")) return us;
  std::int64_t nanoseconds = 0;
  std::int64_t unit = 100'000'000;
  const std::size_t first = ++at;
  for (; characterAt(text, at, "0123456789"); ++at, unit /= 10)
    nanoseconds += unit * (text[at] - '0');
  if (at == first) return std::nullopt;
  return us + (nanoseconds + 500) / 1000;
}

// Reads "Z", "+01:00", "+0100", "+01" or nothing at the end of the text [us].
std::optional<std::int64_t> zoneUs(std::string_view text, std::size_t at) {
  if (at == text.size() || text.substr(at) == "Z" || text.substr(at) == " UTC") return 0;
  if (!characterAt(text, at, "+-")) return std::nullopt;
  const auto hours = digitsAt(text, at + 1, 2);
  std::size_t next = at + 3;
  if (characterAt(text, next, ":")) ++next;
  const auto minutes = next < text.size() ? digitsAt(text, next, 2) : std::optional<int>(0);
  if (!hours || !minutes || *hours > 14 || *minutes > 59 ||
      (next < text.size() && next + 2 != text.size()))
    return std::nullopt;
  const std::int64_t us = (std::int64_t{*hours} * 60 + *minutes) * 60'000'000;
  return text[at] == '-' ? -us : us;
}

}  // namespace

std::string_view nameOf(TimeUnit unit) {
  constexpr std::array<std::string_view, 5> kNames = {"s", "ms", "us", "ns", "iso"};
  return kNames[static_cast<std::size_t>(unit)];
}

std::optional<TimeUnit> timeUnitNamed(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, TimeUnit>, 29> kWords = {
      {{"s", TimeUnit::kSeconds},
       {"sec", TimeUnit::kSeconds},
       {"secs", TimeUnit::kSeconds},
       {"second", TimeUnit::kSeconds},
       {"seconds", TimeUnit::kSeconds},
       {"ms", TimeUnit::kMilliseconds},
       {"msec", TimeUnit::kMilliseconds},
       {"msecs", TimeUnit::kMilliseconds},
       {"millis", TimeUnit::kMilliseconds},
       {"millisecond", TimeUnit::kMilliseconds},
       {"milliseconds", TimeUnit::kMilliseconds},
       {"us", TimeUnit::kMicroseconds},
       {"usec", TimeUnit::kMicroseconds},
       {"usecs", TimeUnit::kMicroseconds},
       {"\xC2\xB5s", TimeUnit::kMicroseconds},
       {"\xCE\xBCs", TimeUnit::kMicroseconds},
       {"micros", TimeUnit::kMicroseconds},
       {"microsecond", TimeUnit::kMicroseconds},
       {"microseconds", TimeUnit::kMicroseconds},
       {"ns", TimeUnit::kNanoseconds},
       {"nsec", TimeUnit::kNanoseconds},
       {"nanos", TimeUnit::kNanoseconds},
       {"nanosecond", TimeUnit::kNanoseconds},
       {"nanoseconds", TimeUnit::kNanoseconds},
       {"iso", TimeUnit::kDate},
       {"iso8601", TimeUnit::kDate},
       {"date", TimeUnit::kDate},
       {"datetime", TimeUnit::kDate},
       {"utc", TimeUnit::kDate}}};
  const std::string small = smallLetters(name);
  for (const auto& [word, unit] : kWords)
    if (small == word) return unit;
  return std::nullopt;
}

std::optional<std::int64_t> parseDate(std::string_view text, bool* hasOffset) {
  if (hasOffset) *hasOffset = false;
  constexpr int kEarliestYear = 1900;
  constexpr int kLatestYear = 2200;
  const auto year = digitsAt(text, 0, 4);
  const auto month = digitsAt(text, 5, 2);
  const auto day = digitsAt(text, 8, 2);
  if (!year || !month || !day || !characterAt(text, 4, "-/") || !characterAt(text, 7, "-/") ||
      *year < kEarliestYear || *year > kLatestYear)
    return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  constexpr std::int64_t kUsPerDay = 86'400'000'000;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  if (text.size() == 10) return days * kUsPerDay;
  if (!characterAt(text, 10, "Tt ")) return std::nullopt;
  std::size_t at = 11;
  const auto within = timeOfDayUs(text, at);
  if (!within) return std::nullopt;
  const auto zone = zoneUs(text, at);
  if (!zone) return std::nullopt;
  if (hasOffset) *hasOffset = at < text.size();
  return days * kUsPerDay + *within - *zone;
}

TimeUnit guessTimeUnit(double value, bool isWhole) {
  constexpr double kYear2000S = 946'684'800.0;
  if (std::abs(value) >= kYear2000S * 1e9) return TimeUnit::kNanoseconds;
  if (std::abs(value) >= kYear2000S * 1e6) return TimeUnit::kMicroseconds;
  if (std::abs(value) >= kYear2000S * 1e3) return TimeUnit::kMilliseconds;
  if (std::abs(value) >= kYear2000S) return TimeUnit::kSeconds;
  return isWhole ? TimeUnit::kMilliseconds : TimeUnit::kSeconds;
}

TimeReader::TimeReader(TimeUnit unit, std::optional<std::int64_t> startUs, char decimal)
    : unit_(unit), startUs_(startUs), decimal_(decimal) {}

bool TimeReader::mayRestart(std::int64_t whole) const noexcept {
  const bool isCounter = unit_ == TimeUnit::kMilliseconds || unit_ == TimeUnit::kMicroseconds;
  return isCounter && whole >= 0 && whole < kNearTurn && keptWhole_ &&
         *keptWhole_ >= kCounterTurn - kNearTurn && *keptWhole_ < kCounterTurn;
}

bool TimeReader::goesOnFrom(std::int64_t whole, std::int64_t next) noexcept {
  return next > whole && next < whole + kNearTurn;
}

void TimeReader::restart() noexcept {
  base_ += kCounterTurn;
  ++restarts_;
}

std::optional<std::int64_t> TimeReader::wholeOf(const TimeCell& cell) const {
  if (unit_ == TimeUnit::kDate) return std::nullopt;
  return cell.state == CellState::kText ? parseInteger(cell.text) : cell.whole;
}

std::optional<std::int64_t> TimeReader::usOfWhole(std::int64_t value) const {
  std::int64_t total = 0;
  if (__builtin_add_overflow(value, base_, &total)) return std::nullopt;
  constexpr std::array<std::int64_t, 3> kUsPerUnit = {1'000'000, 1000, 1};
  if (unit_ == TimeUnit::kNanoseconds)  // rounded to the nearest, also before 1970
    return total / 1000 + (total % 1000 >= 500 ? 1 : 0) - (total % 1000 <= -500 ? 1 : 0);
  const std::int64_t factor = kUsPerUnit[static_cast<std::size_t>(unit_)];
  if (std::abs(static_cast<double>(total)) * static_cast<double>(factor) > kLargestUs)
    return std::nullopt;
  return total * factor;
}

std::optional<std::int64_t> TimeReader::us(const TimeCell& cell) {
  std::optional<std::int64_t> us;
  lastWhole_ = wholeOf(cell);
  std::optional<double> number;
  if (cell.state == CellState::kNumber)
    number = cell.number;
  else if (cell.state == CellState::kText)
    number = cellNumber(cell.text, decimal_);
  if (unit_ == TimeUnit::kDate) {
    bool hasOffset = false;
    const bool isText = cell.state == CellState::kText;
    us = isText ? parseDate(trimmedCell(cell.text), &hasOffset) : cell.whole;  // of datetime64
    assumedUtc_ = assumedUtc_ || (us && !hasOffset);
  } else if (lastWhole_) {
    us = usOfWhole(*lastWhole_);
  } else if (number) {
    constexpr std::array<double, 4> kUsPerUnit = {1e6, 1e3, 1.0, 1e-3};
    const double value = *number * kUsPerUnit[static_cast<std::size_t>(unit_)];
    if (std::abs(value) <= kLargestUs) us = std::llround(value);
  }
  if (!us || std::abs(static_cast<double>(*us)) > kLargestUs) return std::nullopt;
  if (!shiftUs_) shiftUs_ = startUs_ ? *startUs_ - *us : 0;
  return *us + *shiftUs_;
}

}  // namespace palpate
