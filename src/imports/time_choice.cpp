#include "imports/time_choice.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/column_choice.h"
#include "imports/column_unit.h"
#include "imports/column_words.h"
#include "imports/import_texts.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxTimeRows = 50;

const std::set<std::string> kTimeWords = {"time",
                                          "timestamp",
                                          "stamp",
                                          "date",
                                          "datetime",
                                          "millis",
                                          "micros",
                                          "seconds",
                                          "clock",
                                          "elapsed"};
// Alone they name the time; in front of a number they may name a taxel.
const std::set<std::string> kShortTimeWords = {
    "t", "ts", "s", "ms", "us", "ns", "sec", "secs", "nsec", "nsecs", "nanosec", "nanosecs"};

// A number of a unit: 100 us.
struct ScaledUnit {
  double factor = 1.0;
  TimeUnit unit = TimeUnit::kSeconds;
};
// Of a text that ends in it, behind a letter that is no part of it: "time_100us", "t [0.1 ms]".
std::optional<ScaledUnit> scaledUnitAtEnd(std::string_view text) {
  while (!text.empty() && (text.back() == ')' || text.back() == ']' || text.back() == ' '))
    text.remove_suffix(1);
  const auto number = text.find_last_of("0123456789");
  if (number == std::string_view::npos) return std::nullopt;
  const auto unit = timeUnitNamed(trimmed(text.substr(number + 1)));
  const auto before = text.find_last_not_of("0123456789.", number);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  const auto factor = parseDouble(text.substr(begin, number + 1 - begin));
  constexpr std::string_view kSeparators = "_ [(-/";
  if (!unit || isDateUnit(*unit) || !factor || *factor <= 0.0 || *factor == 1.0 ||
      (begin > 0 && kSeparators.find(text[begin - 1]) == std::string_view::npos))
    return std::nullopt;
  return ScaledUnit{*factor, *unit};
}

bool namesTime(const TableColumn& column) {
  if (hasWord(column, kTimeWords) || column.name.ends_with(".t")) return true;  // of JSON
  const auto words = wordsOf(column.name);
  const bool hasNumber = column.name.find_first_of("0123456789") != std::string::npos;
  return !words.empty() && (!hasNumber || scaledUnitAtEnd(column.name)) &&
         std::all_of(words.begin(), words.end(), [](const std::string& word) {
           return kShortTimeWords.contains(word);
         });
}

// A name such as "stamp.nanosec": what its last word says, and the rest.
struct TimePart {
  std::string stem;
  std::optional<TimeUnit> unit;
};
TimePart timePartOf(const std::string& name) {
  std::size_t begin = name.size();
  while (begin > 0 && std::isalpha(static_cast<unsigned char>(name[begin - 1])) != 0) --begin;
  return {name.substr(0, begin), timeUnitNamed(name.substr(begin))};
}

// Why times, which are `what`, are not those of the values.
std::string otherRowsText(const std::string& what,
                          const TableColumn& time,
                          const TableColumn& values) {
  const auto rowsText = [](const TableColumn& column) {
    return counted(column.numRows.value_or(0), "row");
  };
  return what + " has " + rowsText(time) + ", but " + shortened(values.name) + " has " +
         rowsText(values);
}

}  // namespace

int timeScore(const TableColumn& column, PlannedSeries::Kind kind) {
  if (!isScalar(column) || (!column.isNumeric && !column.hasDates)) return 0;
  const bool named = namesTime(column);
  if (!named && !column.hasDates) return 0;
  const bool ofAngles = hasWord(column, kAngleWords);
  const bool ofTemperatures = hasWord(column, kTemperatureWords);
  const bool own = (kind == PlannedSeries::Kind::kAngles && ofAngles) ||
                   (kind == PlannedSeries::Kind::kTemperatures && ofTemperatures);
  if ((ofAngles || ofTemperatures) && !own) return 0;
  return 1 + (own ? 4 : 0) + (named ? 1 : 0) + (column.hasDates ? 1 : 0) +
         (wordsOf(column.name).size() == 1 ? 1 : 0);
}

TimeChoice::TimeChoice(TableSource& source, const ImportMapping& mapping, ImportPlan& plan)
    : source_(source), columns_(source.columns()), mapping_(mapping), plan_(plan) {}

