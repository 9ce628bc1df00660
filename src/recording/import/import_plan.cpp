#include "palpate/recording/import_plan.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "recording/import/cell_text.h"
#include "recording/import/column_choice.h"
#include "recording/import/column_unit.h"
#include "recording/import/column_words.h"
#include "recording/import/matrix_reading.h"
#include "recording/import/plan_checks.h"
#include "recording/import/sample_choice.h"
#include "recording/import/time_choice.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

using Kind = PlannedSeries::Kind;

std::vector<std::string> namesOf(const HandDescription& hand, Kind kind) {
  std::vector<std::string> names;
  for (const AxisDescription& axis : hand.axes)
    if (kind == Kind::kAngles) names.push_back(axis.name);
  for (const TemperatureSensorDescription& sensor : hand.temperatureSensors)
    if (kind == Kind::kTemperatures) names.push_back(sensor.name);
  return names;
}

std::string matrixShape(const MatrixLayout& matrix) {
  return std::to_string(matrix.rows) + " x " + std::to_string(matrix.columns);
}

class Planner {
 public:
  Planner(TableSource& source, const HandDescription& hand, const ImportMapping& mapping)
      : source_(source), columns_(source.columns()), hand_(hand), mapping_(mapping) {
    nameMatrices();
  }

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
  void nameMatrices();
  std::optional<MatrixReading> wholeHand(const ColumnGroup& group, bool isOpposite) const;
  IndexOrder naturalOrder(const ColumnGroup& group) const;
  IndexOrder orderOf(const ColumnGroup& group, bool isOpposite) const;
  void noteOrder(const std::string& what,
                 const ColumnGroup& group,
                 std::optional<std::size_t> matrix,
                 IndexOrder order);
  void take(PlannedSeries& series,
            const std::string& what,
            const std::vector<TableElement>& elements,
            const std::vector<std::size_t>& places,
            const ValueMapping& values = {});
  void takeGroup(PlannedSeries& series,
                 const std::string& what,
                 const ColumnGroup& group,
                 std::optional<std::size_t> matrix,
                 bool isOpposite);
  bool takeWhole(PlannedSeries& series, const std::vector<ColumnGroup>& groups, bool isOpposite);
  bool takeNamedParts(PlannedSeries& series);
  bool takeLetters(PlannedSeries& series, const std::vector<ColumnGroup>& groups);
  bool takeParts(PlannedSeries& series, const std::vector<ColumnGroup>& groups, bool isOpposite);
  void takeEachByName(PlannedSeries& series);
  bool takeColumnsInOrder(PlannedSeries& series, const std::vector<ColumnGroup>& groups);
  bool takeArrayInOrder(PlannedSeries& series, const ColumnGroup& group);
  void joinFrameLines(PlannedSeries& series);
  bool anyFrames() const;
  void noteFirstAxis(const std::vector<std::size_t>& arrays);
  void findFrameAxis();
  void findCounter(PlannedSeries& series);
  void noteUnused();
  std::optional<std::vector<std::size_t>> placesByShape(const MatrixMapping& wanted,
                                                        const ChosenElements& chosen,
                                                        const std::string& what);
  std::string allName() const;
  std::string formsText() const;
  void note(const std::string& text) {
    if (std::find(plan_.notes.begin(), plan_.notes.end(), text) == plan_.notes.end())
      plan_.notes.push_back(text);
  }
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
  [[noreturn]] void refuse(const std::string& why) const { throw FormatError(source_.path(), why); }

  TableSource& source_;
  const std::vector<TableColumn>& columns_;
  const HandDescription& hand_;
  ImportMapping mapping_;  // with the rate of the file, if that is all there is
  ImportPlan plan_;
  TimeChoice times_{source_, mapping_, plan_};
  bool isReversed_ = false;              // the axes of all arrays
  std::string unitUsed_;                 // by the last conversion()
  std::set<std::size_t> sampleColumns_;  // of angles and temperatures
};

