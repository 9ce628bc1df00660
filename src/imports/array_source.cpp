#include "imports/array_source.h"

#include <algorithm>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/cell_text.h"

namespace palpate {
namespace {

constexpr std::size_t kPieceNumbers = 1u << 18;       // 2 MB of doubles
constexpr std::size_t kLargestRowNumbers = 1u << 20;  // of all columns that are read at once

}  // namespace

void ArraySource::start(std::span<const std::size_t> columns, std::optional<std::size_t> time) {
  selected_.assign(columns.begin(), columns.end());
  time_ = time;
  row_ = first_ = 0;
  loaded_ = 0;
  pieces_.assign(selected_.size(), {});
  std::vector<std::size_t> all = selected_;
  if (time_) all.push_back(*time_);
  if (all.empty()) {
    numRows_ = 0;
    return;
  }
  std::size_t width = 0;
  numRows_ = columns_[all.front()].numRows.value_or(0);
  for (const std::size_t each : all) {
    const TableColumn& column = columns_[each];
    if (column.numRows.value_or(0) != numRows_)
      throw FormatError(path_,
                        shortened(column.name) + " has " +
                            std::to_string(column.numRows.value_or(0)) + " rows, but " +
                            shortened(columns_[all.front()].name) + " has " +
                            std::to_string(numRows_));
    if (column.width() > kMaxNumbersPerRow)
      throw FormatError(path_, inQuotes(column.name) + " has too many numbers per row");
    width += column.width();
  }
  if (width > kLargestRowNumbers)
    throw FormatError(path_,
                      "has rows of " + std::to_string(width) +
                          " numbers in the columns that are "
                          "taken; at most " +
                          std::to_string(kLargestRowNumbers) + " are read");
  for (const std::size_t each : all) open(each);
  pieceRows_ = std::max<std::size_t>(1, kPieceNumbers / std::max<std::size_t>(1, width));
}

void ArraySource::loadPiece() {
  first_ = row_;
  loaded_ = static_cast<std::size_t>(std::min<std::uint64_t>(pieceRows_, numRows_ - row_));
  for (std::size_t i = 0; i < selected_.size(); ++i)
    load(selected_[i], first_, loaded_, pieces_[i]);
  if (time_) loadTimes(*time_, first_, loaded_, times_);
}

bool ArraySource::next(TableRow& row) {
  if (row_ >= numRows_) return false;
  if (row_ >= first_ + loaded_) loadPiece();
  const auto at = static_cast<std::size_t>(row_ - first_);
  row.line = ++row_;
  row.complete = true;
  row.values.clear();
  for (std::size_t i = 0; i < selected_.size(); ++i) {
    const std::size_t width = columns_[selected_[i]].width();
    const auto begin = pieces_[i].begin() + static_cast<std::ptrdiff_t>(at * width);
    row.values.insert(row.values.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  row.states.resize(row.values.size());
  for (std::size_t i = 0; i < row.values.size(); ++i)
    row.states[i] = fitsFloat(row.values[i]) ? CellState::kNumber : CellState::kNotFinite;
  row.time = time_ ? times_[at] : TimeCell{};
  lastValues_.assign(row.values.begin(), row.values.end());
  return true;
}

double ArraySource::fraction() const noexcept {
  return numRows_ == 0 ? 0.0 : static_cast<double>(row_) / static_cast<double>(numRows_);
}

std::string ArraySource::textOf(std::size_t index) const {
  return index < lastValues_.size() ? numberText(lastValues_[index]) : std::string();
}

std::string ArraySource::placeOf(std::size_t index) const {
  std::size_t within = index;
  for (const std::size_t each : selected_) {
    const TableColumn& column = columns_[each];
    if (within >= column.width()) {
      within -= column.width();
      continue;
    }
    std::string indices;
    for (std::size_t d = column.shape.size(); d > 0; --d) {
      indices = "[" + std::to_string(within % column.shape[d - 1]) + "]" + indices;
      within /= column.shape[d - 1];
    }
    return shortened(column.name) + indices + " is " + textOf(index);
  }
  return "a value";
}

}  // namespace palpate