void TimeChoice::refuse(const std::string& why) const {
  throw FormatError(source_.path(), "time: " + why);
}

void TimeChoice::refuseText(const TableColumn& column) const {
  refuse(inQuotes(column.name) + " holds " +
         (column.example.empty() ? column.type : inQuotes(column.example)) +
         ", which is not a readable time: numbers, 2026-11-22T10:31:05.123Z, 22.11.2026 "
         "10:31:05.123, 11/22/2026 1:31:05 PM, 10:31:05.123");
}

void TimeChoice::prepare() {
  straighten();
  joinTimes();
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (!mapping_.time.column.empty() && (columns_[c].name == mapping_.time.column ||
                                          mapping_.time.column == "#" + std::to_string(c + 1)))
      time_ = c;
}

// A vector of MATLAB is an array of one row or one column: those of times become columns.
void TimeChoice::straighten() {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const TableColumn& column = columns_[c];
    if (column.isNumeric && column.numRows == 1 && column.shape.size() == 1 &&
        (namesTime(column) || column.name == mapping_.time.column))
      source_.reverseAxes(c);
  }
}

// What joins two columns that are parts of one time (see TableSource::joinTimes()): a date and a
// time of day, or seconds and what is within the second. Nothing: they are not.
std::optional<std::int64_t> TimeChoice::joinFactor(std::size_t first,
                                                   std::size_t second,
                                                   bool isChosen) {
  const TableColumn& a = columns_[first];
  const TableColumn& b = columns_[second];
  if (a.hasDates && b.hasDates) {
    const bool fit = a.isDayOnly && b.dateForm == DateForm::kClock;
    return fit ? std::optional<std::int64_t>(0) : std::nullopt;
  }
  const TimePart whole = timePartOf(a.name);
  const TimePart part = timePartOf(b.name);
  if (a.numRows || !a.isNumeric || !b.isNumeric) return std::nullopt;
  if (!isChosen && (whole.stem != part.stem || whole.unit != TimeUnit::kSeconds))
    return std::nullopt;
  if (!isChosen && part.unit != TimeUnit::kNanoseconds && part.unit != TimeUnit::kMicroseconds &&
      part.unit != TimeUnit::kMilliseconds)
    return std::nullopt;
  const std::int64_t factor = part.unit == TimeUnit::kMilliseconds   ? 1000
                              : part.unit == TimeUnit::kMicroseconds ? 1'000'000
                                                                     : 1'000'000'000;
  const std::vector<double> wholes = sampleValues(first, 0);
  const std::vector<double> parts = sampleValues(second, 0);
  const auto isWhole = [](double value) { return value == std::floor(value); };
  const auto isPart = [&](double value) {
    return isWhole(value) && value >= 0.0 && value < static_cast<double>(factor);
  };
  const auto isSameTime = [&](double seconds, double within) {
    return std::abs(seconds - within / static_cast<double>(factor)) < 1.0;
  };
  if (wholes.empty() || parts.empty() || !std::all_of(wholes.begin(), wholes.end(), isWhole) ||
      !std::all_of(parts.begin(), parts.end(), isPart))
    return std::nullopt;
  // Two columns may hold the same time in two units, but not the parts of a stamp of ROS.
  if (!isChosen && !whole.stem.ends_with("stamp.") &&
      std::equal(wholes.begin(), wholes.end(), parts.begin(), parts.end(), isSameTime))
    return std::nullopt;
  return factor;
}

