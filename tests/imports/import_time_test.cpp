#include "palpate/imports/import_time.h"

#include <gtest/gtest.h>

namespace palpate::import_time_test {
namespace {

TimeCell text(std::string_view value) { return {.state = CellState::kText, .text = value}; }
TimeCell whole(std::int64_t value) {
  return {.state = CellState::kNumber, .whole = value, .number = static_cast<double>(value)};
}

// 2014-11-27 10:31:05 UTC is 1417084265 s after 1970 (date -u -d "2014-11-27 10:31:05" +%s).
TEST(ImportTime, DatesAreReadToTheMicrosecond) {
  constexpr std::int64_t kUs = 1'417'084'265'000'000;
  for (const char* date : {"2014-11-27T10:31:05Z",
                           "2014-11-27 10:31:05",
                           "2014-11-27T10:31:05.000",
                           "2014-11-27T11:31:05+01:00",
                           "2014-11-27T05:01:05-0530",
                           "2014/11/27 10:31:05 UTC"})
    EXPECT_EQ(parseDate(date), kUs) << date;
  EXPECT_EQ(parseDate("2014-11-27T10:31:05.123456Z"), kUs + 123'456);
  EXPECT_EQ(parseDate("2014-11-27T10:31:05.1234567Z"), kUs + 123'457);
  EXPECT_EQ(parseDate("2014-11-27T10:31"), kUs - 5'000'000);
  EXPECT_EQ(parseDate("1970-01-01"), 0);
  EXPECT_EQ(parseDate("1969-12-31T23:59:59Z"), -1'000'000);
}

TEST(ImportTime, WhatIsNoDateIsNone) {
  for (const char* date : {"",
                           "12.5",
                           "2014",
                           "2014-13-01",
                           "2014-02-30",
                           "2014-11-27T25:00:00",
                           "2014-11-27T10:31:05.",
                           "2014-11-27T10:31:05X",
                           "2014-11-27T10:31:05+1",
                           "0001-01-01",
                           "2014-11-27T10:31:05+01:00x"})
    EXPECT_EQ(parseDate(date), std::nullopt) << date;
}

// imports 22.
TEST(ImportTime, DatesOfTheUsualFormsAreRead) {
  constexpr std::int64_t kUs = 1'417'084'265'000'000;
  const auto read = [](const char* date, TimeUnit form = TimeUnit::kDate) {
    return parseDate(date, nullptr, form);
  };
  EXPECT_EQ(read("27.11.2014 10:31:05,0"), kUs);
  EXPECT_EQ(read("2014-11-27-10:31:05"), kUs);
  EXPECT_EQ(read("2014-11-27_10:31:05"), kUs);
  EXPECT_EQ(read("27.11.2014, 10:31:05"), kUs);
  EXPECT_EQ(read("27/11/2014 10:31:05", TimeUnit::kDayFirst), kUs);
  EXPECT_EQ(read("27-11-2014 10:31:05", TimeUnit::kDayFirst), kUs);
  EXPECT_EQ(read("11/27/2014 10:31:05", TimeUnit::kMonthFirst), kUs);
  EXPECT_EQ(read("11/27/2014 10:31:05 AM", TimeUnit::kMonthFirst), kUs);
  EXPECT_EQ(read("11/27/2014 10:31:05 pm", TimeUnit::kMonthFirst), kUs + 43'200'000'000);
  // 3 April and 4 March 2014: date -u -d 2014-04-03 +%s.
  EXPECT_EQ(read("3/4/2014", TimeUnit::kDayFirst), 1'396'483'200'000'000);
  EXPECT_EQ(read("3/4/2014", TimeUnit::kMonthFirst), 1'393'891'200'000'000);
  EXPECT_EQ(read("3/4/2014"), std::nullopt) << "either";
  EXPECT_EQ(read("13/13/2014", TimeUnit::kDayFirst), std::nullopt);
  EXPECT_EQ(read("3/4-2014", TimeUnit::kDayFirst), std::nullopt);
  EXPECT_EQ(read("10:31:05.25", TimeUnit::kClock), 37'865'250'000);
  EXPECT_EQ(read("12:00:01 AM", TimeUnit::kClock), 1'000'000);
  EXPECT_EQ(read("12:00:01 PM", TimeUnit::kClock), 43'201'000'000);
  EXPECT_EQ(read("13:00:01 PM", TimeUnit::kClock), std::nullopt);
  EXPECT_EQ(read("24:00:00", TimeUnit::kClock), std::nullopt);
  EXPECT_EQ(read("10:31:05Z", TimeUnit::kClock), std::nullopt);
}

TEST(ImportTime, ATimeOfDayGoesOnAfterMidnight) {
  constexpr std::int64_t kDayUs = 86'400'000'000;
  TimeReader reader(TimeUnit::kClock, 20'000 * kDayUs);
  EXPECT_EQ(reader.us(text("23:59:59.5")), 20'000 * kDayUs + kDayUs - 500'000);
  reader.keep();
  const auto next = reader.wholeOf(text("00:00:00.5"));
  ASSERT_EQ(next, 500'000);
  ASSERT_TRUE(reader.mayRestart(*next));
  EXPECT_TRUE(TimeReader::goesOnFrom(*next, 1'500'000));
  reader.restart();
  EXPECT_EQ(reader.us(text("00:00:00.5")), 20'001 * kDayUs + 500'000);
  TimeReader exact(TimeUnit::kClock, 20'000 * kDayUs + 7);  // no midnight: the first row's time
  EXPECT_EQ(exact.us(text("13:00:00")), 20'000 * kDayUs + 7);
}

TEST(ImportTime, UnitsAreTheWordsOfHeaders) {
  EXPECT_EQ(timeUnitNamed("Seconds"), TimeUnit::kSeconds);
  EXPECT_EQ(timeUnitNamed("ms"), TimeUnit::kMilliseconds);
  EXPECT_EQ(timeUnitNamed("micros"), TimeUnit::kMicroseconds);
  EXPECT_EQ(timeUnitNamed("\xC2\xB5s"), TimeUnit::kMicroseconds);
  EXPECT_EQ(timeUnitNamed("ns"), TimeUnit::kNanoseconds);
  EXPECT_EQ(timeUnitNamed("min"), TimeUnit::kMinutes);
  EXPECT_EQ(timeUnitNamed("hours"), TimeUnit::kHours);
  EXPECT_EQ(timeUnitNamed("weeks"), std::nullopt);
  for (const TimeUnit unit : {TimeUnit::kSeconds, TimeUnit::kNanoseconds, TimeUnit::kDate})
    EXPECT_EQ(timeUnitNamed(nameOf(unit)), unit);
}

TEST(ImportTime, TheUnitIsGuessedFromTheSize) {
  EXPECT_EQ(guessTimeUnit(1.7e9, false), TimeUnit::kSeconds);
  EXPECT_EQ(guessTimeUnit(1.7e12, true), TimeUnit::kMilliseconds);
  EXPECT_EQ(guessTimeUnit(1.7e15, true), TimeUnit::kMicroseconds);
  EXPECT_EQ(guessTimeUnit(1.7e18, true), TimeUnit::kNanoseconds);
  EXPECT_EQ(guessTimeUnit(0.25, false), TimeUnit::kSeconds);
  EXPECT_EQ(guessTimeUnit(250.0, true), TimeUnit::kMilliseconds);
}

TEST(ImportTime, WholeNumbersAreConvertedExactly) {
  TimeReader nanoseconds(TimeUnit::kNanoseconds, std::nullopt);
  EXPECT_EQ(nanoseconds.us(whole(1'700'000'000'123'456'789)), 1'700'000'000'123'457);
  EXPECT_EQ(nanoseconds.us(text("1700000000123457501")), 1'700'000'000'123'458);
  EXPECT_EQ(nanoseconds.us(whole(-1'500)), -2);
  TimeReader seconds(TimeUnit::kSeconds, std::nullopt);
  EXPECT_EQ(seconds.us(text("1700000000.123456")), 1'700'000'000'123'456);
  EXPECT_EQ(seconds.us(text("12")), 12'000'000);
  EXPECT_EQ(seconds.us(whole(INT64_MAX)), std::nullopt);
  EXPECT_EQ(seconds.us(text("abc")), std::nullopt);
  TimeReader hours(TimeUnit::kHours, std::nullopt);
  EXPECT_EQ(hours.us(whole(2)), 7'200'000'000);
  EXPECT_EQ(hours.us(text("0.25")), 900'000'000);
  TimeReader minutes(TimeUnit::kMinutes, std::nullopt);
  EXPECT_EQ(minutes.us(whole(-2)), -120'000'000);
  TimeReader comma(TimeUnit::kSeconds, std::nullopt, ',');
  EXPECT_EQ(comma.us(text("0,25")), 250'000);
}

TEST(ImportTime, AStartShiftsAllTimes) {
  TimeReader reader(TimeUnit::kMilliseconds, 1'000'000'000);
  EXPECT_EQ(reader.us(whole(500)), 1'000'000'000);
  EXPECT_EQ(reader.us(whole(510)), 1'000'010'000);
}

TEST(ImportTime, ACounterOf32BitsGoesOn) {
  constexpr std::int64_t kLast = (std::int64_t{1} << 32) - 1;
  TimeReader reader(TimeUnit::kMicroseconds, std::nullopt);
  EXPECT_FALSE(reader.mayRestart(9));
  EXPECT_EQ(reader.us(whole(kLast)), kLast);
  reader.keep();
  ASSERT_TRUE(reader.mayRestart(9));
  ASSERT_TRUE(TimeReader::goesOnFrom(9, 1009));
  reader.restart();
  EXPECT_EQ(reader.us(whole(9)), kLast + 10);
  reader.keep();
  EXPECT_EQ(reader.us(whole(1009)), kLast + 1010);
  EXPECT_EQ(reader.numRestarts(), 1u);
}

TEST(ImportTime, OnlyACounterNearItsTurnStartsAgain) {
  constexpr std::int64_t kTurn = std::int64_t{1} << 32;
  const auto mayRestart = [](TimeUnit unit, std::int64_t last, std::int64_t next) {
    TimeReader reader(unit, std::nullopt);
    reader.us(whole(last));
    reader.keep();
    return reader.mayRestart(next);
  };
  EXPECT_TRUE(mayRestart(TimeUnit::kMilliseconds, kTurn - 10, 5));
  EXPECT_FALSE(mayRestart(TimeUnit::kMicroseconds, 3'000'123'456, 300'012'345));  // a digit lost
  EXPECT_FALSE(mayRestart(TimeUnit::kMicroseconds, 5'000'000, 10));               // a board reset
  EXPECT_FALSE(mayRestart(TimeUnit::kMicroseconds, kTurn - 10, kTurn / 2));
  EXPECT_FALSE(mayRestart(TimeUnit::kSeconds, kTurn - 10, 5));
  EXPECT_FALSE(mayRestart(TimeUnit::kMilliseconds, 1'700'000'000'000, 5));  // since 1970
  EXPECT_FALSE(TimeReader::goesOnFrom(42, kTurn - 5));
  EXPECT_FALSE(TimeReader::goesOnFrom(42, 42));
}

TEST(ImportTime, NoNumberOverflows) {
  TimeReader reader(TimeUnit::kMilliseconds, std::nullopt);
  reader.us(whole((std::int64_t{1} << 32) - 1));
  reader.keep();
  reader.restart();
  EXPECT_EQ(reader.us(text("9223372036854775807")), std::nullopt);
  EXPECT_EQ(reader.us(text("-9223372036854775808")), std::nullopt);
}

TEST(ImportTime, DatesWithoutAnOffsetAreUtcAndSaySo) {
  TimeReader known(TimeUnit::kDate, std::nullopt);
  for (const char* date :
       {"2014-11-27T10:31:05Z", "2014-11-27 10:31:05 UTC", "2014-11-27T11:31:05+01"})
    EXPECT_EQ(known.us(text(date)), 1'417'084'265'000'000) << date;
  EXPECT_FALSE(known.assumedUtc());
  EXPECT_EQ(known.us(text("2014-11-27 10:31:05")), 1'417'084'265'000'000);
  EXPECT_TRUE(known.assumedUtc());
}

}  // namespace
}  // namespace palpate::import_time_test