// The unit of a column and of the hand, as a factor and an offset.
PlannedValue Planner::conversion(const ValueMapping& values,
                                 const TableColumn& column,
                                 const std::string& handUnit,
                                 const std::string& what) {
  const bool scaled = values.scale != 1.0 || values.offset != 0.0;
  const bool given = !values.unit.empty();
  unitUsed_ = given ? values.unit : scaled ? handUnit : column.unit;
  PlannedValue value{std::nullopt, values.scale, values.offset};
  if (!scaled && (column.scale != 1.0 || column.offset != 0.0)) {
    value.scale = column.scale;
    value.offset = column.offset;
    note(what + ": " + shortened(column.name) +
         " is scaled as its scale_factor and add_offset say");
  }
  for (const double missing : column.missing)
    note(what + ": " + numberText(missing) + " in " + shortened(column.name) +
         " is a missing value, as its _FillValue or missing_value says");
  const bool isOurs = std::any_of(columns_.begin(), columns_.end(), [](const TableColumn& each) {
    return each.name == "meta" && !each.isNumeric;  // palpate convert's values are the hand's
  });
  if (unitUsed_.empty() && !handUnit.empty() && handUnit != "counts" && !isOurs)
    note(what + ": the file gives no unit; the numbers are taken as " + handUnit);
  if (unitUsed_.empty() || handUnit.empty()) return value;
  if (const auto known = conversionBetween(unitUsed_, handUnit)) {
    value.scale *= known->scale;
    value.offset = value.offset * known->scale + known->offset;
    return value;
  }
  if (given)
    refuse(what + ": the unit " + inQuotes(values.unit) + " can't be converted to the hand's " +
           handUnit + "; give the scale and leave out the unit");
  note(what + ": the file says " + inQuotes(unitUsed_) + ", the hand says " + handUnit +
       "; the numbers are taken as they are");
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
    if (!column.isNumeric || column.type == "bool" || times_.isOfFrames(c) || times_.isJoined(c) ||
        times_.isPart(c) || sampleColumns_.contains(c))
      continue;
    if (column.width() > kMaxNumbersPerRow) continue;  // images of a camera
    // A matrix may be called "index", of the finger.
    const bool isCounter = hasWord(column, kCounterWords) &&
                           (isScalar(column) || !namedIn(column.name, matrixKeys(hand_)));
    if (timeScore(column, Kind::kFrames) > 0 || timeScore(column, Kind::kAngles) > 0 ||
        timeScore(column, Kind::kTemperatures) > 0 || isCounter)
      continue;
    chosen.push_back(c);
  }
  return chosen;
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
    elements = findSamples(columns_, kind, namesOf(hand_, kind), plan_.notes, sampleColumns_);
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

// The places of an array with rows and columns: its shape decides, unless the mapping says that it
// is column by column. Nothing for numbers in a row. Throws where the shape contradicts the hand.
std::optional<std::vector<std::size_t>> Planner::placesByShape(const MatrixMapping& wanted,
                                                               const ChosenElements& chosen,
                                                               const std::string& what) {
  const SensorLayout& layout = *hand_.layout;
  const std::size_t column = chosen.elements.front().column;
  if (wanted.columnByColumn || isScalar(columns_[column]) ||
      chosen.elements.size() != columns_[column].width() || chosen.elements.back().column != column)
    return std::nullopt;
  const ColumnGroup group = groupColumns(columns_, {column}).front();
  if (numVaryingIndices(group) < 2) return std::nullopt;
  for (const bool isOpposite : {false, true}) {
    if (!wanted.matrix) {
      const auto whole = wholeHand(group, isOpposite);
      if (!whole) continue;
      if (!whole->note.empty())
        note(whole->note + (isOpposite ? ", with rows and columns exchanged" : ""));
      if (whole->note.empty()) noteOrder(what, group, {}, orderOf(group, isOpposite));
      return whole->places;
    }
    const IndexOrder order = orderOf(group, isOpposite);
    const auto places = placesOf(group, layout, wanted.matrix, order);
    if (!places) continue;
    noteOrder(what, group, wanted.matrix, order);
    return places;
  }
  if (!placesInOrder(chosen.elements.size(), layout, wanted.matrix, false)) return std::nullopt;
  refuse(namesText({columns_[column]}) + " has as many numbers as " + what +
         ", but other rows and columns; save it as frames x rows x columns, or as frames x taxels");
}

