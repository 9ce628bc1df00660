#include "recording/import/time_choice.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

#include "recording/import/column_choice.h"
#include "recording/import/column_unit.h"
#include "recording/import/column_words.h"

namespace palpate {
namespace {

using Kind = PlannedSeries::Kind;

constexpr std::size_t kMaxTimeRows = 50;

const std::set<std::string> kTimeWords = {
    "time", "timestamp", "stamp", "date", "datetime", "millis", "micros", "seconds", "clock"};
// Alone they name the time; in front of a number they may name a taxel.
const std::set<std::string> kShortTimeWords = {"t", "s", "ms", "us", "ns"};

bool namesTime(const TableColumn& column) {
  if (hasWord(column, kTimeWords)) return true;
  const auto words = wordsOf(column.name);
  return !words.empty() && column.name.find_first_of("0123456789") == std::string::npos &&
         std::all_of(words.begin(), words.end(), [](const std::string& word) {
           return kShortTimeWords.contains(word);
         });
}

}  // namespace

int timeScore(const TableColumn& column, Kind kind) {
  if (!isScalar(column) || (!column.isNumeric && !column.hasDates)) return 0;
  const bool named = namesTime(column);
  if (!named && !column.hasDates) return 0;
  const bool ofAngles = hasWord(column, kAngleWords);
  const bool ofTemperatures = hasWord(column, kTemperatureWords);
  const bool own =
      (kind == Kind::kAngles && ofAngles) || (kind == Kind::kTemperatures && ofTemperatures);
  if ((ofAngles || ofTemperatures) && !own) return 0;
  return 1 + (own ? 4 : 0) + (named ? 1 : 0) + (column.hasDates ? 1 : 0) +
         (wordsOf(column.name).size() == 1 ? 1 : 0);
}

TimeChoice::TimeChoice(TableSource& source, const ImportMapping& mapping, ImportPlan& plan)
    : source_(source), columns_(source.columns()), mapping_(mapping), plan_(plan) {
  // A column of times that the mapping names is none of the taxels.
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (!mapping_.time.column.empty() && (columns_[c].name == mapping_.time.column ||
                                          mapping_.time.column == "#" + std::to_string(c + 1)))
      time_ = c;
}

void TimeChoice::refuse(const std::string& why) const {
  throw FormatError(source_.path(), "time: " + why);
}

void TimeChoice::straighten() {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const TableColumn& column = columns_[c];
    if (column.isNumeric && column.numRows == 1 && column.shape.size() == 1 &&
        (namesTime(column) || column.name == mapping_.time.column))
      source_.reverseAxes(c);
  }
}

// One of the numbers of a column, in the first rows that have it.
std::vector<double> TimeChoice::sampleValues(std::size_t column, std::size_t within) {
  std::vector<double> values;
  source_.start(std::span(&column, 1), std::nullopt);
  TableRow row;
  for (std::size_t i = 0; i < kMaxTimeRows && source_.next(row); ++i)
    if (row.complete && row.states[within] == CellState::kNumber)
      values.push_back(row.values[within]);
  return values;
}

// Of columns with one name and the same times in several units, as time_ms and time_us, the one
// with the finest unit.
std::size_t TimeChoice::finestOf(std::size_t time) {
  const auto usPerUnit = [&](std::size_t column) -> double {
    const auto unit = timeUnitNamed(columns_[column].unit);
    if (!columns_[column].isNumeric || !unit || *unit > TimeUnit::kNanoseconds) return 0.0;
    constexpr double kUs[] = {1e6, 1e3, 1.0, 1e-3};
    return kUs[static_cast<std::size_t>(*unit)];
  };
  std::size_t finest = time;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const double coarse = usPerUnit(finest);
    const double fine = usPerUnit(c);
    if (fine == 0.0 || fine >= coarse || !isScalar(columns_[c]) ||
        nameWithoutUnit(columns_[c].name) != nameWithoutUnit(columns_[time].name) ||
        !sameRows(columns_[c], columns_[time]))
      continue;
    const std::vector<double> coarseTimes = sampleValues(finest, 0);
    const std::vector<double> fineTimes = sampleValues(c, 0);
    const auto isSame = [&](double a, double b) {
      return std::abs(a * coarse - b * fine) < coarse;
    };
    if (!fineTimes.empty() &&
        std::equal(
            coarseTimes.begin(), coarseTimes.end(), fineTimes.begin(), fineTimes.end(), isSame))
      finest = c;
  }
  return finest;
}

void TimeChoice::takeNamed(PlannedSeries& series, const std::string& named) const {
  const auto chosen = numberNamed(columns_, named);
  if (!chosen)
    refuse("there is no column " + inQuotes(named) + "; there are " + namesText(columns_));
  if (!isScalar(columns_[chosen->column]) && !chosen->within)
    refuse(inQuotes(named) + " has several numbers per row; choose one: NAME[0]");
  if (chosen->within && chosen->column != series.columns.front())
    refuse(inQuotes(named) + " is part of an array that doesn't hold the values");
  series.time = chosen->column;
  series.timeWithin = chosen->within;
}

// Takes the column that fits best. Returns one that would have, but for its number of rows.
std::optional<std::size_t> TimeChoice::takeBest(PlannedSeries& series) {
  std::optional<std::size_t> otherRows;
  int best = 0;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const int score = timeScore(columns_[c], series.kind);
    if (score <= best) continue;
    if (!sameRows(columns_[c], columns_[series.columns.front()])) {
      otherRows = c;
      continue;
    }
    best = score;
    series.time = c;
  }
  if (series.time) series.time = finestOf(*series.time);
  return otherRows;
}

