#include "palpate/recording/import_plan.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "recording/import/cell_text.h"
#include "recording/import/column_choice.h"
#include "recording/import/column_unit.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

using Kind = PlannedSeries::Kind;

constexpr std::size_t kPlanSampleRows = 50;

// The words of a name, in small letters: "fingerTip_3.angle [deg]" has fingertip, angle, deg.
std::set<std::string> wordsOf(std::string_view name) {
  std::set<std::string> words;
  std::string word;
  for (const char letter : std::string(name) + " ") {
    if (std::isalpha(static_cast<unsigned char>(letter)) != 0) {
      word += smallLetters(std::string_view(&letter, 1));
    } else if (!word.empty()) {
      words.insert(std::exchange(word, {}));
    }
  }
  return words;
}

bool hasWord(const TableColumn& column, const std::set<std::string>& wanted) {
  const auto words = wordsOf(column.name);
  return std::any_of(
      words.begin(), words.end(), [&](const std::string& word) { return wanted.contains(word); });
}

const std::set<std::string> kTimeWords = {
    "time", "timestamp", "stamp", "date", "datetime", "millis", "micros", "seconds", "clock"};
// Alone they name the time; in front of a number they may name a taxel.
const std::set<std::string> kShortTimeWords = {"t", "s", "ms", "us", "ns"};
const std::set<std::string> kAngleWords = {
    "angle", "angles", "axis", "axes", "joint", "joints", "q"};
const std::set<std::string> kTemperatureWords = {
    "temperature", "temperatures", "temp", "temps", "degc", "celsius"};
// Columns that count rows or say which taxels are active.
const std::set<std::string> kOtherWords = {
    "active", "mask", "index", "frame", "sample", "seq", "sequence", "counter"};

bool isScalar(const TableColumn& column) { return column.shape.empty(); }

bool namesTime(const TableColumn& column) {
  if (hasWord(column, kTimeWords)) return true;
  const auto words = wordsOf(column.name);
  return !words.empty() && column.name.find_first_of("0123456789") == std::string::npos &&
         std::all_of(words.begin(), words.end(), [](const std::string& word) {
           return kShortTimeWords.contains(word);
         });
}

// How well a column fits as the time of a series; 0: not at all.
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

bool sameRows(const TableColumn& first, const TableColumn& second) {
  return !first.numRows || !second.numRows || first.numRows == second.numRows;
}

std::string matrixShape(const MatrixLayout& matrix) {
  return std::to_string(matrix.rows) + " x " + std::to_string(matrix.columns);
}

class Planner {
 public:
  Planner(TableSource& source, const HandDescription& hand, const ImportMapping& mapping)
      : source_(source), columns_(source.columns()), hand_(hand), mapping_(mapping) {}

  ImportPlan plan();
  // The series of a table that holds nothing else: of the files beside a list of taxels.
  std::optional<PlannedSeries> onlySamples(Kind kind);
  const ImportPlan& made() const { return plan_; }

 private:
  PlannedSeries frames();
  PlannedSeries mappedFrames();
  PlannedSeries foundFrames();
  const SampleMapping& mappingOf(Kind kind) const {
    return kind == Kind::kAngles ? mapping_.angles : mapping_.temperatures;
  }
  // Without its time.
  std::optional<PlannedSeries> samples(Kind kind);
  std::vector<TableElement> foundSamples(Kind kind, std::size_t count);
  void findTime(PlannedSeries& series, const std::string& named);
  std::size_t finestOf(std::size_t time);
  void setTimeUnit(PlannedSeries& series);
  std::vector<std::size_t> unnamedTimeColumn();
  PlannedValue conversion(const ValueMapping& values,
                          const TableColumn& column,
                          const std::string& handUnit,
                          const std::string& what);
  void append(PlannedSeries& series,
              const std::vector<TableElement>& elements,
              const std::vector<std::size_t>& targets,
              const PlannedValue& value);
  std::string describe(const std::string& what,
                       const std::vector<TableElement>& elements,
                       const PlannedValue& value,
                       const std::string& unit) const;
  std::vector<std::size_t> candidates() const;
  std::vector<std::vector<double>> sampleValues(const std::vector<std::size_t>& columns);
  [[noreturn]] void refuse(const std::string& why) const { throw FormatError(source_.path(), why); }