// "thumb=COLUMNS" of a mapping is of the matrix of that name.
void Planner::nameMatrices() {
  for (MatrixMapping& wanted : mapping_.matrices) {
    const auto equals = wanted.columns.find('=');
    if (wanted.matrix || equals == std::string::npos || numberNamed(columns_, wanted.columns))
      continue;
    const NameKeys keys = matrixKeys(hand_);
    const auto named = keys.find(nameKey(wanted.columns.substr(0, equals)));
    if (named == keys.end()) continue;
    wanted.matrix = named->second;
    wanted.columns.erase(0, equals + 1);
  }
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
    const std::string what = wanted.matrix ? hand_.matrixName(*wanted.matrix) : "matrices";
    if (!chosen.letters.empty()) {
      places = placesByLetters(chosen, *hand_.layout, wanted.matrix);
    } else if (const auto shaped = placesByShape(wanted, chosen, what)) {
      places = *shaped;
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
    take(series, what, chosen.elements, places, wanted.values);
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

// How a group is read unless only the other order fits: by letters, or as its writer keeps arrays.
IndexOrder Planner::naturalOrder(const ColumnGroup& group) const {
  if (const auto order = orderByLetters(group)) return *order;
  const bool isArray = group.columns.size() == 1;
  return isArray && source_.isColumnMajor() != isReversed_ ? IndexOrder::kColumnRow
                                                           : IndexOrder::kRowColumn;
}

IndexOrder Planner::orderOf(const ColumnGroup& group, bool isOpposite) const {
  return isOpposite ? opposite(naturalOrder(group)) : naturalOrder(group);
}

// Says where the order of the taxels is another one than a reader would expect, or a guess.
void Planner::noteOrder(const std::string& what,
                        const ColumnGroup& group,
                        std::optional<std::size_t> matrix,
                        IndexOrder order) {
  const SensorLayout& layout = *hand_.layout;
  const bool isArray = group.columns.size() == 1;
  const auto places = placesOf(group, layout, matrix, order);
  const auto others = placesOf(group, layout, matrix, opposite(order));
  const auto letters = orderByLetters(group);
  const auto say = [&](const char* text) {
    note(what + ": " + inQuotes(columns_[group.columns.front()].name) + text);
  };
  if (isArray && letters == order && order == IndexOrder::kColumnRow && others != places)
    say(" has columns x rows, as the names of its axes say, and is transposed");
  if (isArray && others == places && group.elements.size() > 1 && source_.isColumnMajor())
    say(" is taken row by row; where MATLAB's (:) made it, use a mapping with \"order\": "
        "\"columns\"");
  if (others == places || letters == order) return;
  if (letters)
    say(": rows and columns are exchanged: the names fit the hand only so");
  else if (isArray && order == (isReversed_ ? IndexOrder::kRowColumn : IndexOrder::kColumnRow))
    say(" has columns x rows in the file and is transposed");
  else if (!isArray && order == IndexOrder::kColumnRow)
    say(": the names count columns, then rows: transposed");
  else if (!isArray && others)
    say(": the numbers in the names are taken for row and column, in this order; choose another "
        "one by --matrix 'NAME{x}_{y}'");
}

// Each column by its own unit.
void Planner::take(PlannedSeries& series,
                   const std::string& what,
                   const std::vector<TableElement>& elements,
                   const std::vector<std::size_t>& places,
                   const ValueMapping& values) {
  struct Part {
    std::vector<TableElement> elements;
    std::vector<std::size_t> places;
  };
  const bool isGiven = values.scale != 1.0 || values.offset != 0.0 || !values.unit.empty();
  std::map<std::tuple<std::string, double, double>, Part> byUnit;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const TableColumn& column = columns_[elements[e].column];
    Part& part = isGiven ? byUnit[{}] : byUnit[{column.unit, column.scale, column.offset}];
    part.elements.push_back(elements[e]);
    part.places.push_back(places[e]);
  }
  std::string units;
  for (const auto& [unit, part] : byUnit) {
    const PlannedValue value =
        conversion(values, columns_[part.elements.front().column], hand_.unit, what);
    append(series, part.elements, part.places, value);
    series.description.push_back(
        describe(what, byUnit.size() == 1 ? elements : part.elements, value, unitUsed_));
    units += (units.empty() ? "" : ", ") + (unitUsed_.empty() ? "none" : unitUsed_) + " of " +
             shortened(columns_[part.elements.front().column].name);
  }
  if (byUnit.size() > 1)
    note(what + ": the columns have different units, each is converted by its own: " + units);
}

void Planner::takeGroup(PlannedSeries& series,
                        const std::string& what,
                        const ColumnGroup& group,
                        std::optional<std::size_t> matrix,
                        bool isOpposite) {
  const IndexOrder order = orderOf(group, isOpposite);
  take(series, what, group.elements, *placesOf(group, *hand_.layout, matrix, order));
  noteOrder(what, group, matrix, order);
}

std::string Planner::allName() const {
  return hand_.layout->numMatrices() == 1 ? hand_.matrixName(0) : "matrices";
}

std::optional<MatrixReading> Planner::wholeHand(const ColumnGroup& group, bool isOpposite) const {
  return readWhole(
      group,
      *hand_.layout,
      shortened(columns_[group.columns.front()].name),
      [&](const ColumnGroup& each) { return orderOf(each, isOpposite); },
      source_.isColumnMajor() != isReversed_);
}

// One group is the whole hand.
bool Planner::takeWhole(PlannedSeries& series,
                        const std::vector<ColumnGroup>& groups,
                        bool isOpposite) {
  const ColumnGroup* whole = nullptr;
  std::optional<MatrixReading> taken;
  for (const ColumnGroup& group : groups) {
    auto reading = wholeHand(group, isOpposite);
    if (!reading) continue;
    if (whole)
      refuse("both " + inQuotes(columns_[whole->columns.front()].name) + " and " +
             inQuotes(columns_[group.columns.front()].name) +
             " could be the taxels; choose the columns of each matrix (--matrix)");
    whole = &group;
    taken = std::move(reading);
  }
  if (!whole) return false;
  take(series, allName(), whole->elements, taken->places);
  if (taken->note.empty())
    noteOrder(allName(), *whole, std::nullopt, orderOf(*whole, isOpposite));
  else
    note(taken->note + (isOpposite ? ", with rows and columns exchanged" : ""));
  return true;
}

// The columns that have the name of a matrix in theirs.
bool Planner::takeNamedParts(PlannedSeries& series) {
  const auto parts = namedParts(columns_, candidates(), hand_, [&](const ColumnGroup& group) {
    return orderOf(group, false);
  });
  for (std::size_t m = 0; m < parts.size(); ++m)
    if (parts[m].inOrder.empty())
      takeGroup(series, hand_.matrixName(m), parts[m].group, m, parts[m].isOpposite);
    else
      take(series, hand_.matrixName(m) + ", in order", parts[m].group.elements, parts[m].inOrder);
  return !parts.empty();
}

// A group per matrix: those that have a matrix's name are its, the others are taken in the order of
// the file, each for the first matrix of its shape.
bool Planner::takeParts(PlannedSeries& series,
                        const std::vector<ColumnGroup>& groups,
                        bool isOpposite) {
  const SensorLayout& layout = *hand_.layout;
  if (layout.numMatrices() < 2) return false;
  const auto fits = [&](const ColumnGroup& group, std::size_t m) {
    return placesOf(group, layout, m, orderOf(group, isOpposite)).has_value();
  };
  const auto keys = matrixKeys(hand_);
  std::vector<const ColumnGroup*> parts(layout.numMatrices());
  std::vector<const ColumnGroup*> others;
  for (const ColumnGroup& group : groups) {
    const auto m = namedIn(nameWithoutUnit(columns_[group.columns.front()].name), keys);
    if (m && !parts[*m] && fits(group, *m))
      parts[*m] = &group;
    else
      others.push_back(&group);
  }
  for (const ColumnGroup* group : others) {
    bool fitsAny = false;
    bool isTaken = false;
    for (std::size_t m = 0; m < parts.size() && !isTaken; ++m) {
      if (!fits(*group, m)) continue;
      fitsAny = true;
      isTaken = !parts[m];
      if (isTaken) parts[m] = group;
    }
    // More groups of such shapes than matrices: which ones can't be told.
    if (fitsAny && !isTaken) return false;
  }
  if (std::find(parts.begin(), parts.end(), nullptr) != parts.end()) return false;
  std::string order;
  for (std::size_t m = 0; m < parts.size(); ++m) {
    takeGroup(series, hand_.matrixName(m), *parts[m], m, isOpposite);
    order += (m > 0 ? ", " : "") + hand_.matrixName(m) + " = " +
             shortened(columns_[parts[m]->columns.front()].name);
  }
  note("matrices: no names tell them apart; taken in the order of the file: " + order +
       " (--matrix NAME=COLUMNS chooses others)");
  return true;
}

bool Planner::takeLetters(PlannedSeries& series, const std::vector<ColumnGroup>& groups) {
  std::vector<std::size_t> all;
  for (const ColumnGroup& group : groups)
    all.insert(all.end(), group.columns.begin(), group.columns.end());
  std::sort(all.begin(), all.end());
  const auto lettered = letterGroup(columns_, all);
  const auto reading = lettered ? readLetters(*lettered, *hand_.layout) : std::nullopt;
  if (!reading) return false;
  take(series, allName(), lettered->elements, reading->places);
  note(allName() + ": " + reading->note);
  return true;
}

// The parts of a table that are matrices by their names only.
void Planner::takeEachByName(PlannedSeries& series) {
  const SensorLayout& layout = *hand_.layout;
  const auto isNamed = [&](std::string_view column, std::size_t m) {
    return nameKey(column.substr(0, column.find('['))) == nameKey(hand_.matrixName(m));
  };
  std::string names;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m)
    names += (m > 0 ? ", " : "") + shortened(hand_.matrixName(m));
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const std::string name = hand_.matrixName(m);
    std::vector<std::size_t> part;
    for (const std::size_t c : candidates())
      if (isNamed(columns_[c].name, m)) part.push_back(c);
    if (part.empty())
      refuse("no file is called as the matrix " + inQuotes(name) +
             "; call the files as the matrices of the hand (" + names +
             "), or choose the columns of each matrix (--matrix " + shortened(name) + "='NAME*')");
    std::vector<TableElement> elements;
    for (const ColumnGroup& group : groupColumns(columns_, part))
      elements.insert(elements.end(), group.elements.begin(), group.elements.end());
    const auto inOrder = placesInOrder(elements.size(), layout, m, false);
    if (part.size() == 1 && !isScalar(columns_[part[0]])) {
      MatrixMapping wanted;
      wanted.matrix = m;
      ChosenElements chosen;
      chosen.elements = elements;
      const auto shaped = placesByShape(wanted, chosen, name);
      if (shaped) {
        take(series, name, elements, *shaped);
        continue;
      }
    }
    if (!inOrder)
      refuse(inQuotes(name) + " has " + counted(elements.size(), "number") +
             " per row, but its matrix has " + matrixShape(layout.matrix(m)));
    take(series, name, elements, *inOrder);
  }
}