std::string TimeChoice::otherRowsText(const PlannedSeries& series, std::size_t time) const {
  const auto rowsText = [&](std::size_t column) {
    return counted(columns_[column].numRows.value_or(0), "row");
  };
  const std::size_t values = series.columns.front();
  return inQuotes(columns_[time].name) + " has " + rowsText(time) + ", but " +
         shortened(columns_[values].name) + " has " + rowsText(values);
}

void TimeChoice::find(PlannedSeries& series, const std::string& named) {
  if (mapping_.time.rateHz) return;
  const bool isFrames = series.kind == Kind::kFrames;
  const TableColumn& values = columns_[series.columns.front()];
  std::optional<std::size_t> otherRows;
  if (!named.empty() && named != kNoColumns)
    takeNamed(series, named);
  else if (named.empty() && !series.time)
    otherRows = takeBest(series);
  if (!series.time && !isFrames && time_ && sameRows(columns_[*time_], values)) {
    series.time = time_;
    series.timeWithin = timeWithin_;
  }
  if (!series.time && isFrames && otherRows)
    refuse(otherRowsText(series, *otherRows) +
           "; save as many times as frames, or give the rate of the rows (--rate)");
  if (!series.time && isFrames)
    refuse("no column of times was found" +
           (rowNumber_.empty() ? "" : " (" + rowNumber_ + " counts the rows)") +
           "; name that column (--time), or give the rate of the rows (--rate)");
  if (!series.time) return;
  if (!sameRows(columns_[*series.time], values)) refuse(otherRowsText(series, *series.time));
  setTimeUnit(series);
  if (!isFrames) return;
  time_ = series.time;
  timeWithin_ = series.timeWithin;
}

void TimeChoice::setTimeUnit(PlannedSeries& series) {
  const TableColumn& column = columns_[*series.time];
  std::string origin = "as given";
  if (column.hasDates) {
    series.timeUnit = TimeUnit::kDate;
    origin = "dates";
  } else if (!mapping_.time.unit.empty() && series.kind == Kind::kFrames) {
    series.timeUnit = *timeUnitNamed(mapping_.time.unit);
  } else if (const auto unit = timeUnitNamed(column.unit); unit && unit != TimeUnit::kDate) {
    series.timeUnit = *unit;
    origin = "by the file";
  } else if (const auto word = timeUnitNamed(column.name); word && word != TimeUnit::kDate) {
    series.timeUnit = *word;
    origin = "by the name";
  } else {
    if (!mapping_.time.unit.empty()) {
      series.timeUnit = *timeUnitNamed(mapping_.time.unit);
    } else {
      const std::size_t at = series.timeWithin.value_or(0);
      const std::vector<double> values = sampleValues(*series.time, at);
      const bool whole = std::all_of(
          values.begin(), values.end(), [](double value) { return value == std::floor(value); });
      if (countingOf(*series.time, at).isRowNumber)
        refuse(inQuotes(column.name) +
               " counts the rows (0, 1, 2, ..); give the rate of the rows (--rate), or its unit if "
               "it is a time (--time-unit)");
      series.timeUnit = values.empty() ? TimeUnit::kSeconds : guessTimeUnit(values.back(), whole);
      origin = "guessed from the values; choose the unit if it is another";
      plan_.notes.push_back("time: the unit of " + inQuotes(column.name) + " is guessed to be " +
                            std::string(nameOf(series.timeUnit)) +
                            "; choose another one by --time-unit");
    }
  }
  if (series.kind == Kind::kFrames)
    plan_.timeDescription =
        shortened(column.name) + " [" + std::string(nameOf(series.timeUnit)) + ", " + origin + "]";
}

// What the first numbers of the rows tell of a number within them.
TimeChoice::Counting TimeChoice::countingOf(std::size_t column, std::size_t within) {
  constexpr std::size_t kMinCounts = 3;
  const std::vector<double> values = sampleValues(column, within);
  Counting found{values.size() > 1, values.size() >= kMinCounts};
  if (found.isRowNumber) found.isRowNumber = values[0] == 0.0 || values[0] == 1.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    found.ascends = found.ascends && values[i] > values[i - 1];
    found.isRowNumber = found.isRowNumber && values[i] == values[i - 1] + 1.0;
  }
  return found;
}

bool TimeChoice::leaveOutFirst(PlannedSeries& series, std::size_t column, bool isArray) {
  const std::string name = shortened(columns_[column].name) + (isArray ? "[0]" : "");
  const Counting counting = countingOf(column, 0);
  if (!counting.ascends) return false;
  if (counting.isRowNumber) {
    rowNumber_ = name;
    plan_.notes.push_back(name + " counts the rows; not used");
    return true;
  }
  const bool hasTime =
      time_ || std::any_of(columns_.begin(), columns_.end(), [](const TableColumn& each) {
        return timeScore(each, Kind::kFrames) > 0;
      });
  if (hasTime || mapping_.time.column == kNoColumns) return false;
  if (mapping_.time.rateHz) {
    plan_.notes.push_back(name + " ascends; not used, since the rate is given");
    return true;
  }
  series.time = time_ = column;
  if (isArray) series.timeWithin = 0;
  plan_.notes.push_back(name + " ascends and is taken for the time");
  return true;
}

}  // namespace palpate
