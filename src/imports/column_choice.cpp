#include "imports/column_choice.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/cell_text.h"
#include "imports/column_unit.h"
#include "imports/import_texts.h"

namespace palpate {
namespace {

bool isDigit(char letter) { return letter >= '0' && letter <= '9'; }

// The whole numbers in a name, and the name with # in their places.
std::string stemOf(std::string_view name, std::vector<std::int64_t>& numbers) {
  constexpr std::size_t kMaxDigits = 15;
  std::string stem;
  for (std::size_t at = 0; at < name.size();) {
    std::size_t end = at;
    while (end < name.size() && isDigit(name[end])) ++end;
    if (end == at) {
      stem += name[at++];
      continue;
    }
    numbers.push_back(end - at > kMaxDigits ? -1 : *parseInteger(name.substr(at, end - at)));
    stem += '#';
    at = end;
  }
  return stem;
}

// Adds the numbers of a column's elements to those before. Throws Error where they are too many for
// a hand: 65,536 taxels of three indices take half a million.
void countElements(const TableColumn& column, std::size_t firstIndices, std::size_t& counted) {
  constexpr std::size_t kMaxNumbers = 1u << 22;
  counted += column.width() * (4 + firstIndices + column.shape.size());
  if (counted > kMaxNumbers)
    throw Error("too many numbers per row could be taxels; choose the columns of each matrix");
}

// Appends the elements of a column, with these first indices.
void appendElements(const std::vector<TableColumn>& columns,
                    std::size_t column,
                    const std::vector<std::int64_t>& first,
                    std::vector<TableElement>& elements) {
  const std::vector<std::size_t>& shape = columns[column].shape;
  const std::size_t width = columns[column].width();
  std::size_t numbers = elements.size() * (4 + first.size() + shape.size());
  countElements(columns[column], first.size(), numbers);
  for (std::size_t within = 0; within < width; ++within) {
    TableElement element{column, within, first};
    element.indices.resize(first.size() + shape.size());
    std::size_t rest = within;
    for (std::size_t d = shape.size(); d > 0; --d) {
      element.indices[first.size() + d - 1] = static_cast<std::int64_t>(rest % shape[d - 1]);
      rest /= shape[d - 1];
    }
    elements.push_back(std::move(element));
  }
}

// The indices of the elements by position, without those that are the same in all elements.
std::vector<std::size_t> varyingPositions(const ColumnGroup& group) {
  std::vector<std::size_t> positions;
  const auto& first = group.elements.front().indices;
  for (std::size_t p = 0; p < first.size(); ++p)
    if (std::any_of(group.elements.begin(), group.elements.end(), [&](const TableElement& each) {
          return each.indices[p] != first[p];
        }))
      positions.push_back(p);
  return positions;
}

// Whether every taxel has exactly one number, and no number is outside.
bool isComplete(const Places& places,
                const SensorLayout& layout,
                std::optional<std::size_t> matrix) {
  std::vector<std::uint8_t> taken(layout.numCells(), 0);
  for (const std::size_t place : places) {
    if (taken[place] != 0) return false;
    taken[place] = 1;
  }
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    if (matrix && m != *matrix) continue;
    const Mask& mask = layout.matrix(m).staticMask;
    for (std::size_t k = 0; k < mask.size(); ++k)
      if (mask[k] != 0 && taken[layout.offset(m) + k] == 0) return false;
  }
  return true;
}

std::int64_t smallestAt(const ColumnGroup& group, std::size_t position) {
  std::int64_t smallest = INT64_MAX;
  for (const TableElement& each : group.elements)
    smallest = std::min(smallest, each.indices[position]);
  return smallest;
}

// Indices are counted from 0 or from 1.
std::int64_t baseAt(const ColumnGroup& group, std::size_t position) {
  return smallestAt(group, position) == 1 ? 1 : 0;
}

// By number: of one matrix, or of all.
std::optional<Places> placesByNumber(const ColumnGroup& group,
                                     const Places& positions,
                                     const SensorLayout& layout,
                                     std::optional<std::size_t> matrix) {
  const auto all = placesInOrder(group.elements.size(), layout, matrix, false);
  if (!all) return std::nullopt;
  const std::int64_t base = positions.empty() ? 0 : smallestAt(group, positions[0]);
  Places places;
  for (const TableElement& each : group.elements) {
    const std::int64_t i = positions.empty() ? 0 : each.indices[positions[0]] - base;
    if (i < 0 || i >= static_cast<std::int64_t>(all->size())) return std::nullopt;
    places.push_back((*all)[static_cast<std::size_t>(i)]);
  }
  if (!isComplete(places, layout, matrix)) return std::nullopt;
  return places;
}

// By row and column of a table: one matrix, or all, one below the other or side by side.
std::optional<Places> placesInTable(const ColumnGroup& group,
                                    const Places& positions,
                                    const SensorLayout& layout,
                                    std::optional<std::size_t> matrix,
                                    IndexOrder order,
                                    bool isSideBySide) {
  const std::size_t row = positions[order == IndexOrder::kRowColumn ? 0 : 1];
  const std::size_t column = positions[order == IndexOrder::kRowColumn ? 1 : 0];
  const std::int64_t firstRow = baseAt(group, row);
  const std::int64_t firstColumn = baseAt(group, column);
  const std::size_t end = matrix ? *matrix + 1 : layout.numMatrices();
  Places places;
  for (const TableElement& each : group.elements) {
    const std::int64_t y = each.indices[row] - firstRow;
    const std::int64_t x = each.indices[column] - firstColumn;
    std::int64_t along = isSideBySide ? x : y;
    std::size_t m = matrix.value_or(0);
    const auto sizeOf = [&](std::size_t which) {
      return isSideBySide ? layout.matrix(which).columns : layout.matrix(which).rows;
    };
    while (m < end && along >= sizeOf(m)) along -= sizeOf(m++);
    if (m == end || x < 0 || y < 0) return std::nullopt;
    const MatrixLayout& target = layout.matrix(m);
    const std::int64_t across = isSideBySide ? y : x;
    if (across >= (isSideBySide ? target.rows : target.columns)) return std::nullopt;
    places.push_back(layout.offset(m) +
                     static_cast<std::size_t>(isSideBySide ? across * target.columns + along
                                                           : along * target.columns + across));
  }
  if (!isComplete(places, layout, matrix)) return std::nullopt;
  return places;
}

// One matrix by row and column, or by number.
std::optional<Places> placesInMatrix(const ColumnGroup& group,
                                     const Places& positions,
                                     const SensorLayout& layout,
                                     std::size_t matrix,
                                     IndexOrder order) {
  if (positions.size() < 2) return placesByNumber(group, positions, layout, matrix);
  if (positions.size() > 2) return std::nullopt;
  return placesInTable(group, positions, layout, matrix, order, false);
}

// All matrices: by matrix, row and column; by matrix and number; by number.
std::optional<Places> placesInLayout(const ColumnGroup& group,
                                     const Places& positions,
                                     const SensorLayout& layout,
                                     IndexOrder order) {
  if (positions.size() == 1) return placesByNumber(group, positions, layout, std::nullopt);
  if (positions.size() != 2 && positions.size() != 3) return std::nullopt;
  const std::int64_t base = baseAt(group, positions[0]);
  Places places(group.elements.size());
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    ColumnGroup part;
    std::vector<std::size_t> origin;
    for (std::size_t e = 0; e < group.elements.size(); ++e) {
      const std::int64_t index = group.elements[e].indices[positions[0]] - base;
      if (index < 0 || index >= static_cast<std::int64_t>(layout.numMatrices()))
        return std::nullopt;
      if (index != static_cast<std::int64_t>(m)) continue;
      part.elements.push_back(group.elements[e]);
      origin.push_back(e);
    }
    if (part.elements.empty()) return std::nullopt;
    const auto found =
        placesInMatrix(part, {positions.begin() + 1, positions.end()}, layout, m, order);
    if (!found) return std::nullopt;
    for (std::size_t e = 0; e < origin.size(); ++e) places[origin[e]] = (*found)[e];
  }
  return places;
}