  TableSource& source_;
  const std::vector<TableColumn>& columns_;
  const HandDescription& hand_;
  const ImportMapping& mapping_;
  ImportPlan plan_;
  std::string unitUsed_;                 // by the last conversion()
  std::optional<std::size_t> time_;      // column of the frames
  std::set<std::size_t> sampleColumns_;  // of angles and temperatures
};

// The values of numeric columns in the first rows that have them all.
std::vector<std::vector<double>> Planner::sampleValues(const std::vector<std::size_t>& columns) {
  std::vector<std::vector<double>> rows;
  source_.start(columns, std::nullopt);
  TableRow row;
  for (std::size_t i = 0; i < kPlanSampleRows && source_.next(row); ++i)
    if (row.complete && std::all_of(row.states.begin(), row.states.end(), [](CellState state) {
          return state == CellState::kNumber;
        }))
      rows.push_back(row.values);
  return rows;
}

// The unit of a column and of the hand, as a factor and an offset.
PlannedValue Planner::conversion(const ValueMapping& values,
                                 const TableColumn& column,
                                 const std::string& handUnit,
                                 const std::string& what) {
  const bool scaled = values.scale != 1.0 || values.offset != 0.0;
  const bool given = !values.unit.empty();
  unitUsed_ = given ? values.unit : scaled ? handUnit : column.unit;
  PlannedValue value{std::nullopt, values.scale, values.offset};
  if (unitUsed_.empty() || handUnit.empty()) return value;
  if (const auto known = conversionBetween(unitUsed_, handUnit)) {
    value.scale *= known->scale;
    value.offset = value.offset * known->scale + known->offset;
    return value;
  }
  if (given)
    refuse(what + ": the unit " + inQuotes(values.unit) + " can't be converted to the hand's " +
           handUnit + "; give the scale and leave out the unit");
  plan_.notes.push_back(what + ": the file says " + inQuotes(unitUsed_) + ", the hand says " +
                        handUnit + "; the numbers are taken as they are");
  return value;
}

std::string Planner::describe(const std::string& what,
                              const std::vector<TableElement>& elements,
                              const PlannedValue& value,
                              const std::string& unit) const {
  std::set<std::size_t> columns;
  for (const TableElement& each : elements) columns.insert(each.column);
  std::string text = what + ": " + shortened(columns_[elements.front().column].name);
  if (columns.size() > 1)
    text += " to " + shortened(columns_[elements.back().column].name) + " (" +
            counted(columns.size(), "column") + ")";
  for (const std::size_t size : columns_[elements.front().column].shape)
    text += (columns.size() == 1 ? " x " : "") + (columns.size() == 1 ? std::to_string(size) : "");
  if (value.scale != 1.0) text += ", x " + numberText(value.scale);
  if (value.offset != 0.0) text += ", + " + numberText(value.offset);
  if (!unit.empty()) text += " [" + unit + "]";
  return text;
}

// Adds elements to a series: their columns are read once each.
void Planner::append(PlannedSeries& series,
                     const std::vector<TableElement>& elements,
                     const std::vector<std::size_t>& targets,
                     const PlannedValue& value) {
  std::map<std::size_t, std::size_t> begins;  // of the columns' values
  std::size_t at = 0;
  for (const std::size_t column : series.columns) {
    begins[column] = at;
    at += columns_[column].width();
  }
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto [begin, isNew] = begins.try_emplace(elements[e].column, series.values.size());
    if (isNew) {
      series.columns.push_back(elements[e].column);
      series.values.resize(series.values.size() + columns_[elements[e].column].width());
    }
    PlannedValue& planned = series.values[begin->second + elements[e].within];
    if (planned.target) refuse(inQuotes(columns_[elements[e].column].name) + " is used twice");
    planned = value;
    planned.target = targets[e];
  }
}

