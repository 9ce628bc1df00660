#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/column_unit.h"
#include "imports/column_words.h"
#include "imports/matrix_reading.h"
#include "imports/planning.h"

namespace palpate {
namespace {

using Groups = std::vector<ColumnGroup>;
using Matrix = std::optional<std::size_t>;  // of the hand; none: all

// The columns that may be taxels.
std::vector<std::size_t> taxelCandidates(const Planning& p) {
  std::vector<std::size_t> chosen;
  const NameKeys keys = matrixKeys(p.hand);
  for (std::size_t c = 0; c < p.columns.size(); ++c) {
    const TableColumn& column = p.columns[c];
    if (!holdsNumbers(column) || p.times.isOfFrames(c) || p.times.isJoined(c) ||
        p.times.isPart(c) || p.sampleColumns.contains(c))
      continue;
    if (column.width() > kMaxNumbersPerRow) continue;  // images of a camera
    // A matrix may be called "index", of the finger.
    const bool isCounter =
        hasWord(column, kCounterWords) && (isScalar(column) || !namedIn(column.name, keys));
    // The time of frames is one of angles, too, where there is no better one.
    const bool isTime = timeScore(column, PlannedSeries::Kind::kAngles) > 0 ||
                        timeScore(column, PlannedSeries::Kind::kTemperatures) > 0;
    if (!isCounter && !isTime) chosen.push_back(c);
  }
  return chosen;
}

// Each column by its own unit.
void takeTaxels(Planning& p,
                PlannedSeries& series,
                const std::string& what,
                const std::vector<TableElement>& elements,
                const Places& places,
                const ValueMapping& values = {}) {
  struct Part {
    std::vector<TableElement> elements;
    Places places;
  };
  const bool isGiven = values.scale != 1.0 || values.offset != 0.0 || !values.unit.empty();
  std::map<std::tuple<std::string, double, double>, Part> byUnit;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const TableColumn& column = p.columns[elements[e].column];
    Part& part = isGiven ? byUnit[{}] : byUnit[{column.unit, column.scale, column.offset}];
    part.elements.push_back(elements[e]);
    part.places.push_back(readingAt(places[e], *p.hand.layout, p.mapping.components));
  }
  std::string units;
  for (const auto& [key, part] : byUnit) {
    const auto [value, unit] =
        addValues(p, series, what, part.elements, part.places, values, p.hand.unit);
    series.description.push_back(valuesText(p.columns, what, part.elements, value, unit));
    units += (units.empty() ? "" : ", ") + (unit.empty() ? "none" : unit) + " of " +
             shortened(p.columns[part.elements.front().column].name);
  }
  if (byUnit.size() > 1) p.note(reason::kUnits, {what, units});
}

const std::string& firstName(const Planning& p, const ColumnGroup& group) {
  return p.columns[group.columns.front()].name;
}

void takeGroup(Planning& p,
               PlannedSeries& series,
               const std::string& what,
               const ColumnGroup& group,
               Matrix matrix,
               bool isOpposite) {
  const MatrixReading reading = *readGroup(p, group, matrix, isOpposite);
  takeTaxels(p, series, what, group.elements, reading.places);
  noteReading(p, what, group, matrix, reading, isOpposite);
}

// The places of numbers that are chosen: of an array with rows and columns by its shape, unless it
// is column by column; of others in their order. Nothing: they are too few or too many. Throws
// where the shape contradicts the hand.
std::optional<Places> placesFor(Planning& p,
                                const std::vector<TableElement>& elements,
                                Matrix matrix,
                                bool columnByColumn,
                                const std::string& what) {
  auto inOrder = placesInOrder(elements.size(), p.layout, matrix, columnByColumn);
  const std::size_t c = elements.front().column;
  const TableColumn& column = p.columns[c];
  if (columnByColumn || isScalar(column) || elements.size() != column.width() ||
      elements.back().column != c)
    return inOrder;
  const ColumnGroup group = groupColumns(p.columns, {c}).front();
  if (numVaryingIndices(group) < 2) return inOrder;
  for (const bool isOpposite : {false, true}) {
    auto reading = readGroup(p, group, matrix, isOpposite);
    if (!reading) continue;
    noteReading(p, what, group, matrix, *reading, isOpposite);
    return std::move(reading->places);
  }
  if (inOrder) p.refuse(reason::kOtherShape, {namesText({column}), what});
  return std::nullopt;
}

bool hasComponents(const Planning& p) {
  return p.hand.layout->numReadings() != p.hand.layout->numCells();
}

// Nothing tells which number is which component.
void noteInterleaved(Planning& p, const std::string& what) {
  if (hasComponents(p) && p.mapping.components == ComponentOrder::kFound)
    p.note(reason::kInterleaved, {what});
}

std::vector<std::size_t> usedColumnsOf(const std::vector<TableElement>& elements) {
  std::vector<std::size_t> columns;
  for (const TableElement& each : elements)
    if (columns.empty() || columns.back() != each.column) columns.push_back(each.column);
  return columns;
}

PlannedSeries mappedFrames(Planning& p) {
  const SensorLayout& layout = p.layout;
  PlannedSeries series;
  series.file = p.source.path();
  std::vector<bool> isMapped(layout.numMatrices());
  for (const MatrixMapping& wanted : p.mapping.matrices) {
    if (wanted.matrix && *wanted.matrix >= layout.numMatrices())
      p.refuse(reason::kNoSuchMatrix, {std::to_string(*wanted.matrix), shapeText(*p.hand.layout)});
    ChosenElements chosen = chooseElements(p.columns, wanted.columns);
    const std::string what = wanted.matrix ? p.hand.matrixName(*wanted.matrix) : "matrices";
    if (!chosen.letters.empty() && hasComponents(p))
      p.refuse(reason::kPatternComponents, {wanted.columns});
    std::optional<Places> places;
    if (auto taxels = taxelsByComponent(p, usedColumnsOf(chosen.elements), wanted.matrix, what)) {
      chosen.elements = std::move(taxels->elements);
      places = std::move(taxels->places);
    } else {
      places = chosen.letters.empty()
                   ? placesFor(p, chosen.elements, wanted.matrix, wanted.columnByColumn, what)
                   : placesByLetters(chosen, layout, wanted.matrix);
      noteInterleaved(p, what);
    }
    if (!places)
      p.refuse(reason::kOtherNumbers,
               {wanted.columns,
                counted(chosen.elements.size(), "number"),
                wanted.matrix ? matrixShape(p.hand.layout->matrix(*wanted.matrix)) + " of matrix " +
                                    std::to_string(*wanted.matrix)
                              : shapeText(*p.hand.layout)});
    takeTaxels(p, series, what, chosen.elements, *places, wanted.values);
    for (std::size_t m = 0; m < layout.numMatrices(); ++m)
      isMapped[m] =
          isMapped[m] || std::any_of(places->begin(), places->end(), [&](std::size_t place) {
            return place >= layout.offset(m) &&
                   place < layout.offset(m) + layout.matrix(m).numCells();
          });
  }
  for (std::size_t m = 0; m < layout.numMatrices(); ++m)
    if (!isMapped[m])
      p.plan.notes.push_back(sentenceOf(reason::kNothingMapped, {p.hand.matrixName(m)}));
  return series;
}

std::string allName(const Planning& p) {
  return p.layout.numMatrices() == 1 ? p.hand.matrixName(0) : "matrices";
}

// One group is the whole hand.
bool takeWhole(Planning& p, PlannedSeries& series, const Groups& groups, bool isOpposite) {
  const ColumnGroup* whole = nullptr;
  for (const ColumnGroup& group : groups) {
    if (!readGroup(p, group, std::nullopt, isOpposite)) continue;
    if (whole)
      p.refuse(reason::kBothFit,
               {firstName(p, *whole), firstName(p, group), "the taxels" + componentsAdvice(p)});
    whole = &group;
  }
  if (whole) takeGroup(p, series, allName(p), *whole, std::nullopt, isOpposite);
  return whole != nullptr;
}

// The columns that have the name of a matrix in theirs.
bool takeNamedParts(Planning& p, PlannedSeries& series) {
  const auto parts = namedParts(p, taxelCandidates(p));
  for (std::size_t m = 0; m < parts.size(); ++m) {
    const auto& [group, isOpposite, inOrder] = parts[m];
    if (inOrder.empty())
      takeGroup(p, series, p.hand.matrixName(m), group, m, isOpposite);
    else
      takeTaxels(p, series, p.hand.matrixName(m) + ", in order", group.elements, inOrder);
  }
  return !parts.empty();
}

// A group per matrix: those that have a matrix's name are its, the others are taken in the order of
// the file, each for the first matrix of its shape.
bool takeParts(Planning& p, PlannedSeries& series, const Groups& groups, bool isOpposite) {
  if (p.layout.numMatrices() < 2) return false;
  const auto fits = [&](const ColumnGroup& group, std::size_t m) {
    return readGroup(p, group, m, isOpposite).has_value();
  };
  const auto keys = matrixKeys(p.hand);
  std::vector<const ColumnGroup*> parts(p.layout.numMatrices());
  std::vector<const ColumnGroup*> others;
  for (const ColumnGroup& group : groups) {
    const auto m = namedIn(nameWithoutUnit(firstName(p, group)), keys);
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
    takeGroup(p, series, p.hand.matrixName(m), *parts[m], m, isOpposite);
    order += (m > 0 ? ", " : "") + p.hand.matrixName(m) + " = " +
             shortened(p.columns[parts[m]->columns.front()].name);
  }
  p.note(reason::kOrderOfFile, {order});
  return true;
}

bool takeLetters(Planning& p, PlannedSeries& series, const Groups& groups) {
  std::vector<std::size_t> all;
  for (const ColumnGroup& group : groups)
    all.insert(all.end(), group.columns.begin(), group.columns.end());
  std::sort(all.begin(), all.end());
  const auto lettered = letterGroup(p.columns, all);
  const auto reading = lettered ? readLetters(*lettered, p.layout) : std::nullopt;
  if (!reading) return false;
  takeTaxels(p, series, allName(p), lettered->elements, reading->places);
  p.note(allName(p) + ": " + reading->note);
  return true;
}

// The parts of a table that are matrices by their names only.
void takeEachByName(Planning& p, PlannedSeries& series) {
  std::string names;
  for (std::size_t m = 0; m < p.layout.numMatrices(); ++m)
    names += (m > 0 ? ", " : "") + shortened(p.hand.matrixName(m));
  for (std::size_t m = 0; m < p.layout.numMatrices(); ++m) {
    const std::string name = p.hand.matrixName(m);
    std::vector<std::size_t> part = taxelCandidates(p);
    std::erase_if(part, [&](std::size_t c) {
      const std::string_view column = p.columns[c].name;
      return nameKey(column.substr(0, column.find('['))) != nameKey(name);
    });
    if (part.empty()) p.refuse(reason::kNoFile, {name, names});
    std::vector<TableElement> elements;
    for (const ColumnGroup& group : groupColumns(p.columns, part))
      elements.insert(elements.end(), group.elements.begin(), group.elements.end());
    const auto places = placesFor(p, elements, m, false, name);
    if (!places)
      p.refuse(reason::kOtherFile,
               {name, counted(elements.size(), "number"), matrixShape(p.hand.layout->matrix(m))});
    takeTaxels(p, series, name, elements, *places);
  }
}

// All numbers in their order, but for a first one that is the time or counts the rows.
bool takeInOrder(Planning& p,
                 PlannedSeries& series,
                 std::vector<TableElement> elements,
                 bool isArray) {
  const auto fit = [&](std::size_t count) {
    return placesInOrder(count, p.layout, std::nullopt, false);
  };
  auto places = fit(elements.size());
  if (!places && elements.size() > 1 && fit(elements.size() - 1) &&
      p.times.leaveOutFirst(series, elements.front().column, isArray)) {
    elements.erase(elements.begin());
    places = fit(elements.size());
  }
  if (places) takeTaxels(p, series, allName(p) + ", in order", elements, *places);
  return places.has_value();
}

// All columns of a text, whose names say nothing else; or one array of numbers in a row.
bool takeRow(Planning& p, PlannedSeries& series, const Groups& groups) {
  const auto isRow = [](const ColumnGroup& group) { return numVaryingIndices(group) < 2; };
  std::vector<TableElement> all;
  for (const ColumnGroup& group : groups)
    all.insert(all.end(), group.elements.begin(), group.elements.end());
  std::sort(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
  const bool areColumns = !all.empty() && std::all_of(groups.begin(), groups.end(), isRow) &&
                          std::all_of(all.begin(), all.end(), [&](const TableElement& each) {
                            return isScalar(p.columns[each.column]);
                          });
  if (areColumns && takeInOrder(p, series, std::move(all), false)) return true;
  for (const ColumnGroup& group : groups)
    if (group.columns.size() == 1 && isRow(group) && takeInOrder(p, series, group.elements, true))
      return true;
  return false;
}

// Where the lines of a text have as many numbers as a matrix has columns, a frame may be a line for
// each row of the matrices.
void joinFrameLines(Planning& p, PlannedSeries& series) {
  const auto width = static_cast<std::size_t>(p.layout.matrix(0).columns);
  std::size_t rows = 0;
  for (const MatrixLayout& matrix : p.layout.matrices()) {
    if (static_cast<std::size_t>(matrix.columns) != width) return;
    rows += static_cast<std::size_t>(matrix.rows);
  }
  const bool areNumbers = std::all_of(p.columns.begin(), p.columns.end(), [](const auto& column) {
    return column.isNumeric && !column.numRows;
  });
  if (rows < 2 || p.columns.size() != width || !areNumbers ||
      placesInOrder(width, p.layout, std::nullopt, false))
    return;
  const std::string how = p.source.joinLines(rows);
  if (how.empty()) return;
  p.note(how);
  if (p.columns.size() > rows * width && !hasWord(p.columns[0], kCounterWords))
    p.times.leaveOutFirst(series, 0, false);
}

PlannedSeries foundFrames(Planning& p) {
  PlannedSeries series;
  series.file = p.source.path();
  if (p.source.hasNamedParts()) {
    takeEachByName(p, series);
    return series;
  }
  joinFrameLines(p, series);
  const std::vector<std::size_t> candidates = taxelCandidates(p);
  if (const auto taxels = taxelsByComponent(p, candidates, std::nullopt, allName(p))) {
    takeTaxels(p, series, allName(p) + ", x, y, z by name", taxels->elements, taxels->places);
    return series;
  }
  noteInterleaved(p, allName(p));
  const Groups groups = groupColumns(p.columns, candidates);
  if (takeNamedParts(p, series)) return series;
  for (const bool isOpposite : {false, true})
    if (takeWhole(p, series, groups, isOpposite) || takeParts(p, series, groups, isOpposite))
      return series;
  if (takeLetters(p, series, groups) || takeRow(p, series, groups)) return series;
  p.refuse(reason::kNothingFits,
           {p.hand.name,
            shapeText(*p.hand.layout),
            matrixShape(p.hand.layout->matrix(0)),
            namesText(p.columns) + unusableText(p.columns) + p.source.advice() +
                formsText(p.columns, p.layout) + componentsAdvice(p)});
}

// Whether the last axis of the arrays is the frames by its name ("time"), or the first one is;
// nothing: no array has such a name. Throws Error: it is another axis.
std::optional<bool> frameAxisByName(const std::vector<TableColumn>& columns) {
  static const std::set<std::string> kFrameAxes = {
      "time", "t", "times", "timestamp", "frame", "frames", "sample", "samples"};
  std::optional<bool> isLast;
  for (const TableColumn& column : columns) {
    const auto& axes = column.axes;
    if (axes.size() < 2) continue;
    const auto named = std::find_if(axes.begin(), axes.end(), [](const std::string& axis) {
      return kFrameAxes.contains(smallLetters(axis));
    });
    if (named == axes.end()) continue;
    const bool isThisLast = named + 1 == axes.end();
    if ((named != axes.begin() && !isThisLast) || isLast.value_or(isThisLast) != isThisLast)
      throw Error("the axis " + inQuotes(*named) + " of " + shortened(column.name) +
                  " is the frames by its name, but stands elsewhere than in other arrays, or in "
                  "the middle; save all arrays with the frames first");
    isLast = isThisLast;
  }
  return isLast;
}

// Whether frames can be found when the rows of the arrays are as they are now.
bool anyFrames(const Planning& p) {
  const std::size_t numMatrices = p.layout.numMatrices();
  const auto& mapped = p.mapping.matrices;
  if (!mapped.empty())
    return std::all_of(mapped.begin(), mapped.end(), [&](const MatrixMapping& wanted) {
      if (wanted.matrix && *wanted.matrix >= numMatrices) return false;
      const ChosenElements chosen = chooseElements(p.columns, wanted.columns);
      return !chosen.letters.empty() ||
             placesInOrder(chosen.elements.size(), p.layout, wanted.matrix, false);
    });
  std::vector<std::size_t> narrow = taxelCandidates(p);
  std::erase_if(narrow, [&](std::size_t c) { return p.columns[c].width() > p.layout.numCells(); });
  const Groups groups = groupColumns(p.columns, narrow);
  return std::any_of(groups.begin(), groups.end(), [&](const ColumnGroup& group) {
    for (const IndexOrder order : {IndexOrder::kRowColumn, IndexOrder::kColumnRow}) {
      if (placesOf(group, p.layout, std::nullopt, order)) return true;
      for (std::size_t m = 0; m < numMatrices && numMatrices > 1; ++m)
        if (placesOf(group, p.layout, m, order)) return true;
    }
    return false;
  });
}

// The first and the last axis have the same size: the shapes can't tell which one the frames are.
void noteFirstAxis(Planning& p, const std::vector<std::size_t>& arrays) {
  const auto found = std::find_if(
      arrays.begin(), arrays.end(), [&](std::size_t c) { return !isScalar(p.columns[c]); });
  if (!p.mapping.matrices.empty() || found == arrays.end() || !anyFrames(p)) return;
  const bool isMatlab = p.source.isColumnMajor();
  p.note(reason::kSameSizes,
         {isMatlab ? "last" : "first",
          p.columns[*found].name,
          isMatlab ? "first" : "last",
          std::to_string(*p.columns[*found].numRows)});
}

}  // namespace

void findFrameAxis(Planning& p) {
  std::set<std::uint64_t> firsts;
  std::set<std::uint64_t> lasts;
  std::vector<std::size_t> arrays;
  for (std::size_t c = 0; c < p.columns.size(); ++c) {
    const TableColumn& column = p.columns[c];
    std::uint64_t numbers = 0;
    if (!column.numRows || !column.isNumeric ||
        __builtin_mul_overflow(*column.numRows, column.width(), &numbers) || numbers <= 1)
      continue;
    arrays.push_back(c);
    firsts.insert(*column.numRows);
    lasts.insert(column.shape.empty() ? *column.numRows : column.shape.back());
  }
  const auto reverse = [&] {
    for (const std::size_t c : arrays) p.source.reverseAxes(c);
    p.isReversed = !p.isReversed;
  };
  if (const auto isLast = frameAxisByName(p.columns)) {
    if (*isLast) reverse();
    if (*isLast) p.note(reason::kAxisByName, {});
    return;
  }
  // Where all arrays share their last size, frames may be there.
  if (lasts.size() != 1 || *lasts.begin() == 1) return;
  if (lasts == firsts) return noteFirstAxis(p, arrays);
  const bool fits = anyFrames(p);
  if (fits && !p.mapping.matrices.empty()) return;
  reverse();
  const bool fitsReversed = anyFrames(p);
  const bool isSure = firsts.size() > 1;
  if (fits && fitsReversed && !isSure) p.refuse(reason::kEitherAxis, {});
  if (fitsReversed)
    p.note(reason::kLastAxis, {std::to_string(*lasts.begin())});
  else
    reverse();
}

PlannedSeries chooseFrames(Planning& p) {
  PlannedSeries series = p.mapping.matrices.empty() ? foundFrames(p) : mappedFrames(p);
  const TableColumn& first = p.columns[series.columns.front()];
  for (const std::size_t c : series.columns)
    if (!sameRows(p.columns[c], first))
      p.refuse(reason::kOtherRows,
               {p.columns[c].name,
                std::to_string(*p.columns[c].numRows),
                first.name,
                std::to_string(*first.numRows)});
  return series;
}

}  // namespace palpate