// All numbers in their order: of all columns of a text, whose names say nothing else.
bool Planner::takeColumnsInOrder(PlannedSeries& series, const std::vector<ColumnGroup>& groups) {
  std::vector<std::size_t> all;
  for (const ColumnGroup& group : groups) {
    if (numVaryingIndices(group) > 1) return false;
    all.insert(all.end(), group.columns.begin(), group.columns.end());
  }
  std::sort(all.begin(), all.end());
  if (all.empty() ||
      !std::all_of(all.begin(), all.end(), [&](std::size_t c) { return isScalar(columns_[c]); }))
    return false;
  const auto fits = [&](std::size_t count) {
    return placesInOrder(count, *hand_.layout, std::nullopt, false);
  };
  if (!fits(all.size()) && fits(all.size() - 1) && times_.leaveOutFirst(series, all.front(), false))
    all.erase(all.begin());
  const auto places = fits(all.size());
  if (!places) return false;
  std::vector<TableElement> elements;
  for (const std::size_t c : all) elements.push_back({c, 0, {}});
  take(series, allName() + ", in order", elements, *places);
  return true;
}

// The same of one array of numbers in a row.
bool Planner::takeArrayInOrder(PlannedSeries& series, const ColumnGroup& group) {
  if (group.columns.size() != 1) return false;
  const SensorLayout& layout = *hand_.layout;
  if (numVaryingIndices(group) > 1) return false;
  std::vector<TableElement> elements = group.elements;
  auto places = placesInOrder(elements.size(), layout, std::nullopt, false);
  const bool oneMore =
      elements.size() > 1 && placesInOrder(elements.size() - 1, layout, std::nullopt, false);
  if (!places && oneMore && times_.leaveOutFirst(series, group.columns.front(), true)) {
    elements.erase(elements.begin());
    places = placesInOrder(elements.size(), layout, std::nullopt, false);
  }
  if (!places) return false;
  take(series, allName() + ", in order", elements, *places);
  return true;
}

