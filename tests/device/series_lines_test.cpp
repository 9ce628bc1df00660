// Rows of numbers in lines of text: headers, units, JSON, missing values, and what is refused.
#include "device/series_lines.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/device/series_source.h"

namespace palpate::testing::series_lines_test {
namespace {

struct Reader {
  explicit Reader(std::vector<Column> given = {}) : lines(std::move(given)) {}
  void send(std::string_view text) { lines.push(std::as_bytes(std::span(text)), sink); }
  SeriesLines lines;
  std::vector<std::vector<double>> rows;
  std::vector<std::optional<std::int64_t>> times;
  SeriesLines::Sink sink = [this](const SeriesRow& row) {
    rows.emplace_back(row.values.begin(), row.values.end());
    times.push_back(row.deviceUs);
  };
};

using Columns = std::vector<Column>;
using Rows = std::vector<std::vector<double>>;

TEST(SeriesLines, AHeaderNamesTheColumns) {
  for (const char* header : {"fx[N],fy [N],mode\r\n",
                             "fx[N];fy[N];mode\n",
                             "fx (N)\tfy (N)\tmode\n",
                             "fx (N) fy[N]  mode\n",
                             "\"fx[N]\",\"fy (N)\",\"mode\"\n",
                             "\xEF\xBB\xBF"
                             "fx[N],fy[N],mode\n",
                             "[\"fx[N]\", \"fy[N]\", \"mode\"]\n"}) {
    Reader reader;
    reader.send(header);
    reader.send("1,-2.5,3e2\n+4;5;6\n7 8  9\n[10, 11, 12]\n");
    EXPECT_EQ(reader.lines.columns(), (Columns{{"fx", "N"}, {"fy", "N"}, {"mode", ""}})) << header;
    EXPECT_EQ(reader.rows, (Rows{{1, -2.5, 300}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}})) << header;
    EXPECT_EQ(reader.lines.refused(), 0u) << reader.lines.lastFault();
  }
}

TEST(SeriesLines, WithoutAHeaderColumnsAreNumbered) {
  Reader reader;
  reader.send("# a comment\n\n1,2,\n3,4,\n");
  EXPECT_EQ(reader.lines.columns(), (Columns{{"1", ""}, {"2", ""}}));
  EXPECT_EQ(reader.rows, (Rows{{1, 2}, {3, 4}}));
}

TEST(SeriesLines, GivenColumnsStandAboveAHeader) {
  Reader reader(columnsOf("time_ms,fx[N],fy (N)"));
  reader.send("a,b,c\n1000,2,3\n");
  EXPECT_EQ(reader.lines.columns(), (Columns{{"fx", "N"}, {"fy", "N"}}));
  EXPECT_EQ(reader.rows, (Rows{{2, 3}}));
  EXPECT_EQ(reader.times[0], 1'000'000);
  EXPECT_THROW(columnsOf("a,a"), std::invalid_argument);
  EXPECT_THROW(columnsOf(""), std::invalid_argument);
  EXPECT_THROW(columnsOf("time_ms"), std::invalid_argument);
}

TEST(SeriesLines, ATimeIsNoValue) {
  for (const auto& [name, us] : {std::pair{"t", 2'500'000},
                                 {"t[ms]", 2'500},
                                 {"time_us", 3},
                                 {"time_ms", 2'500},
                                 {"time_s", 2'500'000}}) {
    Reader reader;
    reader.send("f," + std::string(name) + "\n7,2.5\n8,\n9,1e30\n");
    EXPECT_EQ(reader.rows, (Rows{{7}, {8}})) << name;
    EXPECT_EQ(reader.times[0], us) << name;
    EXPECT_FALSE(reader.times[1].has_value());
    EXPECT_EQ(reader.lines.refused(), 1u);
  }
}

TEST(SeriesLines, EmptyCellsAndNaNAreMissing) {
  Reader reader;
  reader.send("a,b,c\n1,,NaN\nnan,null,3\n[null, NaN, 4]\n");
  ASSERT_EQ(reader.rows.size(), 3u) << reader.lines.lastFault();
  EXPECT_TRUE(std::isnan(reader.rows[0][1]) && std::isnan(reader.rows[0][2]));
  EXPECT_TRUE(std::isnan(reader.rows[1][0]) && std::isnan(reader.rows[1][1]));
  EXPECT_TRUE(std::isnan(reader.rows[2][0]) && std::isnan(reader.rows[2][1]));
  EXPECT_EQ(reader.rows[2][2], 4);
}

TEST(SeriesLines, ObjectsAreReadByTheirNames) {
  Reader reader;
  reader.send(R"({"time_us": 5, "fx[N]": 1, "fy[N]": NaN, "id": "NaN"})"
              "\n"
              R"({"fy[N]": 3, "fx[N]": 2})"
              "\n"
              R"({"fx[N]": 4, "mz": 2})"
              "\n"
              R"({"fx[N]": "four"})"
              "\n"
              R"({"fx[N]": )"
              "\n");
  EXPECT_EQ(reader.lines.columns(), (Columns{{"fx", "N"}, {"fy", "N"}}));
  ASSERT_EQ(reader.rows.size(), 2u) << reader.lines.lastFault();
  EXPECT_TRUE(std::isnan(reader.rows[0][1]));
  EXPECT_EQ(reader.times[0], 5);
  EXPECT_EQ(reader.rows[1], (std::vector<double>{2, 3}));
  EXPECT_EQ(reader.lines.refused(), 3u);
}

TEST(SeriesLines, BadRowsAreRefusedAndNamed) {
  Reader reader;
  reader.send("a,b\n1,2\n1,2,3\n1\n1,two\n1,inf\n5,6\n");
  EXPECT_EQ(reader.rows, (Rows{{1, 2}, {5, 6}}));
  EXPECT_EQ(reader.lines.refused(), 4u);
  EXPECT_EQ(reader.lines.lastFault(), "line 6: value 2 is \"inf\", not a number");
}

TEST(SeriesLines, OtherColumnsAreRefusedUntilTheyAreAsBefore) {
  Reader reader;
  reader.send("a[N],b[N]\n1,2\nb[N],a[N]\n3,4\n5,6\na[N],b[N]\n7,8\n");
  EXPECT_EQ(reader.rows, (Rows{{1, 2}, {7, 8}}));
  EXPECT_EQ(reader.lines.refused(), 3u);
  reader.send("overload!\n9,10\n");  // a word of the sender's is no header
  EXPECT_EQ(reader.rows.size(), 3u);
  EXPECT_EQ(reader.lines.refused(), 4u);
}

TEST(SeriesLines, AGreetingIsNoHeader) {
  Reader reader;
  reader.send("Load cell ready\n1,2\n3,4\n");
  EXPECT_EQ(reader.lines.columns(), (Columns{{"1", ""}, {"2", ""}}));
  EXPECT_EQ(reader.rows.size(), 2u);
  Reader named;
  named.send("Load cell ready\nfx[N],fy[N]\n1,2\n");
  EXPECT_EQ(named.lines.columns(), (Columns{{"fx", "N"}, {"fy", "N"}}));
}

TEST(SeriesLines, WhatMayLackItsBeginningOrEndIsNotUsed) {
  Reader reader;
  reader.lines.beginConnection(true);
  reader.send("2,3\n4,5\n6,7");
  reader.lines.cutOff(reader.sink);
  EXPECT_EQ(reader.rows, (Rows{{4, 5}}));
  EXPECT_EQ(reader.lines.refused(), 1u);
  Reader named;
  named.lines.beginConnection(true);
  named.send("fx[N],fy[N]\n2,3\n");
  EXPECT_EQ(named.rows.size(), 1u);
}

TEST(SeriesLines, GarbageAndEndlessLinesAreBounded) {
  Reader reader;
  const std::string endless(100'000, '1');
  for (int i = 0; i < 100; ++i) reader.send(endless);
  EXPECT_EQ(reader.lines.pendingBytes(), 0u);
  EXPECT_EQ(reader.lines.refused(), 1u);
  reader.send("\n1,2\n");
  EXPECT_EQ(reader.rows, (Rows{{1, 2}}));
  std::mt19937 random(7);
  constexpr std::string_view kLetters = "019,;.\t -+e\n\r[]{}:\"aN#\\\x80\xFF";
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (int k = 0; k < 20; ++k)
      text += i % 2 == 0 ? kLetters[random() % kLetters.size()] : static_cast<char>(random());
    reader.send(text);
    ASSERT_LE(reader.lines.pendingBytes(), 16'384u);
  }
  for (const auto& row : reader.rows) ASSERT_EQ(row.size(), 2u);
}

}  // namespace
}  // namespace palpate::testing::series_lines_test