std::vector<std::size_t> Planner::candidates() const {
  std::vector<std::size_t> chosen;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const TableColumn& column = columns_[c];
    if (!column.isNumeric || column.type == "bool" || time_ == c || sampleColumns_.contains(c))
      continue;
    if (column.width() > kMaxNumbersPerRow) continue;  // images of a camera
    if (timeScore(column, Kind::kFrames) > 0 || timeScore(column, Kind::kAngles) > 0 ||
        timeScore(column, Kind::kTemperatures) > 0 || hasWord(column, kOtherWords))
      continue;
    chosen.push_back(c);
  }
  return chosen;
}

// The elements of the angles or temperatures, by the names of the columns.
std::vector<TableElement> Planner::foundSamples(Kind kind, std::size_t count) {
  const auto& words = kind == Kind::kAngles ? kAngleWords : kTemperatureWords;
  std::vector<std::size_t> named;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (columns_[c].isNumeric && columns_[c].type != "bool" && hasWord(columns_[c], words) &&
        timeScore(columns_[c], kind) == 0 && !hasWord(columns_[c], kOtherWords))
      named.push_back(c);
  const char* what = kind == Kind::kAngles ? "joint angles" : "temperatures";
  for (ColumnGroup& group : groupColumns(columns_, named)) {
    if (group.elements.size() == count) {
      // By their last number, in ascending order: PlotJuggler sorts joint10 before joint2.
      std::stable_sort(
          group.elements.begin(),
          group.elements.end(),
          [](const TableElement& a, const TableElement& b) { return a.indices < b.indices; });
      return group.elements;
    }
    plan_.notes.push_back(std::string(what) + ": " + group.stem + " is " +
                          counted(group.elements.size(), "number") + ", but the hand has " +
                          std::to_string(count) + "; not imported");
  }
  return {};
}

std::optional<PlannedSeries> Planner::samples(Kind kind) {
  const SampleMapping& wanted = mappingOf(kind);
  const bool isAngles = kind == Kind::kAngles;
  const std::size_t count = isAngles ? hand_.axes.size() : hand_.temperatureSensors.size();
  const std::string what = isAngles ? "joint angles" : "temperatures";
  if (wanted.columns == kNoColumns) return std::nullopt;
  if (count == 0) {
    if (!wanted.columns.empty()) refuse(what + ": the hand has none");
    return std::nullopt;
  }
  std::vector<TableElement> elements;
  if (wanted.columns.empty()) {
    elements = foundSamples(kind, count);
    if (elements.empty()) return std::nullopt;
  } else {
    elements = chooseElements(columns_, wanted.columns).elements;
    if (elements.size() != count)
      refuse(what + ": " + inQuotes(wanted.columns) + " is " + counted(elements.size(), "number") +
             " per row, but the hand has " + std::to_string(count));
  }
  PlannedSeries series;
  series.kind = kind;
  series.file = source_.path();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string unit = isAngles ? hand_.axes[i].unit() : "degC";
    const PlannedValue value = conversion(wanted.values, columns_[elements[i].column], unit, what);
    append(series, {elements[i]}, {i}, value);
    if (i == 0) series.description.push_back(describe(what, elements, value, unitUsed_));
  }
  if (!sameRows(columns_[elements.front().column], columns_[elements.back().column]))
    refuse(what + ": the columns have different numbers of rows");
  for (const TableElement& each : elements) sampleColumns_.insert(each.column);
  return series;
}

// Of columns with one name and the same times in several units, as time_ms and time_us, the one
// with the finest unit.
std::size_t Planner::finestOf(std::size_t time) {
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
    const auto rows = sampleValues({finest, c});
    const bool same = !rows.empty() && std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
      return std::abs(row[0] * coarse - row[1] * fine) < coarse;
    });
    if (same) finest = c;
  }
  return finest;
}

