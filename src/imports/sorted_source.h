// The rows of a table in order of time. Private to this module.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/imports/import_plan.h"
#include "palpate/imports/import_time.h"

namespace palpate {

// Puts the time of a row in its place where it is a number of the array.
void findTimeWithin(const PlannedSeries& series, TableRow& row);

// What the times of a table are, of its first `mostRows` rows. Two that are equal ascend, and a
// counter that starts again does.
struct TimesOfRows {
  bool ascend = true;
  std::optional<std::int64_t> leastUs;
};
TimesOfRows timesOfRows(TableSource& source,
                        const PlannedSeries& series,
                        TimeReader times,
                        std::uint64_t mostRows);

// Keeps the rows of a table in memory, those of one time in their order.
class SortedSource final : public TableSource {
 public:
  SortedSource(std::shared_ptr<TableSource> source,
               const PlannedSeries& series,
               const TimeReader& times,
               std::uint64_t mostRows);

  const std::filesystem::path& path() const noexcept override { return source_->path(); }
  const std::vector<TableColumn>& columns() const noexcept override { return source_->columns(); }
  std::string form() const override { return source_->form(); }
  const char* rowWord() const noexcept override { return source_->rowWord(); }
  // Throws FormatError also where the rows are too many to be sorted.
  void start(std::span<const std::size_t> columns, std::optional<std::size_t> time) override;
  bool next(TableRow& row) override;
  double fraction() const noexcept override;
  std::string textOf(std::size_t index) const override;
  std::string placeOf(std::size_t index) const override;
  NulBytes nulBytes() const override { return source_->nulBytes(); }
  std::string endNote() const override { return source_->endNote(); }

 private:
  struct Kept {
    std::int64_t us = 0;  // of a row without a time that of the row before
    TableRow row;
    std::string time;
    std::string text;  // of the first cell that is no number
  };

  std::shared_ptr<TableSource> source_;
  const PlannedSeries& series_;
  TimeReader times_;
  std::uint64_t mostRows_;
  std::vector<std::string> names_;  // of the values
  std::vector<Kept> rows_;
  std::size_t next_ = 0;
};

}  // namespace palpate