// 'x' or 'y' of a word that names columns or rows.
char letterOf(std::string_view name) {
  const std::string word = smallLetters(name);
  if (word == "x" || word == "c" || word == "col" || word == "column" || word == "columns")
    return 'x';
  return word == "y" || word == "r" || word == "row" || word == "rows" ? 'y' : '\0';
}

// 'x' or 'y' where the word before index `position` of a stem ("col#_row#") names columns or rows.
char letterBefore(std::string_view stem, std::size_t position) {
  std::size_t at = stem.find('#');
  for (; position > 0 && at != std::string_view::npos; --position) at = stem.find('#', at + 1);
  if (at == std::string_view::npos) return '\0';
  const auto end = stem.find_last_not_of(" _-.[(", at == 0 ? 0 : at - 1);
  std::string word;
  for (std::size_t i = end; i != std::string_view::npos && i < at &&
                            std::isalpha(static_cast<unsigned char>(stem[i])) != 0;
       --i)
    word.insert(word.begin(), stem[i]);
  return letterOf(word);
}

// Matches a name against a pattern of * and {m}, {y}, {x}, {i}; the numbers at the letters.
bool matchesPattern(std::string_view name,
                    std::string_view pattern,
                    std::vector<std::int64_t>& numbers) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] == '*') {
    for (std::size_t skipped = 0; skipped <= name.size(); ++skipped) {
      const std::size_t before = numbers.size();
      if (matchesPattern(name.substr(skipped), pattern.substr(1), numbers)) return true;
      numbers.resize(before);
    }
    return false;
  }
  if (pattern.size() >= 3 && pattern[0] == '{' && pattern[2] == '}') {
    std::size_t end = 0;
    while (end < name.size() && isDigit(name[end]) && end < 9) ++end;
    if (end == 0) return false;
    numbers.push_back(*parseInteger(name.substr(0, end)));
    return matchesPattern(name.substr(end), pattern.substr(3), numbers);
  }
  return !name.empty() && name[0] == pattern[0] &&
         matchesPattern(name.substr(1), pattern.substr(1), numbers);
}

