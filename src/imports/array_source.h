// What tables of arrays have in common: rows are read in pieces of bounded size.
#pragma once

#include <string>
#include <vector>

#include "palpate/imports/table_source.h"

namespace palpate {

class ArraySource : public TableSource {
 public:
  explicit ArraySource(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const noexcept override { return path_; }
  const std::vector<TableColumn>& columns() const noexcept override { return columns_; }
  const char* rowWord() const noexcept override { return "row"; }
  void start(std::span<const std::size_t> columns, std::optional<std::size_t> time) override;
  bool next(TableRow& row) override;
  double fraction() const noexcept override;
  std::string textOf(std::size_t index) const override;
  std::string placeOf(std::size_t index) const override;

 protected:
  // Called by start() for each column that will be read.
  virtual void open(std::size_t column) = 0;
  // Reads the numbers of rows first .. first + count - 1. Rows are read in order.
  virtual void load(std::size_t column,
                    std::uint64_t first,
                    std::size_t count,
                    std::vector<double>& values) = 0;
  // The same of a column of times; a whole number stays one. A date is a whole number of
  // microseconds since 1970.
  virtual void loadTimes(std::size_t column,
                         std::uint64_t first,
                         std::size_t count,
                         std::vector<TimeCell>& times) = 0;

  std::filesystem::path path_;
  std::vector<TableColumn> columns_;

 private:
  void loadPiece();

  std::vector<std::size_t> selected_;
  std::optional<std::size_t> time_;
  std::uint64_t numRows_ = 0;
  std::uint64_t row_ = 0;    // the next one
  std::uint64_t first_ = 0;  // row of the loaded piece
  std::size_t loaded_ = 0;   // rows
  std::size_t pieceRows_ = 1;
  std::vector<std::vector<double>> pieces_;  // one per selected column
  std::vector<TimeCell> times_;
  std::vector<double> lastValues_;
};

}  // namespace palpate
