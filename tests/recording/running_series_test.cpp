#include "recording/running_series.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "recording/series_samples.h"

namespace palpate::running_series_test {
namespace {

// `rows` rows of their number and its half, of which row `failsAt` can't be read.
std::unique_ptr<ExportedSeries> counting(std::size_t said, std::size_t rows, std::size_t failsAt) {
  return testing::seriesOf(
      rows,
      [failsAt](std::size_t i) {
        if (i == failsAt) throw FileError("a.dsa", "can't be read");
        const auto row = static_cast<double>(i);
        return testing::SeriesRow{static_cast<std::int64_t>(i), row, row / 2};
      },
      said);
}

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
    const auto series = counting(count, count, kNever);
    RunningSeries rows(*series, "test");
    takeRows(rows, count);
    EXPECT_EQ(rows.nextUs(), std::nullopt);
  }
}

TEST(RunningSeries, ThrowsWhatTheSeriesThrew) {
  const auto series = counting(5000, 5000, 2048);
  RunningSeries rows(*series, "test");
  takeRows(rows, 2048);
  EXPECT_THROW(rows.nextUs(), FileError);
}

TEST(RunningSeries, SaysThatThereAreFewerRows) {
  const auto series = counting(3, 2, kNever);
  RunningSeries rows(*series, "test");
  takeRows(rows, 2);
  EXPECT_THROW(rows.nextUs(), std::logic_error);
}

TEST(RunningSeries, EndsWhileRowsAreLeft) {
  const auto series = counting(1'000'000'000, kNever, kNever);
  RunningSeries rows(*series, "test");
  takeRows(rows, 1);
}

}  // namespace
}  // namespace palpate::running_series_test
