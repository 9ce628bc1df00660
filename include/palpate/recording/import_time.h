// Times of an imported table as host time [us since 1970].
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <palpate/recording/table_source.h>

namespace palpate {

enum class TimeUnit { kSeconds, kMilliseconds, kMicroseconds, kNanoseconds, kDate };

// "s", "ms", "us", "ns", "iso"; also the words that headers use ("seconds", "millis", "msec").
std::string_view nameOf(TimeUnit unit);
std::optional<TimeUnit> timeUnitNamed(std::string_view name);

// Host time [us since 1970] of a date of ISO 8601: "2026-11-22T10:31:05.123Z", with a blank instead
// of the T, with up to nine digits of a second, with an offset "+01:00"; without one it is UTC.
// Nothing when it is no such date (or one outside of 1900..2200).
std::optional<std::int64_t> parseDate(std::string_view text);

// What the values of a column that has no unit are, from one of them: seconds, milliseconds,
// microseconds or nanoseconds since 1970 by their size; smaller ones are seconds when they have
// decimals, and milliseconds otherwise (a counter such as Arduino's millis()).
TimeUnit guessTimeUnit(double value, bool isWhole);

// Converts the times of one table, in order. Whole numbers are converted without rounding errors.
//
// A counter of 32 bits starts again at 0: micros() after 71.6 minutes, millis() after 49.7 days. A
// whole number of milliseconds or microseconds that falls by more than half of 2^32 continues the
// count.
class TimeReader {
 public:
  // `startUs`: host time of the first row [us since 1970]; empty: times are as in the file.
  // `decimal`: the character before decimals in texts.
  TimeReader(TimeUnit unit, std::optional<std::int64_t> startUs, char decimal = '.');

  // Nothing when the cell holds no time.
  std::optional<std::int64_t> us(const TimeCell& cell);
  // How often the counter started again.
  std::uint64_t numRestarts() const noexcept { return restarts_; }

 private:
  std::optional<std::int64_t> usOfWhole(std::int64_t value);

  TimeUnit unit_;
  std::optional<std::int64_t> startUs_;
  char decimal_;
  std::optional<std::int64_t> shiftUs_;  // added to every time; known from the first one
  std::int64_t lastWhole_ = 0;
  std::int64_t base_ = 0;  // what earlier turns of the counter amount to
  std::uint64_t restarts_ = 0;
};

}  // namespace palpate
