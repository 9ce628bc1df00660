// Reads rows of numbers from lines of text, with the names and units of their columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/device/line_splitter.h"
#include "palpate/model/series.h"

namespace palpate {

class Json;

struct SeriesRow {
  std::span<const double> values;  // one per column; NaN: missing
  std::optional<std::int64_t> deviceUs;
};

// Not thread-safe. Never throws for bad input: a bad line is counted, and lastFault() names it. One
// object serves all connections of a source, so the columns stay the same.
class SeriesLines {
 public:
  using Sink = std::function<void(const SeriesRow&)>;
  // `given`: all columns, that of time included; empty: the lines say them. They must be valid.
  explicit SeriesLines(std::vector<Column> given);

  // `startsInside`: the first line may lack its beginning; it is used only if it is no row of bare
  // numbers.
  void beginConnection(bool startsInside);
  void push(std::span<const std::byte> bytes, const Sink& sink);
  // Takes what is pending as a line, at the end of a datagram.
  void endLine(const Sink& sink);
  // At the end of a connection: a line without its end is refused, since digits may be missing.
  void cutOff(const Sink& sink);

  // Without that of time; empty: not known yet.
  const std::vector<Column>& columns() const noexcept { return columns_; }
  std::uint64_t refused() const noexcept { return refused_; }
  // Bytes of lines that are too long, or that may lack their beginning.
  std::uint64_t skippedBytes() const noexcept {
    return splitter_.counts().skippedBytes + insideBytes_;
  }
  std::size_t pendingBytes() const noexcept { return splitter_.pendingBytes(); }
  // "line 812: 5 numbers instead of 6"; all lines are counted, from 1.
  const std::string& lastFault() const noexcept { return lastFault_; }

 private:
  void takeSplit(const SplitLine& line, const Sink& sink);
  void takeLine(std::string_view line, const Sink& sink);
  bool split(std::string_view line);
  void takeCells(std::string_view line, const Sink& sink);
  void takeObject(const Json& object, const Sink& sink);
  void takeArray(const Json& array, const Sink& sink);
  void takeHeader(std::vector<Column> header, bool isSure);
  void takeNumbers(const Sink& sink);
  void deliver(const Sink& sink);
  bool learn(std::vector<Column> all, bool isNamed, bool isSure);
  void refuse(const std::string& why);

  LineSplitter splitter_;
  bool isGiven_;
  std::vector<Column> all_;      // what each number of a row is; empty: not known yet
  std::vector<Column> columns_;  // all_ without the time
  std::optional<std::size_t> timeAt_;
  double usPerTime_ = 1.0;
  bool isNamed_ = false;   // by a header or an object
  bool isSure_ = false;    // what named them can't be a greeting
  bool isOther_ = false;   // the last header named other columns
  bool hasRows_ = false;   // a row was delivered: the columns stay
  bool isInside_ = false;  // the present line may lack its beginning
  std::vector<std::string_view> cells_;
  std::vector<double> numbers_;  // of the present row
  std::vector<double> values_;   // the same without the time
  std::uint64_t line_ = 0;       // number of the present one
  std::uint64_t refused_ = 0;
  std::uint64_t insideBytes_ = 0;  // of a first line that was not used
  std::string lastFault_;
};

// "fx[N]", "fx (N)" or "fx".
Column columnOf(std::string_view text);
// The columns of a line of names; nothing checks them.
std::vector<Column> columnsOfCells(std::span<const std::string_view> cells);
// How many microseconds one unit of a column of time is; nothing for other columns.
std::optional<double> usPerTimeOf(const Column& column);
// Throws std::invalid_argument: not valid as columns of a series, or only times.
void requireColumns(const std::vector<Column>& all);

}  // namespace palpate