// The letters of the places in a pattern. Throws Error for an unknown one or one that comes twice.
std::string lettersOf(const std::string& pattern) {
  constexpr std::size_t kMaxStars = 3;
  std::string letters;
  if (std::count(pattern.begin(), pattern.end(), '*') > static_cast<std::ptrdiff_t>(kMaxStars))
    throw Error("the pattern " + inQuotes(pattern) + " has more than three *");
  for (std::size_t at = pattern.find('{'); at != std::string::npos;
       at = pattern.find('{', at + 1)) {
    const char letter = at + 2 < pattern.size() && pattern[at + 2] == '}' ? pattern[at + 1] : ' ';
    if (std::string_view("myxi").find(letter) == std::string_view::npos)
      throw Error("the pattern " + inQuotes(pattern) +
                  " holds something else than {m}, {y}, {x}, {i}");
    if (letters.find(letter) != std::string::npos)
      throw Error("the pattern " + inQuotes(pattern) + " holds {" + letter + "} twice");
    letters += letter;
  }
  return letters;
}

std::optional<std::size_t> columnNamed(const std::vector<TableColumn>& columns,
                                       std::string_view name) {
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].name == name ||
        (name.size() > 1 && name[0] == '/' && columns[c].name == name.substr(1)))
      return c;
  if (!name.starts_with('#')) return std::nullopt;
  const auto position = parseInteger(name.substr(1));
  if (!position || *position < 1 || *position > static_cast<std::int64_t>(columns.size()))
    return std::nullopt;
  return static_cast<std::size_t>(*position - 1);
}

void requireNumbers(const TableColumn& column) {
  if (!column.isNumeric)
    throw Error(inQuotes(column.name) + " holds no numbers (" +
                (column.type.empty() ? "text" : column.type) + ")");
}

std::size_t requireColumn(const std::vector<TableColumn>& columns, std::string_view name) {
  const auto column = columnNamed(columns, name);
  if (column) return *column;
  if (name.starts_with('#') && parseInteger(name.substr(1)))
    throw Error("there is no column " + shortened(name) + ": the file has " +
                counted(columns.size(), "column"));
  throw Error("there is no column " + inQuotes(name) + "; there are " + namesText(columns));
}