// Where the lines of a text have as many numbers as a matrix has columns, a frame may be a line for
// each row of the matrices.
void Planner::joinFrameLines(PlannedSeries& series) {
  const auto width = static_cast<std::size_t>(hand_.layout->matrix(0).columns);
  std::size_t rows = 0;
  for (const MatrixLayout& matrix : hand_.layout->matrices()) {
    if (static_cast<std::size_t>(matrix.columns) != width) return;
    rows += static_cast<std::size_t>(matrix.rows);
  }
  const bool areNumbers = std::all_of(columns_.begin(), columns_.end(), [](const auto& column) {
    return column.isNumeric && !column.numRows;
  });
  if (rows < 2 || columns_.size() != width || !areNumbers ||
      placesInOrder(width, *hand_.layout, std::nullopt, false))
    return;
  const std::string how = source_.joinLines(rows);
  if (how.empty()) return;
  plan_.notes.push_back(how);
  if (columns_.size() > rows * width && !hasWord(columns_[0], kCounterWords))
    times_.leaveOutFirst(series, 0, false);
}

PlannedSeries Planner::foundFrames() {
  PlannedSeries series;
  series.file = source_.path();
  if (source_.hasNamedParts()) {
    takeEachByName(series);
    return series;
  }
  joinFrameLines(series);
  const std::vector<ColumnGroup> groups = groupColumns(columns_, candidates());
  if (takeNamedParts(series)) return series;
  for (const bool isOpposite : {false, true})
    if (takeWhole(series, groups, isOpposite) || takeParts(series, groups, isOpposite))
      return series;
  if (takeLetters(series, groups) || takeColumnsInOrder(series, groups)) return series;
  for (const ColumnGroup& group : groups)
    if (takeArrayInOrder(series, group)) return series;
  const SensorLayout& layout = *hand_.layout;
  refuse("no columns fit the hand " + inQuotes(hand_.name) + ", which has " + shapeText(layout) +
         " (as many columns are expected, or arrays of rows x " + matrixShape(layout.matrix(0)) +
         "); the file has " + namesText(columns_) + unusableText(columns_) + source_.advice() +
         formsText());
}

