#include "recording/running_series.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

namespace palpate::running_series_test {
namespace {

// Rows of their number and its half.
class CountingSeries final : public ExportedSeries {
 public:
  CountingSeries(std::size_t said, std::size_t rows, std::size_t failsAt)
      : said_(said), rows_(rows), failsAt_(failsAt) {}
  const std::string& name() const override { return name_; }
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t numRows() const override { return said_; }
  bool next(std::int64_t& timeUs, std::span<double> values) override {
    if (row_ == failsAt_) throw FileError("a.dsa", "can't be read");
    if (row_ == rows_) return false;
    timeUs = static_cast<std::int64_t>(row_);
    values[0] = static_cast<double>(row_);
    values[1] = static_cast<double>(row_) / 2;
    ++row_;
    return true;
  }

 private:
  std::string name_ = "signals";
  std::vector<Column> columns_ = {{"row", ""}, {"half", ""}};
  std::size_t said_;
  std::size_t rows_;
  std::size_t failsAt_;
  std::size_t row_ = 0;
};

constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

void takeRows(RunningSeries& rows, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i, rows.advance()) {
    ASSERT_EQ(rows.taken(), i);
    ASSERT_EQ(rows.nextUs(), static_cast<std::int64_t>(i));
    ASSERT_EQ(rows.row().size(), 2u);
    ASSERT_EQ(rows.row()[1], static_cast<double>(i) / 2);
  }
}

TEST(RunningSeries, HandsOutEveryRow) {
  for (const std::size_t count : {0, 1, 1024, 10'000}) {
    CountingSeries series(count, count, kNever);
    RunningSeries rows(series, "test");
    takeRows(rows, count);
    EXPECT_EQ(rows.nextUs(), std::nullopt);
  }
}

TEST(RunningSeries, ThrowsWhatTheSeriesThrew) {
  CountingSeries series(5000, 5000, 2048);
  RunningSeries rows(series, "test");
  takeRows(rows, 2048);
  EXPECT_THROW(rows.nextUs(), FileError);
}

TEST(RunningSeries, SaysThatThereAreFewerRows) {
  CountingSeries series(3, 2, kNever);
  RunningSeries rows(series, "test");
  takeRows(rows, 2);
  EXPECT_THROW(rows.nextUs(), std::logic_error);
}

TEST(RunningSeries, EndsWhileRowsAreLeft) {
  CountingSeries series(1'000'000'000, kNever, kNever);
  RunningSeries rows(series, "test");
  takeRows(rows, 1);
}

}  // namespace
}  // namespace palpate::running_series_test