// Joins the two columns that the mapping names ("Date,Time"), or that are found.
void TimeChoice::joinTimes() {
  if (mapping_.time.rateHz || mapping_.time.column == kNoColumns) return;
  const std::string& named = mapping_.time.column;
  const auto comma = named.find(',');
  const bool isChosen = comma != std::string::npos && !numberNamed(columns_, named);
  if (!named.empty() && !isChosen) return;
  std::optional<std::int64_t> factor;
  std::size_t first = 0;
  std::size_t second = 0;
  if (isChosen) {
    const auto a = numberNamed(columns_, trimmed(std::string_view(named).substr(0, comma)));
    const auto b = numberNamed(columns_, trimmed(std::string_view(named).substr(comma + 1)));
    if (a && b) {
      first = a->column;
      second = b->column;
      factor = joinFactor(first, second, true);
    }
    if (!factor)
      refuse(inQuotes(named) +
             " are not a date and a time of day, or whole seconds and what is within the second "
             "(NAME_ms, NAME_us, NAME_ns), of a text; there are " +
             namesText(columns_));
  }
  constexpr std::size_t kMaxLookedAt = 64;  // times stand in front
  const std::size_t numLooked = std::min(kMaxLookedAt, columns_.size());
  for (std::size_t a = 0; a < numLooked && !factor; ++a)
    for (std::size_t b = 0; b < numLooked && !factor; ++b) {
      if (a == b || columns_[a].hasDates != columns_[b].hasDates) continue;
      first = a;
      second = b;
      factor = joinFactor(first, second, false);
    }
  if (!factor) return;
  joinedTime_ = source_.joinTimes(first, second, *factor);
  if (!joinedTime_) return;
  timeParts_ = {first, second};
  plan_.notes.push_back("time: " + inQuotes(columns_[first].name) + " and " +
                        inQuotes(columns_[second].name) + " are joined");
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

void TimeChoice::takeNamed(PlannedSeries& series, const std::string& named) {
  const auto chosen = numberNamed(columns_, named);
  if (!chosen && takeTimeFile(series, named)) return;
  if (!chosen)
    refuse("there is no column " + inQuotes(named) + "; there are " + namesText(columns_));
  if (!isScalar(columns_[chosen->column]) && !chosen->within)
    refuse(inQuotes(named) + " has several numbers per row; choose one: NAME[0]");
  if (!columns_[chosen->column].isNumeric && !columns_[chosen->column].hasDates)
    refuseText(columns_[chosen->column]);
  if (chosen->within && chosen->column != series.columns.front())
    refuse(inQuotes(named) + " is part of an array that doesn't hold the values");
  series.time = chosen->column;
  series.timeWithin = chosen->within;
}

// The times of a file beside the table, such as "t_ns.csv"; false when there is no such file.
bool TimeChoice::takeTimeFile(PlannedSeries& series, const std::string& named) {
  const std::filesystem::path file = source_.path().parent_path() / named;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  const auto table = openTable(file, mapping_.text);
  const std::vector<TableColumn>& columns = table->columns();
  ImportMapping mapping;
  mapping.time.unit = mapping_.time.unit;
  mapping.time.startUs = mapping_.time.startUs;
  const std::string unit = unitInName(file.stem().string());
  if (mapping.time.unit.empty() && timeUnitNamed(unit)) mapping.time.unit = unit;
  ImportPlan plan;
  TimeChoice choice(*table, mapping, plan);
  const TableColumn& values = columns_[series.columns.front()];
  PlannedSeries times;
  if (columns.size() == 1 && isScalar(columns[0])) times.time = 0;
  const auto otherRows = choice.takeBest(times, values);
  if (!times.time) times.time = otherRows;
  if (!times.time) refuse(named + " has no column of times; there are " + namesText(columns));
  if (!sameRows(columns[*times.time], values))
    refuse(otherRowsText(named, columns[*times.time], values));
  choice.setTimeUnit(times);
  times.timeFile = file;
  static_cast<PlannedTime&>(series) = times;
  plan_.notes.insert(plan_.notes.end(), plan.notes.begin(), plan.notes.end());
  if (series.kind == PlannedSeries::Kind::kFrames)
    plan_.timeDescription = named + ": " + plan.timeDescription;
  return true;
}

// Takes the column that fits best as the time of rows of `values`. Returns one that would have, but
// for its number of rows.
std::optional<std::size_t> TimeChoice::takeBest(PlannedSeries& series, const TableColumn& values) {
  std::optional<std::size_t> otherRows;
  int best = 0;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const int score = timeScore(columns_[c], series.kind);
    if (score <= best) continue;
    if (!sameRows(columns_[c], values)) {
      otherRows = c;
      continue;
    }
    best = score;
    series.time = c;
  }
  if (series.time) {
    sameTimes_.insert(*series.time);
    series.time = finestOf(*series.time);
  }
  return otherRows;
}

