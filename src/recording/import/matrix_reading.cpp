#include "recording/import/matrix_reading.h"

#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

#include "recording/import/column_unit.h"

namespace palpate {

std::optional<MatrixReading> readWhole(const ColumnGroup& group,
                                       const SensorLayout& layout,
                                       const std::string& name,
                                       const OrderOf& orderOf,
                                       bool isReversed) {
  const IndexOrder order = orderOf(group);
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
    const auto places = placesOf(last, layout, std::nullopt, orderOf(last));
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

std::vector<NamedPart> namedParts(const std::vector<TableColumn>& columns,
                                  const std::vector<std::size_t>& chosen,
                                  const HandDescription& hand,
                                  const OrderOf& orderOf) {
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
        if (!isTaken &&
            placesOf(group, layout, m, isOpposite ? opposite(orderOf(group)) : orderOf(group)))
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
    throw Error("both " + inQuotes(columns[parts.back().group.columns.front()].name) + " and " +
                inQuotes(columns[fitting[1].group.columns.front()].name) + " could be " +
                hand.matrixName(m) + "; choose the columns of each matrix (--matrix)");
  }
  return parts;
}

}  // namespace palpate