[[noreturn]] void throwNoMatch(const std::vector<TableColumn>& columns, std::string_view pattern) {
  throw Error("no column of numbers matches " + inQuotes(pattern) + "; there are " +
              namesText(columns));
}

// The columns of one part of a choice.
std::vector<std::size_t> columnsOf(const std::vector<TableColumn>& columns, std::string_view part) {
  std::vector<std::size_t> chosen;
  const auto dots = part.find("..");
  if (columnNamed(columns, part)) return {*columnNamed(columns, part)};
  if (part.find('*') != std::string_view::npos) {
    std::vector<std::int64_t> unused;
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].isNumeric && matchesPattern(columns[c].name, part, unused))
        chosen.push_back(c);
    if (chosen.empty()) throwNoMatch(columns, part);
    return chosen;
  }
  if (dots == std::string_view::npos) return {requireColumn(columns, part)};
  const std::size_t first = requireColumn(columns, trimmed(part.substr(0, dots)));
  const std::size_t last = requireColumn(columns, trimmed(part.substr(dots + 2)));
  if (last < first) throw Error("the columns " + inQuotes(part) + " end before they begin");
  for (std::size_t c = first; c <= last; ++c) chosen.push_back(c);
  return chosen;
}

// The numbers of one part of a choice: of columns, or "table[1]", "table[1]..table[6]".
void appendPart(const std::vector<TableColumn>& columns,
                std::string_view part,
                std::vector<TableElement>& elements) {
  const auto dots = std::min(part.find(".."), part.size());
  const auto first = numberNamed(columns, trimmed(part.substr(0, dots)));
  const auto last =
      dots < part.size() ? numberNamed(columns, trimmed(part.substr(dots + 2))) : first;
  if (first && last && first->within && last->within && first->column == last->column) {
    requireNumbers(columns[first->column]);
    if (*last->within < *first->within)
      throw Error("the numbers " + inQuotes(part) + " end before they begin");
    for (std::size_t i = *first->within; i <= *last->within; ++i)
      elements.push_back({first->column, i, {static_cast<std::int64_t>(i)}});
    return;
  }
  for (const std::size_t column : columnsOf(columns, part)) {
    requireNumbers(columns[column]);
    appendElements(columns, column, {}, elements);
  }
}

}  // namespace

std::vector<ColumnGroup> groupColumns(const std::vector<TableColumn>& columns,
                                      const std::vector<std::size_t>& chosen) {
  std::vector<ColumnGroup> groups;
  // By stem and number of indices: a '#' in a name is like the stem of a digit.
  std::map<std::pair<std::string, std::size_t>, std::size_t> byStem;
  std::size_t allNumbers = 0;
  for (const std::size_t c : chosen) {
    std::vector<std::int64_t> numbers;
    std::string stem = stemOf(nameWithoutUnit(columns[c].name), numbers);
    for (std::size_t d = 0; d < columns[c].shape.size(); ++d) stem += "[#]";
    countElements(columns[c], numbers.size(), allNumbers);
    const auto [at, isNew] = byStem.try_emplace({stem, numbers.size()}, groups.size());
    if (isNew) {
      ColumnGroup& group = groups.emplace_back();
      group.stem = stem;
      for (std::size_t n = 0; n < numbers.size() + columns[c].shape.size(); ++n)
        group.letters += n < numbers.size() ? letterBefore(stem, n)
                         : columns[c].axes.size() <= columns[c].shape.size()
                             ? '\0'
                             : letterOf(columns[c].axes[n - numbers.size() + 1]);
    }
    groups[at->second].columns.push_back(c);
    appendElements(columns, c, numbers, groups[at->second].elements);
  }
  return groups;
}

std::optional<Places> placesInOrder(std::size_t count,
                                    const SensorLayout& layout,
                                    std::optional<std::size_t> matrix,
                                    bool columnByColumn) {
  const bool all = matrix ? count == layout.matrix(*matrix).numCells() : count == layout.numCells();
  const bool taxels =
      matrix ? count == layout.matrix(*matrix).numTaxels() : count == layout.numTaxels();
  if (!all && !taxels) return std::nullopt;
  Places places;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    if (matrix && m != *matrix) continue;
    const MatrixLayout& each = layout.matrix(m);
    const auto rows = static_cast<std::size_t>(each.rows);
    const auto width = static_cast<std::size_t>(each.columns);
    for (std::size_t k = 0; k < each.numCells(); ++k) {
      const std::size_t cell = columnByColumn ? k % rows * width + k / rows : k;
      if (all || each.staticMask[cell] != 0) places.push_back(layout.offset(m) + cell);
    }
  }
  return places;
}