// Finds the time of a series, unless the rows have a rate.
void Planner::findTime(PlannedSeries& series, const std::string& named) {
  const bool isFrames = series.kind == Kind::kFrames;
  const auto fail = [&](const std::string& why) { refuse("time: " + why); };
  if (mapping_.time.rateHz) return;
  if (!named.empty() && named != kNoColumns) {
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (columns_[c].name == named || named == "#" + std::to_string(c + 1)) series.time = c;
    if (!series.time)
      fail("there is no column " + inQuotes(named) + "; there are " + namesText(columns_));
    if (!isScalar(columns_[*series.time])) fail(inQuotes(named) + " has several numbers per row");
  } else if (named.empty()) {
    int best = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const int score = timeScore(columns_[c], series.kind);
      if (score <= best || !sameRows(columns_[c], columns_[series.columns.front()])) continue;
      best = score;
      series.time = c;
    }
    if (!series.time && isFrames && time_) series.time = time_;
    if (series.time) series.time = finestOf(*series.time);
  }
  if (!series.time && !isFrames && time_ &&
      sameRows(columns_[*time_], columns_[series.columns.front()]))
    series.time = time_;
  if (!series.time && isFrames)
    fail(
        "no column of times was found; name that column (time), or give the rate of the rows "
        "(rate)");
  if (!series.time) return;
  if (!sameRows(columns_[*series.time], columns_[series.columns.front()]))
    fail(inQuotes(columns_[*series.time].name) + " has " +
         std::to_string(*columns_[*series.time].numRows) + " rows, but " +
         shortened(columns_[series.columns.front()].name) + " has " +
         std::to_string(*columns_[series.columns.front()].numRows));
  setTimeUnit(series);
}

void Planner::setTimeUnit(PlannedSeries& series) {
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
      const auto rows = sampleValues({*series.time});
      const bool whole = std::all_of(rows.begin(), rows.end(), [](const std::vector<double>& row) {
        return row[0] == std::floor(row[0]);
      });
      series.timeUnit = rows.empty() ? TimeUnit::kSeconds : guessTimeUnit(rows.back()[0], whole);
      origin = "guessed from the values; choose the unit if it is another";
    }
  }
  if (series.kind == Kind::kFrames)
    plan_.timeDescription =
        shortened(column.name) + " [" + std::string(nameOf(series.timeUnit)) + ", " + origin + "]";
}

PlannedSeries Planner::mappedFrames() {
  PlannedSeries series;
  series.file = source_.path();
  std::set<std::size_t> missing;
  for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m) missing.insert(m);
  for (const MatrixMapping& wanted : mapping_.matrices) {
    if (wanted.matrix && *wanted.matrix >= hand_.layout->numMatrices())
      refuse("the hand has no matrix " + std::to_string(*wanted.matrix) + ", only " +
             shapeText(*hand_.layout));
    const ChosenElements chosen = chooseElements(columns_, wanted.columns);
    std::vector<std::size_t> places;
    if (!chosen.letters.empty()) {
      places = placesByLetters(chosen, *hand_.layout, wanted.matrix);
    } else {
      const auto order = placesInOrder(
          chosen.elements.size(), *hand_.layout, wanted.matrix, wanted.columnByColumn);
      if (!order)
        refuse(inQuotes(wanted.columns) + " is " + counted(chosen.elements.size(), "number") +
               " per row, but expected is " +
               (wanted.matrix ? matrixShape(hand_.layout->matrix(*wanted.matrix)) + " of matrix " +
                                    std::to_string(*wanted.matrix)
                              : shapeText(*hand_.layout)));
      places = *order;
    }
    const std::string what = wanted.matrix ? hand_.matrixName(*wanted.matrix) : "matrices";
    const PlannedValue value =
        conversion(wanted.values, columns_[chosen.elements.front().column], hand_.unit, what);
    append(series, chosen.elements, places, value);
    series.description.push_back(describe(what, chosen.elements, value, unitUsed_));
    for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m)
      for (const std::size_t place : places)
        if (place >= hand_.layout->offset(m) &&
            place < hand_.layout->offset(m) + hand_.layout->matrix(m).numCells()) {
          missing.erase(m);
          break;
        }
  }
  for (const std::size_t m : missing)
    plan_.notes.push_back(hand_.matrixName(m) + ": nothing is mapped to it, its taxels are 0");
  return series;
}