void TimeChoice::find(PlannedSeries& series, const std::string& named) {
  if (mapping_.time.rateHz) return;
  const bool isFrames = series.kind == PlannedSeries::Kind::kFrames;
  const TableColumn& values = columns_[series.columns.front()];
  std::optional<std::size_t> otherRows;
  if (joinedTime_ && !series.time && (isFrames || named.empty())) {
    series.time = joinedTime_;
  } else if (!named.empty() && named != kNoColumns) {
    takeNamed(series, named);
    if (!series.timeFile.empty()) return;
  } else if (named.empty() && !series.time) {
    otherRows = takeBest(series, values);
  }
  if (!series.time && !isFrames && time_ && sameRows(columns_[*time_], values)) {
    series.time = time_;
    series.timeWithin = timeWithin_;
  }
  if (!series.time && isFrames && otherRows)
    refuse(otherRowsText(inQuotes(columns_[*otherRows].name), columns_[*otherRows], values) +
           "; save as many times as frames, or give the rate of the rows (" + rateOption_ + ")");
  for (const TableColumn& column : columns_)
    if (!series.time && isFrames && isScalar(column) && !column.isNumeric && namesTime(column))
      refuseText(column);
  if (!series.time && isFrames)
    refuse("no column of times was found" +
           (rowNumber_.empty() ? "" : " (" + rowNumber_ + " counts the rows)") +
           "; name that column (--time), or give the rate of the rows (" + rateOption_ + ")");
  if (!series.time) return;
  const TableColumn& time = columns_[*series.time];
  if (!sameRows(time, values)) refuse(otherRowsText(inQuotes(time.name), time, values));
  setTimeUnit(series);
  if (!isFrames) return;
  time_ = series.time;
  timeWithin_ = series.timeWithin;
}

// How the dates of a column are read.
TimeUnit TimeChoice::dateUnitOf(const TableColumn& column) {
  if (const auto chosen = timeUnitNamed(mapping_.time.unit);
      chosen == TimeUnit::kDayFirst || chosen == TimeUnit::kMonthFirst)
    return *chosen;
  switch (column.dateForm) {
    case DateForm::kIso:
      return TimeUnit::kDate;
    case DateForm::kDayFirst:
      return TimeUnit::kDayFirst;
    case DateForm::kMonthFirst:
      return TimeUnit::kMonthFirst;
    case DateForm::kEither:
      if (column.example.find_last_of("Mm") == std::string::npos)
        refuse("the day or the month may come first in " + inQuotes(column.example) +
               "; choose by --time-unit dmy or mdy");
      plan_.notes.push_back("time: in " + inQuotes(column.example) +
                            " the month is taken to come first; choose the other order by "
                            "--time-unit dmy");
      return TimeUnit::kMonthFirst;
    case DateForm::kClock:
      break;
  }
  if (!mapping_.time.startUs) {
    const bool areMinutes = std::count(column.example.begin(), column.example.end(), ':') == 1;
    plan_.notes.push_back("time: " + inQuotes(column.name) + " has times of day without a date" +
                          (areMinutes ? ", taken as hours and minutes (minutes and seconds are "
                                        "read as 0:" +
                                            column.example + ")"
                                      : "") +
                          "; give the day by --start 2026-11-22");
  }
  return TimeUnit::kClock;
}

// The unit that a column or its name states. Another one than of a time is refused.
std::optional<TimeUnit> TimeChoice::statedUnit(const TableColumn& column,
                                               std::string& origin,
                                               double& factor) {
  const auto since = column.unit.find(" since ");  // of netCDF
  const auto unit = timeUnitNamed(column.unit.substr(0, since));
  origin = "by the file";
  if (unit && !isDateUnit(*unit)) {
    if (since != std::string::npos)
      plan_.notes.push_back("time: of " + inQuotes(column.unit) +
                            " only the unit is used; give the date by --start");
    return unit;
  }
  if (const auto scaled = scaledUnitAtEnd(column.unit.empty() ? column.name : column.unit);
      scaled && !unit && mapping_.time.unit.empty()) {
    factor = scaled->factor;
    if (column.unit.empty()) {
      origin = "by the name";
      plan_.notes.push_back("time: " + inQuotes(column.name) + " is taken to count " +
                            numberText(factor) + " " + std::string(nameOf(scaled->unit)) +
                            "; if that is not its unit, choose another one by --time-unit");
    }
    return scaled->unit;
  }
  if (!column.unit.empty() && !unit && mapping_.time.unit.empty())
    refuse("the unit " + inQuotes(column.unit) + " of " + inQuotes(column.name) +
           " is not known; name it by --time-unit (s, ms, us, ns, min, h)");
  const TimePart name = timePartOf(column.name);
  origin = "by the name";
  return name.unit && !isDateUnit(*name.unit) ? name.unit : std::nullopt;
}