std::optional<Places> placesOf(const ColumnGroup& group,
                               const SensorLayout& layout,
                               std::optional<std::size_t> matrix,
                               IndexOrder order) {
  if (group.elements.empty() || group.elements.size() > layout.numCells()) return std::nullopt;
  if (!matrix && layout.numMatrices() == 1) matrix = 0;
  std::vector<std::size_t> all(group.elements.front().indices.size());
  for (std::size_t p = 0; p < all.size(); ++p) all[p] = p;
  const std::vector<std::size_t> varying = varyingPositions(group);
  for (const auto& positions : {all, varying})
    if (auto places = matrix ? placesInMatrix(group, positions, layout, *matrix, order)
                             : placesInLayout(group, positions, layout, order))
      return places;
  return std::nullopt;
}

std::optional<IndexOrder> orderByLetters(const ColumnGroup& group) {
  const std::vector<std::size_t> positions = varyingPositions(group);
  if (positions.size() < 2) return std::nullopt;
  if (group.letters.size() <= positions.back()) return std::nullopt;
  const char first = group.letters[positions[positions.size() - 2]];
  const char second = group.letters[positions.back()];
  if (first == 'y' && second == 'x') return IndexOrder::kRowColumn;
  if (first == 'x' && second == 'y') return IndexOrder::kColumnRow;
  return std::nullopt;
}

std::size_t numVaryingIndices(const ColumnGroup& group) { return varyingPositions(group).size(); }

std::optional<Places> placesTiled(const ColumnGroup& group,
                                  const SensorLayout& layout,
                                  IndexOrder order,
                                  bool isSideBySide) {
  const std::vector<std::size_t> positions = varyingPositions(group);
  if (positions.size() != 2 || group.elements.size() != layout.numCells()) return std::nullopt;
  return placesInTable(group, positions, layout, std::nullopt, order, isSideBySide);
}

ColumnGroup lastIndexFirst(ColumnGroup group) {
  for (TableElement& each : group.elements)
    std::rotate(each.indices.begin(), each.indices.end() - 1, each.indices.end());
  std::rotate(group.letters.begin(), group.letters.end() - 1, group.letters.end());
  return group;
}

std::optional<ColumnGroup> letterGroup(const std::vector<TableColumn>& columns,
                                       const std::vector<std::size_t>& chosen) {
  ColumnGroup group;
  for (const std::size_t c : chosen) {
    if (!columns[c].shape.empty()) return std::nullopt;
    const std::string name = smallLetters(nameWithoutUnit(columns[c].name));
    const auto digits = name.find_last_not_of("0123456789") + 1;  // of npos: 0
    const auto number = parseInteger(std::string_view(name).substr(digits));
    if (!number || digits == 0 || name[digits - 1] < 'a' || name[digits - 1] > 'z' ||
        (digits > 1 && std::isalnum(static_cast<unsigned char>(name[digits - 2])) != 0))
      return std::nullopt;
    std::string stem = name.substr(0, digits - 1) + "?#";
    if (!group.columns.empty() && stem != group.stem) return std::nullopt;
    group.stem = std::move(stem);
    group.columns.push_back(c);
    group.elements.push_back({c, 0, {name[digits - 1] - 'a', *number}});
  }
  if (group.elements.empty() || varyingPositions(group).size() != 2) return std::nullopt;
  return group;
}

std::optional<ChosenNumber> numberNamed(const std::vector<TableColumn>& columns,
                                        std::string_view name) {
  if (const auto column = columnNamed(columns, name)) return ChosenNumber{*column, std::nullopt};
  const auto bracket = name.rfind('[');
  if (bracket == std::string_view::npos || !name.ends_with(']')) return std::nullopt;
  const auto column = columnNamed(columns, name.substr(0, bracket));
  const auto within = parseInteger(name.substr(bracket + 1, name.size() - bracket - 2));
  if (!column || !within || columns[*column].shape.size() != 1 || *within < 0 ||
      *within >= static_cast<std::int64_t>(columns[*column].width()))
    return std::nullopt;
  return ChosenNumber{*column, static_cast<std::size_t>(*within)};
}

