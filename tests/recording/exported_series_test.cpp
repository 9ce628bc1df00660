#include "palpate/recording/exported_series.h"

#include <cmath>

#include <gtest/gtest.h>

#include "recording/series_samples.h"

namespace palpate::exported_series_test {
namespace {

TEST(Provenance, sameOnlyWhereEveryTextIs) {
  const Provenance a{"palpate 1", "a.dsa", "00", "median", "pad", "pad_hand"};
  Provenance b = a;
  EXPECT_EQ(a, b);
  for (std::string* text :
       {&b.program, &b.sourceFile, &b.sourceSha256, &b.filters, &b.calibration, &b.hand}) {
    const std::string before = *text;
    *text += "x";
    EXPECT_NE(a, b);
    *text = before;
  }
}

TEST(ExportedSeries, isTheNumbersOfATableBehindItsTime) {
  struct Row {
    std::int64_t timeUs;
    std::optional<double> force;
    bool isHeld;
  };
  ExportedSeries series(
      std::make_unique<RowTable<Row>>("grip",
                                      std::vector{columnOf<Row>("time_us", "us", "", &Row::timeUs),
                                                  columnOf<Row>("force", "N", "", &Row::force),
                                                  columnOf<Row>("held", "", "", &Row::isHeld)},
                                      std::vector<Row>{{10, 2.5, true}, {20, {}, false}}),
      2);
  EXPECT_EQ(series.name(), "grip");
  EXPECT_EQ(series.columns(), (std::vector<Column>{{"force", "N"}, {"held", ""}}));
  EXPECT_EQ(series.numRows(), 2u);
  std::int64_t timeUs = 0;
  std::vector<double> values(2);
  ASSERT_TRUE(series.next(timeUs, values));
  EXPECT_EQ(timeUs, 10);
  EXPECT_EQ(values, (std::vector<double>{2.5, 1.0}));
  ASSERT_TRUE(series.next(timeUs, values));
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_FALSE(series.next(timeUs, values));
}

TEST(ExportedSeries, needsATime) {
  auto table = std::make_unique<RowTable<int>>(
      "a", std::vector{columnOf<int>("n", "", "", [](int n) { return n; })}, std::vector<int>{1});
  EXPECT_THROW(ExportedSeries(std::move(table), 1), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::exported_series_test
