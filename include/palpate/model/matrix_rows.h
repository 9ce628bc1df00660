// Rows of a result table (core/result_table.h) that are about one matrix in one frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <palpate/core/result_table.h>
#include <palpate/core/time.h>

namespace palpate {

template <typename Value>
struct MatrixRow {
  std::size_t frame = 0;
  std::int64_t timeUs = 0;  // host time [us since 1970]
  std::size_t matrix = 0;
  Value value;
};

// The columns `frame`, `time_ms`, `matrix`, then those of the value.
template <typename Value>
std::vector<ColumnOf<MatrixRow<Value>>> matrixRowColumns(
    const std::vector<ColumnOf<Value>>& ofValue) {
  using Row = MatrixRow<Value>;
  std::vector<ColumnOf<Row>> columns = {
      columnOf<Row>("frame", "", "number of the frame, from 0", &Row::frame),
      columnOf<Row>("time_ms",
                    "ms",
                    "host time, since 1970",
                    [](const Row& row) { return row.timeUs / kUsPerMs; }),
      columnOf<Row>("matrix", "", "number of the matrix, from 0", &Row::matrix)};
  appendColumns(columns, ofValue, [](const Row& row) -> const Value& { return row.value; });
  return columns;
}

}  // namespace palpate