ChosenElements chooseElements(const std::vector<TableColumn>& columns, const std::string& text) {
  ChosenElements chosen;
  const std::string whole(trimmed(text));
  if (const auto column = columnNamed(columns, whole)) {
    requireNumbers(columns[*column]);
    appendElements(columns, *column, {}, chosen.elements);
    return chosen;
  }
  if (whole.find('{') != std::string::npos) {
    chosen.letters = lettersOf(whole);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      std::vector<std::int64_t> numbers;
      if (!columns[c].isNumeric || !matchesPattern(columns[c].name, whole, numbers)) continue;
      appendElements(columns, c, numbers, chosen.elements);
    }
    if (chosen.elements.empty()) throwNoMatch(columns, whole);
    return chosen;
  }
  std::size_t at = 0;
  while (at <= whole.size()) {
    const auto comma = std::min(whole.find(',', at), whole.size());
    const std::string_view part = trimmed(std::string_view(whole).substr(at, comma - at));
    if (part.empty())
      throw Error("the choice of columns " + inQuotes(whole) + " has an empty part");
    appendPart(columns, part, chosen.elements);
    at = comma + 1;
  }
  return chosen;
}

Places placesByLetters(const ChosenElements& chosen,
                       const SensorLayout& layout,
                       std::optional<std::size_t> matrix) {
  // Indices behind the letters are those of arrays: matched columns are plain numbers, or arrays
  // whose rows hold what no letter stands for.
  const std::string& letters = chosen.letters;
  ColumnGroup group;
  group.elements = chosen.elements;
  std::map<char, std::int64_t> bases;
  for (std::size_t i = 0; i < letters.size(); ++i) bases[letters[i]] = baseAt(group, i);
  Places places;
  for (const TableElement& each : chosen.elements) {
    const auto at = [&](char letter) -> std::optional<std::int64_t> {
      const auto p = letters.find(letter);
      if (p == std::string::npos) return std::nullopt;
      return each.indices[p] - bases[letter];
    };
    const std::int64_t m = at('m').value_or(static_cast<std::int64_t>(matrix.value_or(0)));
    const auto refuse = [&](const std::string& what) {
      throw Error("a column of the pattern is outside of the hand: " + what + "; expected " +
                  std::to_string(layout.numMatrices()) + " matrices");
    };
    if (m < 0 || m >= static_cast<std::int64_t>(layout.numMatrices()))
      refuse("matrix " + std::to_string(m));
    const auto index = static_cast<std::size_t>(m);
    const MatrixLayout& target = layout.matrix(index);
    std::int64_t cell = 0;
    if (const auto i = at('i')) {
      cell = *i;
    } else if (letters.find('y') != std::string::npos || letters.find('x') != std::string::npos) {
      const std::int64_t y = at('y').value_or(0);
      // A pattern of rows leaves the columns of an array.
      const std::int64_t x = at('x').value_or(static_cast<std::int64_t>(each.within));
      if (y < 0 || y >= target.rows || x < 0 || x >= target.columns)
        refuse("row " + std::to_string(y) + ", column " + std::to_string(x) + " of a matrix of " +
               std::to_string(target.rows) + " x " + std::to_string(target.columns));
      cell = y * target.columns + x;
    } else {
      cell = static_cast<std::int64_t>(each.within);
    }
    if (cell < 0 || cell >= static_cast<std::int64_t>(target.numCells()))
      refuse("taxel " + std::to_string(cell) + " of a matrix of " + std::to_string(target.rows) +
             " x " + std::to_string(target.columns));
    places.push_back(layout.offset(index) + static_cast<std::size_t>(cell));
  }
  if (std::set(places.begin(), places.end()).size() != places.size())
    throw Error("two columns of the pattern are the same taxel");
  return places;
}

}  // namespace palpate