// Whether frames can be found when the rows of the arrays are as they are now.
bool Planner::anyFrames() const {
  const SensorLayout& layout = *hand_.layout;
  if (!mapping_.matrices.empty())
    return std::all_of(
        mapping_.matrices.begin(), mapping_.matrices.end(), [&](const MatrixMapping& wanted) {
          if (wanted.matrix && *wanted.matrix >= layout.numMatrices()) return false;
          const ChosenElements chosen = chooseElements(columns_, wanted.columns);
          return !chosen.letters.empty() ||
                 placesInOrder(chosen.elements.size(), layout, wanted.matrix, false);
        });
  std::vector<std::size_t> narrow = candidates();
  std::erase_if(narrow, [&](std::size_t c) { return columns_[c].width() > layout.numCells(); });
  const std::vector<ColumnGroup> groups = groupColumns(columns_, narrow);
  return std::any_of(groups.begin(), groups.end(), [&](const ColumnGroup& group) {
    for (const IndexOrder order : {IndexOrder::kRowColumn, IndexOrder::kColumnRow}) {
      if (placesOf(group, layout, std::nullopt, order)) return true;
      for (std::size_t m = 0; m < layout.numMatrices() && layout.numMatrices() > 1; ++m)
        if (placesOf(group, layout, m, order)) return true;
    }
    return false;
  });
}

