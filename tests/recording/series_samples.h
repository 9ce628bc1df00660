// Series of two columns for tests of what exports write of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "palpate/recording/exported_series.h"

namespace palpate::testing {

struct SeriesRow {
  std::int64_t timeUs = 0;
  double mean = 0.0;
  double active = 0.0;
};

// `rows` rows of "signals", row i made by `of`; it says that there are `said`.
inline std::unique_ptr<ExportedSeries> seriesOf(std::size_t rows,
                                                std::function<SeriesRow(std::size_t)> of,
                                                std::size_t said) {
  std::vector<ColumnOf<SeriesRow>> columns = {
      columnOf<SeriesRow>("time_us", "us", "", &SeriesRow::timeUs),
      columnOf<SeriesRow>("m0/mean", "counts", "", &SeriesRow::mean),
      columnOf<SeriesRow>("m0/active", "taxels", "", &SeriesRow::active)};
  return std::make_unique<ExportedSeries>(
      std::make_unique<RowTable<SeriesRow>>(
          "signals",
          std::move(columns),
          [rows, of = std::move(of), at = std::size_t{0}](std::vector<SeriesRow>& made) mutable {
            if (at == rows) return false;
            made.push_back(of(at++));
            return true;
          }),
      said);
}
inline std::unique_ptr<ExportedSeries> seriesOf(std::size_t rows,
                                                std::function<SeriesRow(std::size_t)> of) {
  return seriesOf(rows, std::move(of), rows);
}
// From time `startUs` on: halves of the row, and its negative.
inline std::unique_ptr<ExportedSeries> rampSeries(std::size_t rows, std::int64_t startUs) {
  return seriesOf(rows, [startUs](std::size_t i) {
    const auto row = static_cast<std::int64_t>(i);
    return SeriesRow{startUs + row, 0.5 * static_cast<double>(row), static_cast<double>(-row)};
  });
}

}  // namespace palpate::testing
