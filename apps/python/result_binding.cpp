#include "python/result_binding.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "python/arrays.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

struct ReadTable {
  ColumnCells cells;
  std::vector<std::string> notes;
};

ReadTable readTable(const ResultOf& make) {
  return unlocked([&](const Progress& progress) {
    const std::unique_ptr<ResultTable> table = make(progress);
    ReadTable read{ColumnCells(table->columns()), {}};
    for (std::vector<Cell> row; table->next(row);) read.cells.add(row);
    read.notes = table->notes();
    for (std::string& problem : table->problems()) read.notes.push_back(std::move(problem));
    return read;
  });
}

}  // namespace

ColumnCells::ColumnCells(std::vector<ResultColumn> columns)
    : columns_(std::move(columns)), values_(columns_.size()) {}

void ColumnCells::add(const std::vector<Cell>& row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    Values& values = values_[i];
    if (columns_[i].kind != CellKind::kText) {
      values.numbers.push_back(numberOf(row[i]));
      continue;
    }
    const auto* given = std::get_if<std::string>(&row[i]);
    const std::string text = given ? *given : std::string();
    // Most texts are one of a few, or that of the row before.
    auto known = std::find(values.words.rbegin(), values.words.rend(), text);
    if (known == values.words.rend()) {
      values.words.push_back(text);
      known = values.words.rbegin();
    }
    values.codes.push_back(static_cast<int>(values.words.rend() - known) - 1);
  }
}

std::size_t ColumnCells::indexOf(const std::string& name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].name == name) return i;
  throw std::out_of_range("there is no column '" + name + "'");
}

py::array ColumnCells::array(std::size_t index) const {
  const Values& values = values_.at(index);
  const CellKind kind = columns_[index].kind;
  if (kind == CellKind::kText)
    return words(values.words.empty() ? std::vector<std::string>{""} : values.words, values.codes);
  const std::vector<double>& numbers = values.numbers;
  const auto value = [&](std::size_t i) { return numbers[i]; };
  const bool areWhole = std::all_of(
      numbers.begin(), numbers.end(), [](double one) { return one == std::trunc(one); });
  if (kind == CellKind::kInteger && areWhole) return column<std::int64_t>(numbers.size(), value);
  if (kind == CellKind::kFlag && areWhole) return column<bool>(numbers.size(), value);
  return arrayOf(numbers);
}

void TableMaker::add(const ResultColumn& column, const py::object& array) {
  const py::str name(column.name);
  arrays_[name] = array;
  if (!column.unit.empty()) units_[name] = column.unit;
  meanings_[name] = column.meaning;
}

void TableMaker::add(const std::string& name,
                     const ColumnCells& cells,
                     const std::vector<std::string>& of,
                     std::size_t perRow) {
  py::list parts;
  for (const std::string& each : of) {
    py::object part = cells.array(cells.indexOf(each));
    if (perRow > 0) part = part.attr("reshape")(-1, perRow);
    parts.append(part);
  }
  const py::object array =
      of.size() == 1 ? py::object(parts[0])
                     : py::module_::import("numpy").attr("stack")(parts, py::arg("axis") = -1);
  ResultColumn column = cells.columns()[cells.indexOf(of.front())];
  column.name = name;
  add(column, array);
}

void TableMaker::keepFirst(const std::string& name) {
  const py::str key(name);
  arrays_[key] = py::object(arrays_[key]).attr("T").attr("__getitem__")(0).attr("copy")();
}

void TableMaker::note(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) notes_.append(line);
}

Table TableMaker::finish() const {
  const py::object made =
      py::module_::import("palpate").attr("Table")(arrays_, units_, meanings_, notes_);
  return py::reinterpret_borrow<Table>(made);
}

Table tableOf(const ResultOf& make) {
  const ReadTable read = readTable(make);
  TableMaker table;
  for (const ResultColumn& each : read.cells.columns())
    table.add(each.name, read.cells, {each.name});
  table.note(read.notes);
  return table.finish();
}

Table gridOf(std::size_t numMatrices, const ResultOf& make) {
  const ReadTable read = readTable(make);
  TableMaker table;
  for (const ResultColumn& each : read.cells.columns()) {
    if (each.name == "frame" || each.name == "matrix") continue;
    table.add(each.name, read.cells, {each.name}, numMatrices);
    // Each matrix of a frame has the same time.
    if (each.name == "time_ms" && numMatrices > 0) table.keepFirst(each.name);
  }
  table.note(read.notes);
  return table.finish();
}

}  // namespace palpate::python
