#include "imports/matrix_reading.h"

#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

#include "imports/column_unit.h"
#include "imports/column_words.h"

namespace palpate {
namespace {

// How a group is read, unless only the other order fits: by letters, or as its writer keeps arrays.
IndexOrder orderOf(const Planning& p, const ColumnGroup& group, bool isOpposite) {
  const bool isReversed = group.columns.size() == 1 && p.source.isColumnMajor() != p.isReversed;
  const IndexOrder natural =
      orderByLetters(group).value_or(isReversed ? IndexOrder::kColumnRow : IndexOrder::kRowColumn);
  return isOpposite ? opposite(natural) : natural;
}

// One group as the whole hand: by matrix, row and column, or by number; or the matrices are the
// last index; or they form one table, one below the other or side by side.
std::optional<MatrixReading> readWhole(const Planning& p,
                                       const ColumnGroup& group,
                                       bool isOpposite) {
  const SensorLayout& layout = p.layout;
  const std::string name = shortened(p.columns[group.columns.front()].name);
  const bool isReversed = p.source.isColumnMajor() != p.isReversed;
  const IndexOrder order = orderOf(p, group, isOpposite);
  const std::size_t varying = numVaryingIndices(group);
  MatrixReading reading;
  auto first = placesOf(group, layout, std::nullopt, order);
  if (group.elements.size() > layout.numCells()) return std::nullopt;
  std::string brackets;
  for (std::size_t i = 0; i < varying; ++i) brackets += "[#]";
  const bool isArray = group.columns.size() == 1 || group.stem.ends_with(brackets);
  if (layout.numMatrices() > 1 && varying == 2) {
    if (orderByLetters(group)) first.reset();  // the indices are row and column
    for (const bool isSideBySide : {false, true}) {
      const auto tiled = placesTiled(group, layout, order, isSideBySide);
      if (!tiled || tiled == first) continue;
      if (first && isArray)
        throw Error(name +
                    " may hold the matrices one after the other, or side by side: save it as "
                    "frames x matrices x rows x columns");
      if (first) continue;
      first = tiled;
      reading.note = std::string("matrices: they are taken to be ") +
                     (isSideBySide ? "side by side" : "one below the other") + " in " + name;
    }
  }
  if (layout.numMatrices() > 1 && varying == 3) {
    const ColumnGroup last = lastIndexFirst(group);
    const bool isLast = orderByLetters(last).has_value() && !orderByLetters(group);
    const auto places = placesOf(last, layout, std::nullopt, orderOf(p, last, isOpposite));
    const std::string axis = isReversed ? "first" : "last";
    if (places && (isLast || (!first && isArray))) {
      first = places;
      reading.note = "matrices: the " + axis + " index of " + name + " is taken for the matrix";
    } else if (isLast) {
      first.reset();
    } else if (places && first && isArray && group.columns.size() == 1 && places != first) {
      reading.note = "matrices: the " + std::string(isReversed ? "last" : "first") + " index of " +
                     name + " is taken for the matrix, but the " + axis + " one has as many values";
    }
  }
  if (!first) return std::nullopt;
  reading.places = std::move(*first);
  return reading;
}

// Why the order of the taxels is another one than a reader would expect, or a guess.
std::optional<Reason> orderReason(const Planning& p,
                                  const ColumnGroup& group,
                                  std::optional<std::size_t> matrix,
                                  IndexOrder order) {
  const bool isArray = group.columns.size() == 1;
  const auto others = placesOf(group, p.layout, matrix, opposite(order));
  const auto letters = orderByLetters(group);
  const bool isColumnRow = order == IndexOrder::kColumnRow;
  std::optional<Reason> why;
  if (others == placesOf(group, p.layout, matrix, order)) {
    if (isArray && group.elements.size() > 1 && p.source.isColumnMajor()) why = reason::kRowByRow;
  } else if (letters) {
    if (letters != order)
      why = reason::kExchanged;
    else if (isArray && isColumnRow)
      why = reason::kAxesTransposed;
  } else if (isArray) {
    if (isColumnRow != p.isReversed) why = reason::kTransposed;
  } else if (isColumnRow) {
    why = reason::kNamesTransposed;
  } else if (others) {
    why = reason::kOrderOfNames;
  }
  return why;
}

}  // namespace

std::optional<MatrixReading> readGroup(const Planning& p,
                                       const ColumnGroup& group,
                                       std::optional<std::size_t> matrix,
                                       bool isOpposite) {
  if (!matrix) return readWhole(p, group, isOpposite);
  auto places = placesOf(group, p.layout, matrix, orderOf(p, group, isOpposite));
  if (!places) return std::nullopt;
  return MatrixReading{std::move(*places)};
}

void noteReading(Planning& p,
                 const std::string& what,
                 const ColumnGroup& group,
                 std::optional<std::size_t> matrix,
                 const MatrixReading& reading,
                 bool isOpposite) {
  if (!reading.note.empty())
    p.note(reading.note + (isOpposite ? ", with rows and columns exchanged" : ""));
  else if (const auto why = orderReason(p, group, matrix, orderOf(p, group, isOpposite)))
    p.note(*why, {what, p.columns[group.columns.front()].name});
}

std::optional<MatrixReading> readLetters(const ColumnGroup& lettered, const SensorLayout& layout) {
  if (layout.numMatrices() > 1) return std::nullopt;
  const auto rows = placesOf(lettered, layout, 0, IndexOrder::kRowColumn);
  const auto columns = placesOf(lettered, layout, 0, IndexOrder::kColumnRow);
  if (!rows && !columns) return std::nullopt;
  // Where both fit, the one that is row by row in the file.
  const auto isSorted = [](const auto& places) {
    return places && std::is_sorted(places->begin(), places->end());
  };
  const bool areRows = rows && (!columns || (isSorted(rows) && !isSorted(columns)));
  if (rows && columns && rows != columns && isSorted(rows) == isSorted(columns))
    throw Error("the letters of the columns " + inQuotes(lettered.stem) +
                " may be rows or columns; choose the columns in their order (--matrix)");
  return MatrixReading{
      areRows ? *rows : *columns,
      std::string("the letters in the names are taken for the ") + (areRows ? "rows" : "columns")};
}

NameKeys matrixKeys(const HandDescription& hand) {
  NameKeys keys;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) addName(keys, hand.matrixName(m), m);
  for (std::size_t m = 0; m < std::min(hand.matrices.size(), hand.layout->numMatrices()); ++m)
    addName(keys, hand.matrices[m].shortName, m);
  return keys;
}

