#include "palpate/core/text_table.h"

#include <sstream>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

#include "testing/testing.h"

namespace palpate::text_table_test {
namespace {

TextTable numbers(std::size_t rows) {
  return {.header = {"row", "root [counts]"}, .numRows = rows, .row = [](std::size_t row) {
            return std::vector<std::string>{std::to_string(row),
                                            numberText(1.0 / (static_cast<double>(row) + 3.0))};
          }};
}

TEST(TextTable, QuotesWhatWouldBreakALine) {
  EXPECT_EQ(csvLine({"a", "b,c", "say \"x\"", "two\nlines", ""}),
            "a,\"b,c\",\"say \"\"x\"\"\",\"two\nlines\",\n");
}

// A file may have any byte in its name, and the table may be read on a terminal.
TEST(TextTable, ControlCharactersAreEscaped) {
  EXPECT_EQ(csvLine({"a\x1b[31mb",
                     "c\x7f",
                     "d\ae",
                     "\xc2\x9b"
                     "f",
                     "g\rh"}),
            "a\\x1B[31mb,c\\x7F,d\\x07e,\\u{009B}f,g\\rh\n");
  EXPECT_EQ(csvLine({"two\r\nlines", "a\ttab", "\xc3\xa4", "\xe2\x80\x8e"}),
            "\"two\r\nlines\",a\ttab,\xc3\xa4,\xe2\x80\x8e\n");
}

TEST(TextTable, NumbersReadBackToTheSameDoubles) {
  const testing::TemporaryFolder folder;
  writeTable(numbers(10'000), folder / "a.csv");
  std::istringstream lines(testing::readFile(folder / "a.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "row,root [counts]");
  std::size_t row = 0;
  for (; std::getline(lines, line); ++row) {
    const auto comma = line.find(',');
    ASSERT_EQ(parseInteger(line.substr(0, comma)), static_cast<std::int64_t>(row));
    ASSERT_EQ(parseDouble(line.substr(comma + 1)), 1.0 / (static_cast<double>(row) + 3.0));
  }
  EXPECT_EQ(row, 10'000u);
}

TEST(TextTable, CancelledLeavesNothing) {
  const testing::TemporaryFolder folder;
  double last = 0.0;
  const auto progress = [&](double fraction) {
    last = fraction;
    return fraction < 0.5;
  };
  EXPECT_THROW(writeTable(numbers(50'000), folder / "a.csv", Overwrite::kRefuse, progress),
               Cancelled);
  EXPECT_GE(last, 0.5);
  EXPECT_LT(last, 0.7);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(TextTable, ReplacesOnlyWhenAsked) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.csv", "precious");
  EXPECT_THROW(writeTable(numbers(1), folder / "a.csv"), FileError);
  EXPECT_EQ(testing::readFile(folder / "a.csv"), "precious");
  writeTable(numbers(0), folder / "a.csv", Overwrite::kReplace);
  EXPECT_EQ(testing::readFile(folder / "a.csv"), "row,root [counts]\n");
}

TEST(TextTable, ARowOfAnotherLengthIsRefused) {
  const testing::TemporaryFolder folder;
  TextTable table = numbers(2);
  table.header.emplace_back("one more");
  EXPECT_THROW(writeTable(table, folder / "a.csv"), std::invalid_argument);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(TextTable, TabbedTextHasNoTabsWithinCells) {
  const TextTable table{.header = {"name", "x"}, .numRows = 3, .row = [](std::size_t row) {
                          return std::vector<std::string>{"a\tb\nc", std::to_string(row)};
                        }};
  EXPECT_EQ(tabbedText(table, 2), "name\tx\na b c\t0\na b c\t1\n");
  EXPECT_EQ(csvText(table, 1), "name,x\n\"a\tb\nc\",0\n");
}

}  // namespace
}  // namespace palpate::text_table_test
