// Result tables as palpate.Table: a dict with an array per column, its units and its meanings.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "palpate/core/progress.h"
#include "palpate/core/result_table.h"

namespace palpate::python {

// A palpate.Table (module.py).
class Table : public pybind11::object {
  PYBIND11_OBJECT_DEFAULT(Table, object, PyDict_Check)
};

// The cells of columns; adding needs no Python lock.
class ColumnCells {
 public:
  explicit ColumnCells(std::vector<ResultColumn> columns);
  void add(const std::vector<Cell>& row);
  // Makes the row of what it is about.
  template <typename Row>
  void add(const std::vector<ColumnOf<Row>>& columns, const Row& about) {
    row_.clear();
    for (const ColumnOf<Row>& each : columns) row_.push_back(each.cell(about));
    add(row_);
  }

  const std::vector<ResultColumn>& columns() const noexcept { return columns_; }
  std::size_t indexOf(const std::string& name) const;  // throws std::out_of_range
  // int64, bool, float64 or texts, (n,). Whole numbers and flags that aren't known in every row are
  // float64 with NaN.
  pybind11::array array(std::size_t column) const;

 private:
  struct Values {
    std::vector<double> numbers;
    std::vector<int> codes;  // of texts: which of `words`
    std::vector<std::string> words;
  };
  std::vector<ResultColumn> columns_;
  std::vector<Values> values_;
  std::vector<Cell> row_;
};

// Puts a Table together, column by column.
class TableMaker {
 public:
  // `perRow` cells make a row of the array, (rows, perRow); 0: (rows,). With several names, their
  // columns lie along a last axis, and the first one says unit and meaning (less its axis).
  void add(const std::string& name,
           const ColumnCells& cells,
           const std::vector<std::string>& of,
           std::size_t perRow = 0);
  void add(const ResultColumn& column, const pybind11::object& array);
  // Of an array (rows, n) its first column.
  void keepFirst(const std::string& name);
  void note(const std::vector<std::string>& lines);
  Table finish() const;

 private:
  pybind11::dict arrays_, units_, meanings_;
  pybind11::list notes_;
};

// Makes and reads a table without Python's lock.
using ResultOf = std::function<std::unique_ptr<ResultTable>(const Progress& progress)>;

// A column each, (rows,).
Table tableOf(const ResultOf& make);
// Of a table with a row per frame and matrix, all `numMatrices` of each frame: the columns are
// (frames, numMatrices), `time_ms` is (frames,). With 0, of one matrix: all are (frames,). `frame`
// and `matrix` are left out.
Table gridOf(std::size_t numMatrices, const ResultOf& make);

}  // namespace palpate::python

namespace pybind11::detail {
template <>
struct handle_type_name<palpate::python::Table> {
  static constexpr auto name = const_name("palpate.Table");
};
}  // namespace pybind11::detail
