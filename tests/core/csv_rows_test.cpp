#include "palpate/core/csv_rows.h"

#include <gtest/gtest.h>

#include "palpate/core/error.h"

namespace palpate::csv_rows_test {
namespace {
using Cells = std::vector<std::string>;

std::vector<Cells> rowsOf(std::string_view csv) {
  CsvRows rows(csv);
  std::vector<Cells> all;
  for (Cells cells; rows.next(cells);) all.push_back(cells);
  return all;
}

TEST(CsvRows, TheFirstLineTellsTheSeparator) {
  EXPECT_EQ(rowsOf("a,b\n1;2,3\n"), (std::vector<Cells>{{"a", "b"}, {"1;2", "3"}}));
  EXPECT_EQ(rowsOf("a;b\r\n1;2"), (std::vector<Cells>{{"a", "b"}, {"1", "2"}}));
  EXPECT_EQ(rowsOf("a\tb\n\n1\t2\n"), (std::vector<Cells>{{"a", "b"}, {"1", "2"}}));
}

TEST(CsvRows, AQuotedCellHoldsEverything) {
  EXPECT_EQ(rowsOf("a,b\n\"x, \"\"y\"\"\nz\",2\n"),
            (std::vector<Cells>{{"a", "b"}, {"x, \"y\"\nz", "2"}}));
}

TEST(CsvRows, ARowHasAtMostAThousandCells) {
  EXPECT_EQ(rowsOf(std::string(999, ',') + "\n")[0].size(), 1000u);
  EXPECT_THROW(rowsOf("a,b\n" + std::string(1000, ',') + "\n"), Error);
}

TEST(CsvRows, AQuotedCellOfAMessageIsShort) {
  EXPECT_EQ(quotedCell("a b"), "'a b'");
  EXPECT_EQ(quotedCell(std::string(101, 'x')), "'" + std::string(100, 'x') + "...'");
  // No letter of two bytes is cut.
  EXPECT_EQ(quotedCell(std::string(99, 'x') + "\xC3\xA4x"), "'" + std::string(99, 'x') + "...'");
}

TEST(CsvRows, LinesAreCountedAcrossLineBreaksInCells) {
  CsvRows rows(
      "\xEF\xBB\xBF"
      "a,b\n\"1\n2\",3\n\n4,5\n");
  Cells cells;
  EXPECT_EQ(rows.line(), 0u);
  ASSERT_TRUE(rows.next(cells));
  EXPECT_EQ(cells[0], "a") << "without the byte order mark";
  EXPECT_EQ(rows.line(), 1u);
  ASSERT_TRUE(rows.next(cells));
  EXPECT_EQ(rows.line(), 2u);
  ASSERT_TRUE(rows.next(cells));
  EXPECT_EQ(rows.line(), 5u);
  EXPECT_FALSE(rows.next(cells));
}

TEST(CsvRows, AQuoteThatIsNeverClosedIsTold) {
  CsvRows rows("a\n\"b\nc");
  Cells cells;
  rows.next(cells);
  EXPECT_FALSE(rows.unclosed());
  ASSERT_TRUE(rows.next(cells));
  EXPECT_TRUE(rows.unclosed());
}

}  // namespace
}  // namespace palpate::csv_rows_test