// In a text without names, a first column more than the taxels that ascends is the time.
std::vector<std::size_t> Planner::unnamedTimeColumn() {
  std::vector<std::size_t> all = candidates();
  if (time_ || mapping_.time.rateHz || mapping_.time.column == kNoColumns || all.size() < 2)
    return all;
  if (std::any_of(columns_.begin(), columns_.end(), [](const TableColumn& column) {
        return timeScore(column, Kind::kFrames) > 0;
      }))
    return all;
  const SensorLayout& layout = *hand_.layout;
  const std::size_t rest = all.size() - 1;
  if (rest != layout.numCells() && rest != layout.numTaxels()) return all;
  if (!std::all_of(all.begin(), all.end(), [&](std::size_t c) { return isScalar(columns_[c]); }))
    return all;
  const auto rows = sampleValues({all.front()});
  bool ascends = rows.size() > 1;
  for (std::size_t i = 1; i < rows.size(); ++i) ascends = ascends && rows[i][0] > rows[i - 1][0];
  if (!ascends) return all;
  time_ = all.front();
  plan_.notes.push_back(shortened(columns_[*time_].name) + " ascends and is taken for the time");
  all.erase(all.begin());
  return all;
}

PlannedSeries Planner::foundFrames() {
  PlannedSeries series;
  series.file = source_.path();
  const SensorLayout& layout = *hand_.layout;
  const std::vector<std::size_t> usable = unnamedTimeColumn();
  const std::vector<ColumnGroup> groups = groupColumns(columns_, usable);
  const auto take = [&](const std::string& what,
                        const std::vector<TableElement>& elements,
                        const std::vector<std::size_t>& places) {
    const PlannedValue value = conversion({}, columns_[elements.front().column], hand_.unit, what);
    append(series, elements, places, value);
    series.description.push_back(describe(what, elements, value, unitUsed_));
  };
  const std::string all = layout.numMatrices() == 1 ? hand_.matrixName(0) : "matrices";
  // One group is the whole hand.
  const ColumnGroup* whole = nullptr;
  for (const ColumnGroup& group : groups) {
    if (!placesOf(group, layout, std::nullopt)) continue;
    if (whole)
      refuse("both " + inQuotes(columns_[whole->columns.front()].name) + " and " +
             inQuotes(columns_[group.columns.front()].name) +
             " could be the taxels; choose the columns of each matrix");
    whole = &group;
  }
  if (whole) {
    take(all, whole->elements, *placesOf(*whole, layout, std::nullopt));
    return series;
  }
  // A group per matrix: by its name, else in the order of the file.
  std::vector<const ColumnGroup*> parts;
  for (std::size_t m = 0; m < layout.numMatrices() && layout.numMatrices() > 1; ++m) {
    const ColumnGroup* named = nullptr;
    for (const ColumnGroup& group : groups) {
      std::string letters;
      for (const std::string& word : wordsOf(columns_[group.columns.front()].name))
        letters += word + " ";
      std::string wanted;
      for (const std::string& word : wordsOf(hand_.matrixName(m))) wanted += word + " ";
      if (letters == wanted && !wanted.empty() && placesOf(group, layout, m)) named = &group;
    }
    if (named && std::find(parts.begin(), parts.end(), named) == parts.end())
      parts.push_back(named);
  }
  if (parts.size() != layout.numMatrices()) {
    parts.clear();
    for (const ColumnGroup& group : groups)
      for (std::size_t m = 0; m < layout.numMatrices(); ++m)
        if (placesOf(group, layout, m)) {
          parts.push_back(&group);
          break;
        }
  }
  if (parts.size() == layout.numMatrices()) {
    bool fits = true;
    for (std::size_t m = 0; m < parts.size(); ++m)
      fits = fits && placesOf(*parts[m], layout, m).has_value();
    if (fits) {
      for (std::size_t m = 0; m < parts.size(); ++m)
        take(hand_.matrixName(m), parts[m]->elements, *placesOf(*parts[m], layout, m));
      return series;
    }
  }
  // All numbers in their order: one array, or all columns of a text.
  const auto inOrder = [&](const std::vector<TableElement>& elements) {
    const auto places = placesInOrder(elements.size(), layout, std::nullopt, false);
    if (places) take(all + ", in order", elements, *places);
    return places.has_value();
  };
  bool isText = !usable.empty();
  std::vector<TableElement> elements;
  for (const std::size_t c : usable) {
    isText = isText && isScalar(columns_[c]);
    elements.push_back({c, 0, {}});
  }
  if (isText && inOrder(elements)) return series;
  for (const ColumnGroup& group : groups)
    if (group.columns.size() == 1 && inOrder(group.elements)) return series;
  refuse("no columns fit the hand " + inQuotes(hand_.name) + ", which has " + shapeText(layout) +
         " (expected are so many columns, or arrays of rows x " + matrixShape(layout.matrix(0)) +
         "); the file has " + namesText(columns_) + "; choose the columns of each matrix");
}

