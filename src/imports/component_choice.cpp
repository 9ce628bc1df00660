#include "imports/component_choice.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"

#include "imports/column_unit.h"
#include "imports/column_words.h"
#include "imports/matrix_reading.h"
#include "imports/planning.h"

namespace palpate {
namespace {

constexpr std::size_t kComponents = 3;

bool hasThree(const MatrixLayout& matrix) { return matrix.touch.components == 3; }

bool haveAllThree(const SensorLayout& layout) {
  return std::all_of(layout.matrices().begin(), layout.matrices().end(), hasThree);
}

// The component that a name tells, and the name without it: "t0_x" is x of "t0_?", "by3" y of
// "b?3".
struct NamedComponent {
  std::size_t component = 0;
  std::string stem;
};
std::optional<NamedComponent> namedComponent(std::string_view name) {
  const auto isLetter = [&](std::size_t i) {
    return i < name.size() && std::isalpha(static_cast<unsigned char>(name[i])) != 0;
  };
  for (std::size_t i = name.size(); i-- > 0;) {
    const char letter = smallLetters(name.substr(i, 1)).front();
    const bool isLong = i > 1 && isLetter(i - 1) && isLetter(i - 2);
    if (letter < 'x' || letter > 'z' || isLetter(i + 1) || isLong) continue;
    NamedComponent named{static_cast<std::size_t>(letter - 'x'), std::string(name)};
    named.stem[i] = '?';
    return named;
  }
  return std::nullopt;
}

// One number of each taxel, z, as a group, and for each of them x and y.
struct Components {
  ColumnGroup z;
  std::array<std::vector<TableElement>, kComponents - 1> beside;
};

// Columns by the letters of their names.
std::vector<Components> letteredComponents(const Planning& p,
                                           const std::vector<std::size_t>& columns) {
  std::array<std::map<std::string, std::size_t>, kComponents> byStem;
  std::map<std::size_t, std::string> stems;
  for (const std::size_t c : columns) {
    if (!isScalar(p.columns[c])) continue;
    auto named = namedComponent(nameWithoutUnit(p.columns[c].name));
    if (!named) continue;
    byStem[named->component].emplace(named->stem, c);
    stems.emplace(c, std::move(named->stem));
  }
  std::vector<std::size_t> complete;  // of z
  for (const auto& [stem, c] : byStem[2])
    if (byStem[0].contains(stem) && byStem[1].contains(stem)) complete.push_back(c);
  std::sort(complete.begin(), complete.end());
  std::vector<Components> found;
  for (ColumnGroup& group : groupColumns(p.columns, complete)) {
    Components& made = found.emplace_back();
    for (const TableElement& z : group.elements)
      for (std::size_t k = 0; k < made.beside.size(); ++k)
        made.beside[k].push_back({byStem[k].at(stems.at(z.column)), 0, z.indices});
    made.z = std::move(group);
  }
  return found;
}

// An array of which an axis is x, y, z: its last one, or its first one.
std::optional<Components> ofArray(const Planning& p, std::size_t c) {
  const TableColumn& column = p.columns[c];
  if (column.shape.size() < 2) return std::nullopt;
  const bool isLast = column.shape.back() == kComponents;
  const bool isFirst = column.shape.front() == kComponents;
  if (!isLast && !isFirst) return std::nullopt;
  const bool isTakenLast = isLast && (!isFirst || p.source.isColumnMajor() == p.isReversed);
  Components made;
  made.z = groupColumns(p.columns, {c}).front();
  const std::vector<TableElement> all = std::exchange(made.z.elements, {});
  const std::size_t numIndices = all.front().indices.size();
  const auto axis =
      static_cast<std::ptrdiff_t>(numIndices - (isTakenLast ? 1 : column.shape.size()));
  for (TableElement element : all) {
    const auto k = static_cast<std::size_t>(element.indices.at(static_cast<std::size_t>(axis)));
    element.indices.erase(element.indices.begin() + axis);
    (k == 2 ? made.z.elements : made.beside.at(k)).push_back(std::move(element));
  }
  if (made.z.letters.size() == numIndices) made.z.letters.erase(made.z.letters.begin() + axis);
  return made;
}

}  // namespace

SensorLayout numbersLayout(const SensorLayout& layout, ComponentOrder order) {
  std::vector<MatrixLayout> matrices = layout.matrices();
  for (MatrixLayout& matrix : matrices) {
    if (!hasThree(matrix)) continue;
    const bool isPlanar = order == ComponentOrder::kPlanar;
    Mask mask;
    if (isPlanar)
      for (std::size_t k = 0; k < kComponents; ++k)
        mask.insert(mask.end(), matrix.staticMask.begin(), matrix.staticMask.end());
    else
      for (const std::uint8_t exists : matrix.staticMask)
        mask.insert(mask.end(), kComponents, exists);
    (isPlanar ? matrix.rows : matrix.columns) *= static_cast<int>(kComponents);
    matrix.staticMask = mask;
    matrix.dynamicMask = std::move(mask);
    matrix.touch = {};
  }
  try {
    return SensorLayout(std::move(matrices));
  } catch (const std::invalid_argument&) {
    throw Error(
        "a matrix of three components and more than 85 columns (planar: rows) can't be imported; "
        "stream it ('palpate record --stream')");
  }
}

std::size_t readingAt(std::size_t place, const SensorLayout& layout, ComponentOrder order) {
  if (order != ComponentOrder::kPlanar) return place;
  std::size_t m = 0;
  while (place >= layout.readingOffset(m) + layout.matrix(m).numReadings()) ++m;
  if (!hasThree(layout.matrix(m))) return place;
  const std::size_t numCells = layout.matrix(m).numCells();
  const std::size_t within = place - layout.readingOffset(m);
  return layout.readingOffset(m) + kComponents * (within % numCells) + within / numCells;
}

std::optional<ComponentTaxels> taxelsByComponent(Planning& p,
                                                 const std::vector<std::size_t>& columns,
                                                 std::optional<std::size_t> matrix,
                                                 const std::string& what) {
  if (p.mapping.components != ComponentOrder::kFound || !haveAllThree(*p.hand.layout))
    return std::nullopt;
  std::vector<Components> all = letteredComponents(p, columns);
  for (const std::size_t c : columns)
    if (auto array = ofArray(p, c)) all.push_back(std::move(*array));
  // The taxels of one component have the layout of the hand.
  const SensorLayout numbers = std::exchange(p.layout, *p.hand.layout);
  const Components* taken = nullptr;
  std::optional<MatrixReading> reading;
  bool isTakenOpposite = false;
  for (const bool isOpposite : {false, true}) {
    if (taken) break;
    for (const Components& each : all) {
      auto read = readGroup(p, each.z, matrix, isOpposite);
      if (!read) continue;
      const auto nameOf = [&](const Components& of) {
        return p.columns[of.z.columns.front()].name;
      };
      if (taken) p.refuse(reason::kBothFit, {nameOf(*taken), nameOf(each), what});
      taken = &each;
      reading = std::move(read);
      isTakenOpposite = isOpposite;
    }
  }
  Components inOrder;
  if (taken) {
    noteReading(p, what, taken->z, matrix, *reading, isTakenOpposite);
  } else {  // all of them, in the order of the file
    for (Components& each : all) {
      const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      append(inOrder.z.elements, each.z.elements);
      for (std::size_t k = 0; k < each.beside.size(); ++k)
        append(inOrder.beside[k], each.beside[k]);
    }
    if (auto places = placesInOrder(inOrder.z.elements.size(), p.layout, matrix, false)) {
      taken = &inOrder;
      reading = MatrixReading{std::move(*places)};
      if (all.size() > 1) p.note(reason::kComponentsInOrder, {what});
    }
  }
  p.layout = numbers;
  if (!taken) return std::nullopt;
  ComponentTaxels taxels;
  for (std::size_t i = 0; i < reading->places.size(); ++i)
    for (std::size_t k = 0; k < kComponents; ++k) {
      taxels.elements.push_back(k == 2 ? taken->z.elements[i] : taken->beside[k].at(i));
      taxels.places.push_back(kComponents * reading->places[i] + k);
    }
  return taxels;
}

std::string componentsAdvice(const Planning& p) {
  const SensorLayout& layout = *p.hand.layout;
  if (layout.numReadings() != layout.numCells()) return {};
  const auto isTriple = [&](std::size_t count) {
    return count == kComponents * layout.numCells() || count == kComponents * layout.numTaxels();
  };
  const auto numbers = static_cast<std::size_t>(
      std::count_if(p.columns.begin(), p.columns.end(), [](const TableColumn& column) {
        return holdsNumbers(column) && isScalar(column);
      }));
  const bool isOne =
      std::any_of(p.columns.begin(), p.columns.end(), [&](const TableColumn& column) {
        return holdsNumbers(column) && !isScalar(column) && isTriple(column.width());
      });
  if (!isOne && !isTriple(numbers) && !(numbers > 0 && isTriple(numbers - 1))) return {};
  return "; with three numbers per taxel, the matrices in hand.json need \"components\": 3";
}

}  // namespace palpate