std::vector<NamedPart> namedParts(const Planning& p, const std::vector<std::size_t>& chosen) {
  const std::vector<TableColumn>& columns = p.columns;
  const HandDescription& hand = p.hand;
  const SensorLayout& layout = *hand.layout;
  const auto keys = matrixKeys(hand);
  std::vector<std::vector<std::size_t>> named(layout.numMatrices());
  for (const std::size_t c : chosen)
    if (const auto m = namedIn(nameWithoutUnit(columns[c].name), keys)) named[*m].push_back(c);
  std::vector<NamedPart> parts;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    std::vector<NamedPart> fitting;
    ColumnGroup all;
    for (const bool isOpposite : {false, true})
      for (ColumnGroup& group : groupColumns(columns, named[m])) {
        if (!isOpposite)
          all.elements.insert(all.elements.end(), group.elements.begin(), group.elements.end());
        const bool isTaken =
            std::any_of(fitting.begin(), fitting.end(), [&](const NamedPart& part) {
              return part.group.columns.front() == group.columns.front();
            });
        if (!isTaken && placesOf(group, layout, m, orderOf(p, group, isOpposite)))
          fitting.push_back({std::move(group), isOpposite, {}});
      }
    // Of several the one that is called as the matrix, and nothing else.
    const auto isCalledSo = [&](const NamedPart& part) {
      const auto words = wordsOf(columns[part.group.columns.front()].name);
      return words == wordsOf(hand.matrixName(m));
    };
    if (fitting.size() > 1 && std::count_if(fitting.begin(), fitting.end(), isCalledSo) == 1)
      fitting = {*std::find_if(fitting.begin(), fitting.end(), isCalledSo)};
    if (fitting.empty() && layout.numMatrices() > 1 &&
        std::all_of(named[m].begin(), named[m].end(), [&](std::size_t c) {
          return isScalar(columns[c]);
        })) {
      std::sort(all.elements.begin(), all.elements.end(), [](const auto& a, const auto& b) {
        return a.column < b.column;
      });
      if (auto places = placesInOrder(all.elements.size(), layout, m, false))
        fitting.push_back({std::move(all), false, std::move(*places)});
    }
    if (fitting.empty()) return {};
    parts.push_back(std::move(fitting.front()));
    if (fitting.size() == 1) continue;
    if (layout.numMatrices() == 1) return {};  // takeWhole() says so
    p.refuse(reason::kBothFit,
             {columns[parts.back().group.columns.front()].name,
              columns[fitting[1].group.columns.front()].name,
              hand.matrixName(m)});
  }
  return parts;
}

}  // namespace palpate