// The first and the last axis have the same size: the shapes can't tell which one the frames are.
void Planner::noteFirstAxis(const std::vector<std::size_t>& arrays) {
  const auto found = std::find_if(
      arrays.begin(), arrays.end(), [&](std::size_t c) { return !isScalar(columns_[c]); });
  if (!mapping_.matrices.empty() || found == arrays.end() || !anyFrames()) return;
  const bool isMatlab = source_.isColumnMajor();
  plan_.notes.push_back("the " + std::string(isMatlab ? "last" : "first") + " axis of " +
                        shortened(columns_[*found].name) + " is taken for the frames, but the " +
                        (isMatlab ? "first" : "last") + " one has the same size, " +
                        std::to_string(*columns_[*found].numRows) +
                        "; if the frames are that one, exchange them in the file");
}

// Where all arrays share their last size, frames may be there: MATLAB's pad(frames, rows, columns),
// NumPy's rows x columns x frames. The axes are reversed where the hand fits only then.
void Planner::findFrameAxis() {
  std::set<std::uint64_t> firsts;
  std::set<std::uint64_t> lasts;
  std::vector<std::size_t> arrays;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const TableColumn& column = columns_[c];
    std::uint64_t numbers = 0;
    if (!column.numRows || !column.isNumeric ||
        __builtin_mul_overflow(*column.numRows, column.width(), &numbers) || numbers <= 1)
      continue;
    arrays.push_back(c);
    firsts.insert(*column.numRows);
    lasts.insert(column.shape.empty() ? *column.numRows : column.shape.back());
  }
  const auto reverse = [&] {
    for (const std::size_t c : arrays) source_.reverseAxes(c);
    isReversed_ = !isReversed_;
  };
  if (const auto named = frameAxisByName(columns_)) {
    if (*named) reverse();
    if (*named) note("the last axis of the arrays is the frames, as its name says");
    return;
  }
  if (lasts.size() != 1 || *lasts.begin() == 1) return;
  if (lasts == firsts) return noteFirstAxis(arrays);
  const bool fits = anyFrames();
  if (fits && !mapping_.matrices.empty()) return;
  reverse();
  const bool fitsReversed = anyFrames();
  const bool isSure = firsts.size() > 1;
  if (fits && fitsReversed && !isSure)
    refuse(
        "the frames may be the first or the last axis of the arrays: choose the first by "
        "--matrix NAME, or save them with the frames first");
  if (fitsReversed)
    plan_.notes.push_back("the last axis of the arrays, of " + std::to_string(*lasts.begin()) +
                          ", is taken for the frames");
  else
    reverse();
}

// What can be done where nothing fits: columns are chosen only where there are enough of them.
std::string Planner::formsText() const {
  std::size_t numNumbers = 0;
  bool areArrays = false;
  for (const TableColumn& column : columns_) {
    if (column.isNumeric && column.width() <= kMaxNumbersPerRow) numNumbers += column.width();
    areArrays = areArrays || !isScalar(column);
  }
  const std::string chosen = numNumbers >= hand_.layout->numTaxels()
                                 ? "; choose the columns of each matrix (--matrix)"
                                 : "";
  if (areArrays)
    return chosen +
           "; arrays are read as frames x rows x columns, frames x matrices x rows x "
           "columns, or frames x taxels";
  if (!chosen.empty()) return chosen;
  return "; texts are read with a number per taxel and a frame per line, or with a line for each "
         "row of the matrices; a line per taxel is read only as palpate convert writes it "
         "(frame, time_ms, matrix, y, x, value)";
}

PlannedSeries Planner::frames() {
  PlannedSeries series = mapping_.matrices.empty() ? foundFrames() : mappedFrames();
  for (const std::size_t column : series.columns)
    if (!sameRows(columns_[column], columns_[series.columns.front()]))
      refuse(shortened(columns_[column].name) + " has " +
             std::to_string(*columns_[column].numRows) + " rows, but " +
             shortened(columns_[series.columns.front()].name) + " has " +
             std::to_string(*columns_[series.columns.front()].numRows));
  times_.find(series, mapping_.time.column);
  findCounter(series);
  return series;
}