PlannedSeries Planner::frames() {
  PlannedSeries series = mapping_.matrices.empty() ? foundFrames() : mappedFrames();
  for (const std::size_t column : series.columns)
    if (!sameRows(columns_[column], columns_[series.columns.front()]))
      refuse(shortened(columns_[column].name) + " has " +
             std::to_string(*columns_[column].numRows) + " rows, but " +
             shortened(columns_[series.columns.front()].name) + " has " +
             std::to_string(*columns_[series.columns.front()].numRows));
  findTime(series, mapping_.time.column);
  time_ = series.time;
  return series;
}

std::optional<PlannedSeries> Planner::onlySamples(Kind kind) {
  auto series = samples(kind);
  if (series) findTime(*series, mappingOf(kind).time);
  if (series && !series->time) return std::nullopt;
  return series;
}

ImportPlan Planner::plan() {
  // A column of times that the mapping names is none of the taxels.
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (!mapping_.time.column.empty() && (columns_[c].name == mapping_.time.column ||
                                          mapping_.time.column == "#" + std::to_string(c + 1)))
      time_ = c;
  // First the columns of the samples are told apart, which have words for it.
  std::vector<PlannedSeries> others;
  for (const Kind kind : {Kind::kAngles, Kind::kTemperatures})
    if (auto series = samples(kind)) others.push_back(std::move(*series));
  PlannedSeries taxels = frames();
  for (PlannedSeries& series : others) {
    const std::string& own = mappingOf(series.kind).time;
    if (!columns_[series.columns.front()].numRows && own.empty()) {
      // The rows of a text have one time.
      series.time = taxels.time;
      series.timeUnit = taxels.timeUnit;
    } else {
      findTime(series, own);
    }
  }
  const std::size_t taxelColumn = taxels.columns.front();
  plan_.series.push_back(std::move(taxels));
  for (PlannedSeries& series : others) {
    const bool sameRate =
        mapping_.time.rateHz && sameRows(columns_[series.columns.front()], columns_[taxelColumn]);
    if (series.time || sameRate)
      plan_.series.push_back(std::move(series));
    else
      plan_.notes.push_back(
          std::string(series.kind == Kind::kAngles ? "joint angles" : "temperatures") +
          ": no column of times has as many rows; not imported");
  }
  if (mapping_.time.rateHz)
    plan_.timeDescription = "rows at equal intervals, " + numberText(*mapping_.time.rateHz) + " Hz";
  return std::move(plan_);
}

