// Times of an imported table as host time [us since 1970].
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <palpate/imports/table_source.h>

namespace palpate {

enum class TimeUnit {
  kSeconds,
  kMilliseconds,
  kMicroseconds,
  kNanoseconds,
  kMinutes,
  kHours,
  kDate,        // of ISO 8601, or 22.11.2026
  kDayFirst,    // or 22/11/2026
  kMonthFirst,  // or 11/22/2026
  kClock        // a time of day without a date
};
constexpr bool isDateUnit(TimeUnit unit) { return unit >= TimeUnit::kDate; }

// "s", "ms", "us", "ns", "min", "h", "iso", "dmy", "mdy"; also the words that headers use
// ("seconds", "millis", "msec").
std::string_view nameOf(TimeUnit unit);
std::optional<TimeUnit> timeUnitNamed(std::string_view name);

// Host time [us since 1970] of a date of ISO 8601: "2026-11-22T10:31:05.123Z", with a blank, "-" or
// "_" instead of the T, with up to nine digits of a second, with an offset "+01:00"; without one it
// is UTC. Also of "22.11.2026 10:31:05,1" and "10:31:05 PM", and by the form (kDayFirst,
// kMonthFirst) of "22/11/2026" or "11/22/2026"; of kClock of a time of day alone: since midnight.
// Nothing when it is no such date (or one outside of 1900..2200). `hasOffset`: whether the date has
// an offset, or says UTC.
std::optional<std::int64_t> parseDate(std::string_view text,
                                      bool* hasOffset = nullptr,
                                      TimeUnit form = TimeUnit::kDate);
// Whether a text is a date or a time of day in one of these forms.
bool isDateText(std::string_view text);
// The form in which all of these dates can be read.
DateForm dateFormOf(std::span<const std::string_view> dates);

// What the values of a column that has no unit are, from one of them: seconds, milliseconds,
// microseconds or nanoseconds since 1970 by their size; smaller ones are seconds when they have
// decimals, and milliseconds otherwise (a counter such as Arduino's millis()).
TimeUnit guessTimeUnit(double value, bool isWhole);

// Converts the times of one table, in order. Whole numbers are converted without rounding errors.
//
// A time of day goes on after midnight. A counter of 32 bits starts again at 0: micros() after 71.6
// minutes, millis() after 49.7 days. That is a whole number of milliseconds or microseconds that
// falls from the last to the first 5 % of 2^32, and from which the next row goes on (mayRestart(),
// goesOnFrom()): a garbled number is none.
class TimeReader {
 public:
  // `startUs`: host time of the first row [us since 1970]; empty: times are as in the file. Of
  // times of day, midnight of a day: that day. `decimal`: the character before decimals in texts.
  // `factor`: a time is a number x factor of the unit.
  TimeReader(TimeUnit unit,
             std::optional<std::int64_t> startUs,
             char decimal = '.',
             double factor = 1.0);

  // Nothing when the cell holds no time, or one that a recording can't hold.
  std::optional<std::int64_t> us(const TimeCell& cell);
  // What is added to every time [us]; known after the first us(), unless it is set before.
  std::optional<std::int64_t> shiftUs() const noexcept { return shiftUs_; }
  void setShiftUs(std::int64_t shiftUs) noexcept { shiftUs_ = shiftUs; }
  // The row of the last us() is taken: the next row is compared with it.
  void keep() noexcept { keptWhole_ = lastWhole_; }
  // The whole number of a cell, if it is one.
  std::optional<std::int64_t> wholeOf(const TimeCell& cell) const;
  // Whether the counter may have started again at this whole number. If the next one goes on from
  // it, restart() continues the count, and us() has the time of both.
  bool mayRestart(std::int64_t whole) const noexcept;
  static bool goesOnFrom(std::int64_t whole, std::int64_t next) noexcept;
  void restart() noexcept;
  // Whether dates had no offset, and were taken as UTC.
  bool assumedUtc() const noexcept { return assumedUtc_; }
  // How often the counter started again, or midnight passed.
  std::uint64_t numRestarts() const noexcept { return restarts_; }

 private:
  std::int64_t turn() const noexcept;  // of the counter; 0: it is none
  std::optional<std::int64_t> usOfWhole(std::int64_t value) const;
  std::optional<std::int64_t> usOfNumber(double number) const;

  TimeUnit unit_;
  std::optional<std::int64_t> startUs_;
  char decimal_;
  double factor_;
  std::optional<std::int64_t> shiftUs_;    // added to every time; known from the first one
  std::optional<std::int64_t> lastWhole_;  // of the last us()
  std::optional<std::int64_t> keptWhole_;  // of the last row that was taken
  bool assumedUtc_ = false;
  std::int64_t base_ = 0;  // what earlier turns of the counter amount to
  std::uint64_t restarts_ = 0;
};

}  // namespace palpate