// A column that numbers the frames tells which ones are missing.
void Planner::findCounter(PlannedSeries& series) {
  std::optional<std::size_t> counter = times_.counter();
  const TableColumn& values = columns_[series.columns.front()];
  for (std::size_t c = 0; c < columns_.size() && !counter; ++c)
    if (columns_[c].isNumeric && columns_[c].type != "bool" && isScalar(columns_[c]) &&
        sameRows(columns_[c], values) && c != series.time && !times_.isPart(c) &&
        !sampleColumns_.contains(c) && hasWord(columns_[c], kCounterWords) &&
        columns_[c].name.find_first_of("0123456789") == std::string::npos &&
        std::find(series.columns.begin(), series.columns.end(), c) == series.columns.end() &&
        times_.countsFrames(c))
      counter = c;
  if (!counter) return;
  const bool isWithin = *counter == series.columns.front();  // the first number of the array
  series.number = isWithin ? 0 : series.values.size();
  if (isWithin) return;
  series.columns.push_back(*counter);
  series.values.emplace_back();
}

std::optional<PlannedSeries> Planner::onlySamples(Kind kind) {
  auto series = samples(kind);
  if (series) times_.find(*series, mappingOf(kind).time);
  if (series && !series->time) return std::nullopt;
  return series;
}

// Names the columns that nothing is made of, but for those about the others ("m0_active", "meta").
void Planner::noteUnused() {
  std::set<std::size_t> used;
  for (const PlannedSeries& series : plan_.series) {
    used.insert(series.columns.begin(), series.columns.end());
    if (series.time && series.timeFile.empty()) used.insert(*series.time);
  }
  std::vector<TableColumn> unused;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (!used.contains(c) && !times_.isPart(c) && !times_.hasSameTimes(c) &&
        !hasWord(columns_[c], {"active", "mask", "meta"}))
      unused.push_back(columns_[c]);
  if (unused.empty()) return;
  std::string text = "not used: " + namesText(unused);
  for (const Kind kind : {Kind::kAngles, Kind::kTemperatures}) {
    const bool isPlanned =
        std::any_of(plan_.series.begin(), plan_.series.end(), [&](const PlannedSeries& series) {
          return series.kind == kind;
        });
    const std::size_t count = namesOf(hand_, kind).size();
    const auto numNumbers = std::count_if(unused.begin(), unused.end(), [](const auto& column) {
      return column.isNumeric && isScalar(column);
    });
    if (count > 0 && !isPlanned && mappingOf(kind).columns.empty() &&
        static_cast<std::size_t>(numNumbers) >= count)
      text += kind == Kind::kAngles ? "; --angles chooses joint angles"
                                    : "; --temperatures chooses temperatures";
  }
  plan_.notes.push_back(text);
}

ImportPlan Planner::plan() {
  const bool hasTimes = std::any_of(columns_.begin(), columns_.end(), [](TableColumn column) {
    column.shape.clear();  // a vector of MATLAB has two axes
    return timeScore(column, Kind::kFrames) > 0;
  });
  const bool isAsked = !hasTimes && mapping_.time == TimeMapping{};
  if (const auto rate = isAsked ? source_.rateHz() : std::nullopt) {
    mapping_.time.rateHz = rate;
    plan_.notes.push_back("time: the file gives a rate of " + numberText(*rate) + " Hz");
  }
  plan_.rateHz = mapping_.time.rateHz;
  if (const std::string note = source_.rowNote(); !note.empty()) plan_.notes.push_back(note);
  if (!source_.hasNamedParts()) findFrameAxis();
  times_.prepare();
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
      series.timeWithin = taxels.timeWithin;
      series.timeUnit = taxels.timeUnit;
      series.timeFactor = taxels.timeFactor;
      series.timeFile = taxels.timeFile;
    } else {
      times_.find(series, own);
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
  if (mapping_.matrices.empty())
    plan_.doubts = numberingDoubts(columns_, plan_.series.front(), *hand_.layout);
  const PlannedSeries& planned = plan_.series.front();
  const bool hasOwnTimes = planned.time && planned.timeFile.empty();
  for (std::string& doubt : source_.doubts(hasOwnTimes ? std::numeric_limits<double>::infinity()
                                           : planned.number ? kMostMissingFrames
                                                            : 0.0))
    plan_.doubts.push_back(std::move(doubt));
  for (PlannedSeries& series : plan_.series) addOrigins(columns_, series);
  noteUnused();
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