void TimeChoice::setTimeUnit(PlannedSeries& series) {
  const TableColumn& column = columns_[*series.time];
  std::string origin = "as given";
  if (column.hasDates) {
    series.timeUnit = dateUnitOf(column);
    origin = "dates";
  } else if (!mapping_.time.unit.empty() && series.kind == PlannedSeries::Kind::kFrames &&
             series.time != joinedTime_) {
    series.timeUnit = *timeUnitNamed(mapping_.time.unit);
  } else if (const auto unit = statedUnit(column, origin, series.timeFactor)) {
    series.timeUnit = *unit;
  } else if (!mapping_.time.unit.empty()) {
    series.timeUnit = *timeUnitNamed(mapping_.time.unit);
  } else {
    const std::size_t at = series.timeWithin.value_or(0);
    const std::vector<double> values = sampleValues(*series.time, at);
    const bool whole = std::all_of(
        values.begin(), values.end(), [](double value) { return value == std::floor(value); });
    if (countingOf(*series.time, at).isRowNumber)
      refuse(inQuotes(column.name) + " counts the rows (0, 1, 2, ..); give the rate of the rows (" +
             rateOption_ +
             "), or its unit if it "
             "is a time (--time-unit)");
    series.timeUnit = values.empty() ? TimeUnit::kSeconds : guessTimeUnit(values.back(), whole);
    origin = "guessed from the values; choose the unit if it is another";
    plan_.notes.push_back("time: the unit of " + inQuotes(column.name) + " is guessed to be " +
                          std::string(nameOf(series.timeUnit)) +
                          "; choose another one by --time-unit");
  }
  if (series.kind == PlannedSeries::Kind::kFrames)
    plan_.timeDescription = shortened(column.name) + " [" +
                            (series.timeFactor == 1.0 ? "" : numberText(series.timeFactor) + " ") +
                            std::string(nameOf(series.timeUnit)) + ", " + origin + "]";
}

// What the first numbers of the rows tell of a number within them.
TimeChoice::Counting TimeChoice::countingOf(std::size_t column, std::size_t within) {
  constexpr std::size_t kMinCounts = 3;
  const std::vector<double> values = sampleValues(column, within);
  Counting found{.ascends = values.size() > 1, .isRowNumber = values.size() >= kMinCounts};
  std::size_t steps = 0;  // of 1
  if (found.isRowNumber) found.isRowNumber = values[0] == 0.0 || values[0] == 1.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    found.ascends = found.ascends && values[i] > values[i - 1];
    steps += values[i] == values[i - 1] + 1.0 ? 1 : 0;
    found.isRowNumber = found.isRowNumber && values[i] == values[i - 1] + 1.0;
  }
  found.countsFrames = found.ascends && values.size() >= kMinCounts && 2 * steps >= values.size();
  return found;
}

bool TimeChoice::countsFrames(std::size_t column) { return countingOf(column, 0).countsFrames; }

bool TimeChoice::leaveOutFirst(PlannedSeries& series, std::size_t column, bool isArray) {
  const std::string name = shortened(columns_[column].name) + (isArray ? "[0]" : "");
  const Counting counting = countingOf(column, 0);
  if (!counting.ascends) return false;
  if (counting.isRowNumber || (counting.countsFrames && mapping_.time.rateHz)) {
    rowNumber_ = name;
    counter_ = column;
    plan_.notes.push_back(name + " counts the rows and is not a time");
    return true;
  }
  const bool hasTime = time_ || joinedTime_ ||
                       std::any_of(columns_.begin(), columns_.end(), [](const TableColumn& each) {
                         return timeScore(each, PlannedSeries::Kind::kFrames) > 0;
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
