#include "palpate/imports/import_time.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "palpate/core/number_text.h"

#include "imports/cell_text.h"

namespace palpate {
namespace {

constexpr double kLargestUs = 1e18;  // what a recording can hold
constexpr std::int64_t kUsPerDay = 86'400'000'000;
constexpr std::int64_t kCounterTurn = std::int64_t{1} << 32;
// How far a counter of 32 bits goes on at most after it started again.
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

// Reads one or two digits; moves `at` behind them.
std::optional<int> shortNumberAt(std::string_view text, std::size_t& at) {
  const std::size_t count = characterAt(text, at + 1, "0123456789") ? 2 : 1;
  const auto number = digitsAt(text, at, count);
  at += count;
  return number;
}

// Reads "10:31", "10:31:05", "10:31:05.123456" from `at` on [us]; moves `at` behind it.
std::optional<std::int64_t> timeOf24HoursUs(std::string_view text, std::size_t& at) {
  const auto hours = shortNumberAt(text, at);
  const auto minutes = digitsAt(text, at + 1, 2);
  if (!hours || !minutes || !characterAt(text, at, ":") || *hours > 23 || *minutes > 59)
    return std::nullopt;
  at += 3;
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

// The same, and "1:31:05 PM".
std::optional<std::int64_t> timeOfDayUs(std::string_view text, std::size_t& at) {
  constexpr std::int64_t kHalfDayUs = kUsPerDay / 2;
  const auto us = timeOf24HoursUs(text, at);
  const std::size_t word = at + (characterAt(text, at, " ") ? 1 : 0);
  if (!us || !characterAt(text, word, "AaPp") || !characterAt(text, word + 1, "Mm")) return us;
  constexpr std::int64_t kHourUs = kUsPerDay / 24;
  if (*us < kHourUs || *us >= 13 * kHourUs) return std::nullopt;
  at = word + 2;
  return *us % kHalfDayUs + (characterAt(text, word, "Pp") ? kHalfDayUs : 0);
}

// Reads "2026-11-22", "22.11.2026", and by the form "22/11/2026" or "11/22/2026" (or with "-"),
// from the beginning; moves `at` behind it.
std::optional<std::chrono::sys_days> dayOf(std::string_view text, std::size_t& at, TimeUnit form) {
  constexpr int kEarliestYear = 1900;
  constexpr int kLatestYear = 2200;
  auto year = digitsAt(text, 0, 4);
  std::optional<int> month;
  std::optional<int> day;
  if (year) {
    month = digitsAt(text, 5, 2);
    day = digitsAt(text, 8, 2);
    if (!characterAt(text, 4, "-/") || !characterAt(text, 7, "-/")) return std::nullopt;
    at = 10;
  } else {
    at = 0;
    day = shortNumberAt(text, at);
    const std::size_t mark = at++;
    month = shortNumberAt(text, at);
    year = digitsAt(text, at + 1, 4);
    const bool anyOrder = form == TimeUnit::kDayFirst || form == TimeUnit::kMonthFirst;
    if (!characterAt(text, mark, anyOrder ? "./-" : ".") ||
        !characterAt(text, at, text.substr(mark, 1)))
      return std::nullopt;
    if (form == TimeUnit::kMonthFirst && text[mark] != '.') std::swap(day, month);
    at += 5;
  }
  if (!year || !month || !day || *year < kEarliestYear || *year > kLatestYear) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date);
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
  constexpr std::array<std::string_view, 10> kNames = {
      "s", "ms", "us", "ns", "min", "h", "iso", "dmy", "mdy", "time of day"};
  return kNames[static_cast<std::size_t>(unit)];
}

std::optional<TimeUnit> timeUnitNamed(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, TimeUnit>, 43> kWords = {
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
       {"microsec", TimeUnit::kMicroseconds},
       {"microsecond", TimeUnit::kMicroseconds},
       {"microseconds", TimeUnit::kMicroseconds},
       {"ns", TimeUnit::kNanoseconds},
       {"nsec", TimeUnit::kNanoseconds},
       {"nsecs", TimeUnit::kNanoseconds},
       {"nanos", TimeUnit::kNanoseconds},
       {"nanosec", TimeUnit::kNanoseconds},
       {"nanosecs", TimeUnit::kNanoseconds},
       {"nanosecond", TimeUnit::kNanoseconds},
       {"nanoseconds", TimeUnit::kNanoseconds},
       {"min", TimeUnit::kMinutes},
       {"mins", TimeUnit::kMinutes},
       {"minute", TimeUnit::kMinutes},
       {"minutes", TimeUnit::kMinutes},
       {"h", TimeUnit::kHours},
       {"hr", TimeUnit::kHours},
       {"hour", TimeUnit::kHours},
       {"hours", TimeUnit::kHours},
       {"iso", TimeUnit::kDate},
       {"iso8601", TimeUnit::kDate},
       {"date", TimeUnit::kDate},
       {"datetime", TimeUnit::kDate},
       {"utc", TimeUnit::kDate},
       {"dmy", TimeUnit::kDayFirst},
       {"mdy", TimeUnit::kMonthFirst}}};
  const std::string small = smallLetters(name);
  for (const auto& [word, unit] : kWords)
    if (small == word) return unit;
  return std::nullopt;
}

std::optional<std::int64_t> parseDate(std::string_view text, bool* hasOffset, TimeUnit form) {
  if (hasOffset) *hasOffset = false;
  std::size_t at = 0;
  std::int64_t midnight = 0;
  if (form != TimeUnit::kClock) {
    const auto day = dayOf(text, at, form);
    if (!day) return std::nullopt;
    midnight = day->time_since_epoch().count() * kUsPerDay;
    if (at == text.size()) return midnight;
    if (!characterAt(text, at, "Tt _-,")) return std::nullopt;
    ++at;
    if (text[at - 1] == ',' && characterAt(text, at, " ")) ++at;
  }
  const auto within = timeOfDayUs(text, at);
  const auto zone = within ? zoneUs(text, at) : std::nullopt;
  if (!zone || (form == TimeUnit::kClock && at < text.size())) return std::nullopt;
  if (hasOffset) *hasOffset = at < text.size();
  return midnight + *within - *zone;
}

bool isDateText(std::string_view text) {
  for (const TimeUnit form : {TimeUnit::kDayFirst, TimeUnit::kMonthFirst, TimeUnit::kClock})
    if (parseDate(text, nullptr, form)) return true;
  return false;
}

DateForm dateFormOf(std::span<const std::string_view> dates) {
  const auto fit = [&](TimeUnit form) {
    return std::all_of(dates.begin(), dates.end(), [&](std::string_view date) {
      return parseDate(date, nullptr, form).has_value();
    });
  };
  const bool dayFirst = fit(TimeUnit::kDayFirst);
  const bool monthFirst = fit(TimeUnit::kMonthFirst);
  return fit(TimeUnit::kDate)     ? DateForm::kIso
         : dayFirst && monthFirst ? DateForm::kEither
         : dayFirst               ? DateForm::kDayFirst
         : monthFirst             ? DateForm::kMonthFirst
         : fit(TimeUnit::kClock)  ? DateForm::kClock
                                  : DateForm::kIso;
}

TimeUnit guessTimeUnit(double value, bool isWhole) {
  constexpr double kYear2000S = 946'684'800.0;
  if (std::abs(value) >= kYear2000S * 1e9) return TimeUnit::kNanoseconds;
  if (std::abs(value) >= kYear2000S * 1e6) return TimeUnit::kMicroseconds;
  if (std::abs(value) >= kYear2000S * 1e3) return TimeUnit::kMilliseconds;
  if (std::abs(value) >= kYear2000S) return TimeUnit::kSeconds;
  return isWhole ? TimeUnit::kMilliseconds : TimeUnit::kSeconds;
}

TimeReader::TimeReader(TimeUnit unit,
                       std::optional<std::int64_t> startUs,
                       char decimal,
                       double factor)
    : unit_(unit), startUs_(startUs), decimal_(decimal), factor_(factor) {}

std::int64_t TimeReader::turn() const noexcept {
  if (unit_ == TimeUnit::kClock) return kUsPerDay;
  const bool isCounter = unit_ == TimeUnit::kMilliseconds || unit_ == TimeUnit::kMicroseconds;
  return isCounter ? kCounterTurn : 0;
}

bool TimeReader::mayRestart(std::int64_t whole) const noexcept {
  const std::int64_t near = turn() / 20;
  return whole >= 0 && whole < near && keptWhole_ && *keptWhole_ >= turn() - near &&
         *keptWhole_ < turn();
}

bool TimeReader::goesOnFrom(std::int64_t whole, std::int64_t next) noexcept {
  return next > whole && next < whole + kNearTurn;
}

void TimeReader::restart() noexcept {
  base_ += turn();
  ++restarts_;
}

std::optional<std::int64_t> TimeReader::wholeOf(const TimeCell& cell) const {
  if (unit_ == TimeUnit::kClock)
    return parseDate(trimmedCell(cell.text), nullptr, TimeUnit::kClock);
  if (isDateUnit(unit_)) return std::nullopt;
  return cell.state == CellState::kText ? parseInteger(cell.text) : cell.whole;
}

std::optional<std::int64_t> TimeReader::usOfWhole(std::int64_t value) const {
  std::int64_t total = 0;
  if (__builtin_add_overflow(value, base_, &total)) return std::nullopt;
  if (factor_ != 1.0) return usOfNumber(static_cast<double>(total));
  constexpr std::array<std::int64_t, 6> kUsPerUnit = {
      1'000'000, 1000, 1, 0, 60'000'000, 3'600'000'000};
  if (unit_ == TimeUnit::kNanoseconds)  // rounded to the nearest, also before 1970
    return total / 1000 + (total % 1000 >= 500 ? 1 : 0) - (total % 1000 <= -500 ? 1 : 0);
  const std::int64_t factor =
      unit_ == TimeUnit::kClock ? 1 : kUsPerUnit[static_cast<std::size_t>(unit_)];
  if (std::abs(static_cast<double>(total)) * static_cast<double>(factor) > kLargestUs)
    return std::nullopt;
  return total * factor;
}

std::optional<std::int64_t> TimeReader::usOfNumber(double number) const {
  constexpr std::array<double, 6> kUsPerUnit = {1e6, 1e3, 1.0, 1e-3, 60e6, 3600e6};
  const double value = number * factor_ * kUsPerUnit[static_cast<std::size_t>(unit_)];
  if (!(std::abs(value) <= kLargestUs)) return std::nullopt;
  return std::llround(value);
}

std::optional<std::int64_t> TimeReader::us(const TimeCell& cell) {
  std::optional<std::int64_t> us;
  lastWhole_ = wholeOf(cell);
  std::optional<double> number;
  if (cell.state == CellState::kNumber)
    number = cell.number;
  else if (cell.state == CellState::kText)
    number = cellNumber(cell.text, decimal_);
  if (isDateUnit(unit_) && unit_ != TimeUnit::kClock) {
    bool hasOffset = false;
    const bool isText = cell.state == CellState::kText;
    us = isText ? parseDate(trimmedCell(cell.text), &hasOffset, unit_)
                : cell.whole;  // of datetime64
    assumedUtc_ = assumedUtc_ || (us && !hasOffset);
  } else if (lastWhole_) {
    us = usOfWhole(*lastWhole_);
  } else if (number && !isDateUnit(unit_)) {
    us = usOfNumber(*number);
  }
  if (!us || std::abs(static_cast<double>(*us)) > kLargestUs) return std::nullopt;
  const bool isDay = unit_ == TimeUnit::kClock && startUs_ && *startUs_ % kUsPerDay == 0;
  if (!shiftUs_) shiftUs_ = !startUs_ ? 0 : isDay ? *startUs_ : *startUs_ - *us;
  return *us + *shiftUs_;
}

}  // namespace palpate