constexpr std::string_view kTaxelListColumns[] = {
    "frame", "time_ms", "matrix", "y", "x", "value", "time_us"};

// Older lists have no time_us.
bool isTaxelList(const std::vector<TableColumn>& columns) {
  constexpr std::size_t kAll = std::size(kTaxelListColumns);
  return (columns.size() == kAll || columns.size() == kAll - 1) &&
         std::equal(
             columns.begin(),
             columns.end(),
             std::begin(kTaxelListColumns),
             [](const TableColumn& column, std::string_view name) { return column.name == name; });
}

// The plan of what `palpate convert` writes to .csv.
ImportPlan planTaxelList(TableSource& source,
                         const HandDescription& hand,
                         const ImportMapping& mapping,
                         const TableOptions& options) {
  if (!mapping.matrices.empty() || mapping.time.rateHz || !mapping.time.column.empty())
    throw FormatError(source.path(),
                      "is a list of active taxels, as palpate convert writes it: its columns can't "
                      "be chosen");
  ImportPlan plan;
  plan.isTaxelList = true;
  PlannedSeries frames;
  frames.file = source.path();
  frames.columns = {0, 2, 3, 4, 5};
  frames.values.resize(frames.columns.size());
  const bool hasUs = source.columns().size() == std::size(kTaxelListColumns);
  frames.time = hasUs ? 6 : 1;
  frames.timeUnit = hasUs ? TimeUnit::kMicroseconds : TimeUnit::kMilliseconds;
  plan.timeDescription = hasUs ? "time_us [us, by the file]" : "time_ms [ms, by the file]";
  frames.description = {"matrices: active taxels, one in each line"};
  plan.series.push_back(std::move(frames));
  for (const auto& [kind, ending] : {std::pair(Kind::kAngles, ".angles.csv"),
                                     std::pair(Kind::kTemperatures, ".temperatures.csv")}) {
    fs::path beside = source.path();
    beside += ending;
    std::error_code ignored;
    if (!fs::exists(beside, ignored)) continue;
    const auto table = openTable(beside, options);
    Planner planner(*table, hand, mapping);
    if (auto series = planner.onlySamples(kind)) plan.series.push_back(std::move(*series));
    const auto& notes = planner.made().notes;
    plan.notes.insert(plan.notes.end(), notes.begin(), notes.end());
  }
  return plan;
}

}  // namespace

std::string shapeText(const SensorLayout& layout) {
  std::string text = layout.numMatrices() == 1
                         ? "1 matrix of "
                         : std::to_string(layout.numMatrices()) + " matrices of ";
  std::vector<std::pair<std::string, std::size_t>> shapes;
  for (const MatrixLayout& matrix : layout.matrices()) {
    const std::string shape = matrixShape(matrix);
    const auto same = std::find_if(
        shapes.begin(), shapes.end(), [&](const auto& each) { return each.first == shape; });
    if (same == shapes.end())
      shapes.emplace_back(shape, 1);
    else
      ++same->second;
  }
  for (std::size_t i = 0; i < shapes.size(); ++i) text += (i > 0 ? " and " : "") + shapes[i].first;
  text += ", " + counted(layout.numCells(), "place");
  if (layout.numTaxels() != layout.numCells())
    text += " with " + counted(layout.numTaxels(), "taxel");
  return text;
}

ImportPlan planImport(TableSource& source,
                      const HandDescription& hand,
                      const ImportMapping& mapping,
                      const TableOptions& options) {
  try {
    if (isTaxelList(source.columns())) return planTaxelList(source, hand, mapping, options);
    return Planner(source, hand, mapping).plan();
  } catch (const FileError&) {
    throw;
  } catch (const FormatError&) {
    throw;
  } catch (const Error& error) {
    throw FormatError(source.path(), error.what());
  }
}

}  // namespace palpate
