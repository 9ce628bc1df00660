// The column of a table that is the time of a series, and its unit. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "palpate/imports/import_mapping.h"
#include "palpate/imports/import_plan.h"
#include "palpate/imports/table_source.h"

namespace palpate {

// How well a column fits as the time of a series; 0: not at all.
int timeScore(const TableColumn& column, PlannedSeries::Kind kind);

class TimeChoice {
 public:
  // Adds its notes, and the description of the time, to `plan`.
  TimeChoice(TableSource& source, const ImportMapping& mapping, ImportPlan& plan);

  // The option that gives the rate of the rows, for messages.
  void setRateOption(std::string option) { rateOption_ = std::move(option); }
  // Straightens vectors of times, joins columns that are parts of one time, and finds the column
  // that the mapping names: it is none of the taxels. Before the columns of the values are chosen.
  void prepare();
  // Whether a first number more than the taxels is not one of them: the time, or the number of the
  // row. Before find().
  bool leaveOutFirst(PlannedSeries& series, std::size_t column, bool isArray);
  // Finds the time of a series whose columns are known, unless the rows have a rate; that of the
  // frames first. `named`: what the mapping says of it. Throws FormatError.
  void find(PlannedSeries& series, const std::string& named);
  // A column that numbers the frames and was left out before them.
  std::optional<std::size_t> counter() const { return counter_; }
  // Whether the first numbers of a column ascend, by 1 in most rows.
  bool countsFrames(std::size_t column);
  // Whether a column is known to be the time of the frames.
  bool isOfFrames(std::size_t column) const { return time_ == column; }
  // Whether a column is one of two that are joined to the time.
  bool isPart(std::size_t column) const { return timeParts_.contains(column); }
  // Whether a finer column of the same times is used instead of a column, or that one itself.
  bool hasSameTimes(std::size_t column) const { return sameTimes_.contains(column); }
  // Whether a column is made of these two.
  bool isJoined(std::size_t column) const { return joinedTime_ == column; }

 private:
  struct Counting {
    bool ascends = false;
    bool countsFrames = false;
    bool isRowNumber = false;  // 0, 1, 2, .. or 1, 2, 3, ..
  };
  Counting countingOf(std::size_t column, std::size_t within);
  std::vector<double> sampleValues(std::size_t column, std::size_t within);
  void straighten();
  std::optional<std::int64_t> joinFactor(std::size_t first, std::size_t second, bool isChosen);
  void joinTimes();
  void takeNamed(PlannedSeries& series, const std::string& named);
  bool takeTimeFile(PlannedSeries& series, const std::string& named);
  std::optional<std::size_t> takeBest(PlannedSeries& series, const TableColumn& values);
  std::size_t finestOf(std::size_t time);
  TimeUnit dateUnitOf(const TableColumn& column);
  void setTimeUnit(PlannedSeries& series);
  std::optional<TimeUnit> statedUnit(const TableColumn& column,
                                     std::string& origin,
                                     double& factor);
  [[noreturn]] void refuse(const std::string& why) const;
  [[noreturn]] void refuseText(const TableColumn& column) const;

  TableSource& source_;
  const std::vector<TableColumn>& columns_;
  const ImportMapping& mapping_;
  ImportPlan& plan_;
  std::string rateOption_ = "--rate";
  std::string rowNumber_;  // a column that counts the rows
  std::optional<std::size_t> counter_;
  std::optional<std::size_t> time_;  // column of the frames
  std::optional<std::size_t> timeWithin_;
  std::optional<std::size_t> joinedTime_;  // column that the source made of the two timeParts_
  std::set<std::size_t> timeParts_;
  std::set<std::size_t> sameTimes_;  // of which a finer column is used
};

}  // namespace palpate
